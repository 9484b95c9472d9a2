//! What a ray is inside of.

use super::transmits;
use super::world::World;
use crate::model::Model;
use glam::DVec3;
use oktant_shared::material::Material;

/// So many volumes can enclose a point; another takes the place of the last.
const MOST: usize = 4;

/// The volumes around a point, as indices of materials, in the order in which they were entered (nested dielectrics with
/// priorities: C. M. Schmidt, B. Budge, Journal of Graphics Tools 7(2), 2002).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Media {
    inside: [u32; MOST],
    count: usize,
}

impl Media {
    /// The material that fills the point: of the highest priority, of equal ones the last entered; `None` in the air.
    pub fn current(&self, model: &Model) -> Option<u32> {
        let inside = self.inside[..self.count].iter().copied();
        // Of equal ones, `max_by_key` takes the last.
        inside.max_by_key(|id| model.materials[*id as usize].priority)
    }

    /// After entering a volume.
    pub fn entered(mut self, material: u32) -> Self {
        self.count = (self.count + 1).min(MOST);
        self.inside[self.count - 1] = material;
        self
    }

    /// After leaving a volume: the last one entered of its kind is gone, if there is one.
    pub fn left(mut self, material: u32) -> Self {
        if let Some(place) = self.inside[..self.count].iter().rposition(|id| *id == material) {
            self.inside.copy_within(place + 1..self.count, place);
            self.count -= 1;
        }
        self
    }
}

/// What part of light is left after a way through a material (Beer and Lambert).
pub(super) fn absorbed(material: &Material, way: f64) -> DVec3 {
    // Of an endless way through what absorbs nothing, zero times infinity must not come in.
    material.absorption.as_dvec3().map(|absorption| {
        if absorption > 0.0 {
            (-absorption * way).exp()
        } else {
            1.0
        }
    })
}

/// Ways out of a point, none of them along an axis or an edge that people draw: meshes have holes, so one is not enough.
const WAYS: [DVec3; 5] = [
    DVec3::new(0.437, 0.311, 0.844),
    DVec3::new(-0.291, 0.917, -0.273),
    DVec3::new(0.733, -0.569, -0.371),
    DVec3::new(-0.823, -0.241, 0.515),
    DVec3::new(0.119, -0.871, 0.477),
];

/// No model that makes sense has so many surfaces one behind the other.
const MOST_SURFACES: usize = 10_000;

/// What is around a point: the transmissive planes behind which it lies, and the volumes of meshes that must be left on
/// every way out.
pub(super) fn media_at(world: &World<'_>, point: DVec3) -> Media {
    let model = world.model;
    if !model.materials.iter().any(transmits) {
        return Media::default();
    }
    let mut around = exits(world, point, WAYS[0]);
    for way in &WAYS[1..] {
        let mut others = exits(world, point, *way);
        around.retain(|id| match others.iter().position(|other| other == id) {
            Some(place) => {
                others.swap_remove(place);
                true
            }
            None => false,
        });
    }
    let behind = model.planes.iter().filter(|plane| {
        let is_behind = plane.normal.as_dvec3().dot(point) < f64::from(plane.offset);
        is_behind && transmits(&model.materials[plane.material as usize])
    });
    // The outermost was entered first, and is left last.
    let volumes = behind.map(|plane| plane.material).chain(around.into_iter().rev());
    volumes.fold(Media::default(), Media::entered)
}

/// Materials of the volumes that are left on a way without having been entered on it, the nearest exit first.
fn exits(world: &World<'_>, point: DVec3, way: DVec3) -> Vec<u32> {
    let way = way.normalize();
    let mut origin = point;
    let (mut open, mut left) = (Vec::new(), Vec::new());
    for _ in 0..MOST_SURFACES {
        let Some(meeting) = world.closest_triangle(origin, way, f64::INFINITY) else {
            break;
        };
        let crossing = world.crossing(&meeting, origin, way);
        if transmits(&world.model.materials[crossing.material as usize]) {
            if crossing.from_front {
                open.push(crossing.material);
            } else if let Some(place) = open.iter().rposition(|id| *id == crossing.material) {
                open.remove(place);
            } else {
                left.push(crossing.material);
            }
        }
        origin = crossing.behind();
    }
    left
}
