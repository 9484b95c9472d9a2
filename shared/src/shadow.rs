//! Whether, and in which colour, a point sees a light.

use crate::arithmetic::min;
use crate::buffer::load;
use crate::frame::{Frame, TRANSPARENT};
use crate::light::Incident;
use crate::ray::{Ray, T_MAX};
use crate::scene::World;
use crate::surface::Passage;
use crate::trace::{any_hit, closest_hit};
use crate::traversal::Traversal;
use glam::Vec3;
#[cfg(target_arch = "spirv")]
use num_traits::Float;

/// A shadow ray passes through so many transmissive surfaces; one more stops it.
pub const MAX_SHADOW_SURFACES: u32 = 16;

/// What part of the light arrives at `origin`, linear RGB: all, nothing, or what transmissive things in between leave.
///
/// The rule for those: light goes straight on, is multiplied with [`crate::material::Material::transmission`] at each
/// surface, and is absorbed on its way to the surface where it leaves a medium. It is neither refracted nor reflected.
pub fn visibility<V: Traversal, const FULL: bool>(
    frame: &Frame,
    world: &World<'_>,
    origin: Vec3,
    incident: &Incident,
) -> Vec3 {
    let mut ray = Ray {
        origin,
        t_min: 0.0,
        direction: incident.direction,
        t_max: incident.reach,
    };
    if !FULL || frame.features & TRANSPARENT == 0 {
        return if any_hit::<V, FULL>(frame, world, &ray) {
            Vec3::ZERO
        } else {
            Vec3::ONE
        };
    }
    let mut part = Vec3::ONE;
    let mut surfaces = 0;
    let length = ray.direction.length();
    loop {
        let hit = closest_hit::<V, FULL>(frame, world, &ray);
        if !hit.is_hit() {
            return part;
        }
        let passage = Passage::new(world, &ray, &hit);
        let material = load(world.appearance.materials, passage.material_id);
        if !material.is_transmissive() || surfaces == MAX_SHADOW_SURFACES {
            return Vec3::ZERO;
        }
        surfaces += 1;
        part *= material.transmission;
        if !passage.from_front {
            part *= attenuation(material.absorption, hit.t * length);
        }
        ray.origin = passage.origin;
        // The light's distance shrinks by the way so far; infinity stays.
        ray.t_max = if ray.t_max < T_MAX { ray.t_max - hit.t } else { T_MAX };
    }
}

/// What part of the light is left after a way through an absorbing medium (Beer-Lambert).
pub fn attenuation(absorption: Vec3, way: f32) -> Vec3 {
    let part = |absorption: f32| {
        if absorption > 0.0 {
            // Bounded, so that no driver's exponential is asked for more than it can.
            (-min(absorption * way, 100.0)).exp()
        } else {
            1.0
        }
    };
    Vec3::new(part(absorption.x), part(absorption.y), part(absorption.z))
}
