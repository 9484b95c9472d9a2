//! The tree of nodes: where meshes, lights and the camera are.

use super::document::{Document, Node, Orthographic, Perspective, get};
use super::fault::{Fault, Place};
use super::notices::Notices;
use crate::asset::{FileCamera, Lens};
use glam::{DMat4, DQuat, DVec3, DVec4};

/// Something at a node.
pub(super) struct Placed {
    /// Its index in the file.
    pub(super) id: usize,
    /// From its own coordinates to those of the scene.
    pub(super) transform: DMat4,
}

/// What the nodes of the scene show, in the order in which the tree is walked.
#[derive(Default)]
pub(super) struct Walk {
    pub(super) meshes: Vec<Placed>,
    pub(super) lights: Vec<Placed>,
    /// The first one.
    pub(super) camera: Option<Placed>,
}

impl Walk {
    /// Walks through the scene that the file shows, or its first one; where it has none, through all nodes that are nobody's
    /// children.
    pub(super) fn new(document: &Document) -> Result<Self, Fault> {
        let mut walk = Walk::default();
        let mut is_seen = vec![false; document.nodes.len()];
        // Those that wait, the next one last.
        let mut waiting: Vec<(usize, DMat4)> = roots(document)?
            .into_iter()
            .rev()
            .map(|root| (root, DMat4::IDENTITY))
            .collect();
        while let Some((id, above)) = waiting.pop() {
            let node = get(&document.nodes, "nodes", id)?;
            if std::mem::replace(&mut is_seen[id], true) {
                return Err(Fault::NoTree(Place::of("nodes", id)));
            }
            let transform = above * own_transform(node);
            if !transform.is_finite() {
                return Err(Fault::TooFar);
            }
            let placed = |id: usize| Placed { id, transform };
            walk.meshes.extend(node.mesh.map(placed));
            walk.lights
                .extend(node.extensions.light.as_ref().map(|light| placed(light.light)));
            if walk.camera.is_none() {
                walk.camera = node.camera.map(placed);
            }
            waiting.extend(node.children.iter().rev().map(|child| (*child, transform)));
        }
        Ok(walk)
    }
}

fn roots(document: &Document) -> Result<Vec<usize>, Fault> {
    if let Some(scene) = document.scene {
        return Ok(get(&document.scenes, "scenes", scene)?.nodes.clone());
    }
    if let Some(scene) = document.scenes.first() {
        return Ok(scene.nodes.clone());
    }
    let mut is_root = vec![true; document.nodes.len()];
    for child in document.nodes.iter().flat_map(|node| &node.children) {
        if let Some(is_root) = is_root.get_mut(*child) {
            *is_root = false;
        }
    }
    Ok((0..is_root.len()).filter(|node| is_root[*node]).collect())
}

/// From a node's coordinates to those of the one above it.
fn own_transform(node: &Node) -> DMat4 {
    if let Some(matrix) = &node.matrix {
        return DMat4::from_cols_array(matrix);
    }
    let rotation = node.rotation.map_or(DQuat::IDENTITY, DQuat::from_array);
    let length = rotation.length();
    DMat4::from_scale_rotation_translation(
        node.scale.map_or(DVec3::ONE, DVec3::from_array),
        // As many digits as the file has; a quaternion of no length turns nothing.
        if length > 0.0 && length.is_finite() {
            rotation / length
        } else {
            DQuat::IDENTITY
        },
        node.translation.map_or(DVec3::ZERO, DVec3::from_array),
    )
}

/// How much a camera may be turned about where it looks before that is worth a word: the cosine of 1 degree.
const LEVEL: f64 = 0.999_848;

/// The camera at a node; none where it is of a kind that there is not.
pub(super) fn camera(
    document: &Document,
    placed: &Placed,
    shift: DVec3,
    notices: &mut Notices,
) -> Result<Option<FileCamera>, Fault> {
    let camera = get(&document.cameras, "cameras", placed.id)?;
    let place = Place::of("cameras", placed.id);
    let lens = if let Some(Perspective { yfov }) = camera.perspective {
        if !(yfov > 0.0 && yfov < std::f64::consts::PI) {
            return Err(Fault::Value {
                place: place.field("perspective.yfov"),
                value: yfov,
                wanted: "an angle above 0 and below pi, radians",
            });
        }
        Lens::FieldOfView(yfov.to_degrees().clamp(1.0, 170.0) as f32)
    } else if let Some(Orthographic { ymag }) = camera.orthographic {
        // A negative one would turn the picture over; the format discourages that, and nobody here does it.
        let half_height = ymag.abs() as f32;
        if !(half_height >= f32::MIN_POSITIVE && half_height.is_finite()) {
            return Err(Fault::Value {
                place: place.field("orthographic.ymag"),
                value: ymag,
                wanted: "half a height above 0, scene units",
            });
        }
        Lens::Height(2.0 * half_height)
    } else {
        return Ok(None);
    };
    let along = |axis: DVec4| (placed.transform * axis).truncate().try_normalize();
    let (Some(forward), Some(above)) = (along(DVec4::NEG_Z), along(DVec4::Y)) else {
        return Ok(None);
    };
    let right = forward.cross(DVec3::Y);
    let level = right.cross(forward).try_normalize().unwrap_or(above);
    if above.dot(level) < LEVEL {
        notices.add("the roll of cameras");
    }
    Ok(Some(FileCamera {
        eye: (placed.transform.w_axis.truncate() - shift).as_vec3(),
        forward: forward.as_vec3(),
        lens,
    }))
}
