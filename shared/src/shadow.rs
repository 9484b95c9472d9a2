//! Whether, and in which colour, a point sees a light.

use crate::arithmetic::{max_component, min};
use crate::buffer::load;
use crate::frame::{Frame, TRANSPARENT};
use crate::light::Incident;
use crate::medium::Media;
use crate::ray::{Ray, T_MAX};
use crate::scene::World;
use crate::surface::Passage;
use crate::trace::{any_hit, closest_hit};
use crate::traversal::Traversal;
use crate::variant::GLASS;
use glam::Vec3;
#[cfg(target_arch = "spirv")]
use num_traits::Float;

/// A shadow ray passes through so many transmissive surfaces; what is behind one more is cut.
pub const MAX_SHADOW_SURFACES: u32 = 16;

/// How much of a light a point sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Visibility {
    /// The part of its light that arrives, linear RGB: all, nothing, or what transmissive things in between leave.
    pub part: Vec3,
    /// What may arrive beside that, of its largest channel, for the ray was followed no further.
    pub cut: f32,
}

impl Visibility {
    fn of(part: Vec3) -> Self {
        Visibility { part, cut: 0.0 }
    }
}

/// How much of a light arrives at `origin`, which lies inside of `media`.
///
/// The rule for transmissive things: light goes straight on, is multiplied with
/// [`crate::material::Material::transmission`] at each surface, and is absorbed on its way through each medium. It is
/// neither refracted nor reflected. As for other rays, a surface inside a medium of higher priority is passed as if it
/// were not there (see [`Media`]).
pub fn visibility<V: Traversal, const NEEDS: u32>(
    frame: &Frame,
    world: &World<'_>,
    origin: Vec3,
    media: Media,
    incident: &Incident,
) -> Visibility {
    let mut ray = Ray {
        origin,
        t_min: 0.0,
        direction: incident.direction,
        t_max: incident.reach,
    };
    if NEEDS & GLASS == 0 || (V::SHADOWS_APART && frame.features & TRANSPARENT == 0) {
        return Visibility::of(if any_hit::<V, NEEDS>(frame, world, &ray) {
            Vec3::ZERO
        } else {
            Vec3::ONE
        });
    }
    let materials = world.appearance.materials;
    let mut media = media;
    let mut part = Vec3::ONE;
    let mut surfaces = 0;
    let length = ray.direction.length();
    loop {
        // A miss is as far as the light.
        let hit = closest_hit::<V, NEEDS>(frame, world, &ray);
        let around = media.current(materials);
        if around != 0 {
            part *= attenuation(load(materials, around - 1).absorption, hit.t * length);
        }
        if !hit.is_hit() {
            return Visibility::of(part);
        }
        let passage = Passage::new(world, &ray, &hit);
        let material = load(materials, passage.material_id);
        if !material.is_transmissive() {
            return Visibility::of(Vec3::ZERO);
        }
        if surfaces == MAX_SHADOW_SURFACES {
            return Visibility {
                part: Vec3::ZERO,
                cut: max_component(part),
            };
        }
        surfaces += 1;
        if around == 0 && !passage.from_front {
            // Out of something that was never entered: its surface is not closed.
            part *= attenuation(material.absorption, hit.t * length);
        }
        media = if passage.from_front {
            media.entered(passage.material_id)
        } else {
            media.left(passage.material_id)
        };
        if around == 0 || media.current(materials) != around {
            part *= material.transmission;
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
