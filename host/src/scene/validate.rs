//! What must hold in a model before a kernel trusts it.

use crate::mesh::Mesh;
use crate::model::{Model, needs_coordinates};
use glam::Vec3;
use oktant_shared::environment::Environment;
use oktant_shared::light::{AREA, DIRECTIONAL, Light};
use oktant_shared::material::Material;
use oktant_shared::plane::{PLANE, Plane};
use oktant_shared::texture::{CHECKERBOARD, NO_TEXTURE, Texture, WAVES};
use rayon::prelude::*;

/// A broken rule of a model, in words; a bug of whoever made it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("The scene is not valid: {0}. This is a bug; please report it with the scene.")]
pub struct InvalidModel(pub String);

/// Numbers that are worth a thread.
const BLOCK: usize = 1 << 14;

/// Rows and columns of images have at most so many texels, so that all are told apart in single precision.
const LONGEST_SIDE: u32 = 1 << 24;

/// Checks everything that the kernel and the octree's build rely on without looking: lengths of arrays, indices, and
/// numbers that are divided by or count something.
///
/// # Errors
/// The first broken rule.
pub fn validate(model: &Model) -> Result<(), InvalidModel> {
    check_mesh(&model.mesh)?;
    check_materials(model)?;
    for (i, texture) in model.textures.iter().enumerate() {
        check_texture(texture, model.texels.len()).map_err(of("texture", i))?;
    }
    for (i, light) in model.lights.iter().enumerate() {
        // A view says where the first one is.
        check_light(light, i == 0).map_err(of("light", i))?;
    }
    for (i, plane) in model.planes.iter().enumerate() {
        check_plane(plane).map_err(of("plane", i))?;
    }
    check_environment(&model.environment, &model.textures)?;
    rule(model.ambient.is_finite(), || "the ambient light is not finite".into())?;
    rule(
        model
            .focus
            .is_none_or(|focus| focus.center.is_finite() && focus.radius.is_finite() && focus.radius > 0.0),
        || "what is looked at has no place or size".into(),
    )
}

fn rule(holds: bool, otherwise: impl FnOnce() -> String) -> Result<(), InvalidModel> {
    if holds { Ok(()) } else { Err(InvalidModel(otherwise())) }
}

/// Says of which of many things a rule is broken.
fn of(what: &str, index: usize) -> impl Fn(InvalidModel) -> InvalidModel {
    move |InvalidModel(rule)| InvalidModel(format!("{what} {index}: {rule}"))
}

fn check_mesh(mesh: &Mesh) -> Result<(), InvalidModel> {
    let vertices = mesh.positions.len();
    for (what, length) in [
        ("normals", mesh.normals.len()),
        ("colours", mesh.colors.len()),
        ("texture coordinates", mesh.coordinates.len()),
    ] {
        rule(length == 0 || length == vertices, || {
            format!("there are {length} {what} for {vertices} vertices")
        })?;
    }
    let most = PLANE as usize;
    rule(vertices <= most && mesh.triangles.len() <= most, || {
        format!("there are more than {most} triangles or vertices")
    })?;
    // In blocks: to look whether others have found something takes longer than to look at an element.
    let corners = mesh.triangles.as_flattened().par_chunks(BLOCK);
    let highest = corners.map(|corners| corners.iter().fold(0, |highest, corner| highest.max(*corner)));
    let highest = highest.max().unwrap_or(0);
    rule(mesh.triangles.is_empty() || (highest as usize) < vertices, || {
        format!("a triangle has corner {highest} of {vertices}")
    })?;
    let are_finite = |vectors: &[Vec3]| {
        let blocks = vectors.par_chunks(BLOCK);
        blocks.all(|vectors| vectors.iter().fold(true, |finite, vector| finite & vector.is_finite()))
    };
    let finite = are_finite(&mesh.positions)
        && are_finite(&mesh.normals)
        && mesh.coordinates.par_iter().all(|it| it.is_finite());
    rule(finite, || "a vertex has numbers that are not finite".into())
}

fn check_materials(model: &Model) -> Result<(), InvalidModel> {
    let mesh = &model.mesh;
    rule(!model.materials.is_empty(), || "there is no material".into())?;
    rule(
        model.material_ids.is_empty() || model.material_ids.len() == mesh.triangles.len(),
        || "not every triangle has a material".into(),
    )?;
    let materials = model.materials.len();
    let ids = model.material_ids.iter().copied();
    for id in ids.chain(model.planes.iter().map(|plane| plane.material)) {
        rule((id as usize) < materials, || format!("there is no material {id}"))?;
    }
    for (i, material) in model.materials.iter().enumerate() {
        check_material(material, model.textures.len()).map_err(of("material", i))?;
    }
    let are_needed = if model.material_ids.is_empty() {
        needs_coordinates(&model.materials[0])
    } else {
        let mut ids = model.material_ids.iter();
        ids.any(|id| needs_coordinates(&model.materials[*id as usize]))
    };
    rule(
        !are_needed || !mesh.coordinates.is_empty() || mesh.triangles.is_empty(),
        || "a texture lies on triangles without coordinates".into(),
    )
}

fn check_material(material: &Material, textures: usize) -> Result<(), InvalidModel> {
    for id in [material.texture, material.bump] {
        rule(id == NO_TEXTURE || (id as usize) < textures, || {
            format!("there is no texture {id}")
        })?;
    }
    let colors = [
        material.base,
        material.specular,
        material.mirror,
        material.transmission,
        material.absorption,
    ];
    let numbers = [
        material.ambient,
        material.exponent,
        material.diffuse,
        material.ior,
        material.bump_height,
    ];
    rule(
        colors.iter().all(|color| color.is_finite()) && numbers.iter().all(|number| number.is_finite()),
        || "it has numbers that are not finite".into(),
    )?;
    rule(material.ior > 0.0, || "its index of refraction is not above 0".into())
}

fn check_texture(texture: &Texture, texels: usize) -> Result<(), InvalidModel> {
    rule(
        texture.is_image() || texture.kind == CHECKERBOARD || texture.kind == WAVES,
        || format!("there is no kind {}", texture.kind),
    )?;
    rule(texture.repeats.is_finite() && texture.repeats > 0.0, || {
        format!("it is repeated {} times", texture.repeats)
    })?;
    if !texture.is_image() {
        return Ok(());
    }
    let (width, height) = (texture.width, texture.height);
    let sides = 1..=LONGEST_SIDE;
    rule(sides.contains(&width) && sides.contains(&height), || {
        format!("an image cannot have {width} times {height} texels")
    })?;
    let end = u64::from(texture.first) + u64::from(width) * u64::from(height);
    rule(end <= texels as u64 && end <= u64::from(u32::MAX), || {
        "the image has too few texels".into()
    })
}

fn check_light(light: &Light, is_placed: bool) -> Result<(), InvalidModel> {
    rule(light.kind <= AREA, || format!("there is no kind {}", light.kind))?;
    rule(
        light.position.is_finite()
            && light.color.is_finite()
            && light.falloff_radius.is_finite()
            && light.range.is_finite(),
        || "it has numbers that are not finite".into(),
    )?;
    if light.kind == DIRECTIONAL {
        return rule(is_placed || light.position != Vec3::ZERO, || {
            "it comes from nowhere".into()
        });
    }
    if light.kind == AREA {
        let area = light.edge_u.cross(light.edge_v).length();
        rule(area.is_finite() && area > 0.0, || "it has no area".into())?;
        let side = light.samples_per_side;
        rule(side > 0 && side.checked_mul(side).is_some(), || {
            format!("it has {side} samples along each edge")
        })?;
    }
    Ok(())
}

fn check_plane(plane: &Plane) -> Result<(), InvalidModel> {
    rule(plane.offset.is_finite(), || "its offset is not finite".into())?;
    rule(plane.normal.is_normalized(), || "its normal is no unit vector".into())?;
    rule(plane.tangent.is_normalized(), || "its tangent is no unit vector".into())
}

fn check_environment(environment: &Environment, textures: &[Texture]) -> Result<(), InvalidModel> {
    let colors = [environment.zenith, environment.horizon, environment.nadir];
    rule(
        colors.iter().all(|color| color.is_finite())
            && environment.rotation.is_finite()
            && environment.strength.is_finite(),
        || "the environment has numbers that are not finite".into(),
    )?;
    rule(environment.up.is_normalized(), || {
        "the environment's upwards is no unit vector".into()
    })?;
    let id = environment.texture;
    let is_image = |texture: &Texture| texture.is_image();
    rule(
        id == NO_TEXTURE || textures.get(id as usize).is_some_and(is_image),
        || format!("the environment's texture {id} is no image"),
    )
}

#[cfg(test)]
mod tests;
