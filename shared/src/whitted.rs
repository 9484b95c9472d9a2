//! The tree of a ray's reflections and refractions.

use crate::arithmetic::max_component;
use crate::buffer::{Stack, load};
use crate::frame::Frame;
use crate::material::FRESNEL;
use crate::medium::Media;
use crate::optics::{reflected, refracted};
use crate::ray::Ray;
use crate::scene::World;
use crate::shading::{Viewer, shade};
use crate::shadow::attenuation;
use crate::surface::Surface;
use crate::trace::closest_hit;
use crate::traversal::Traversal;
use glam::Vec3;

/// A ray is followed through at most so many reflections and refractions, one after the other. Also the size of the
/// stack: of two rays that leave a surface one waits there while the other is followed, so no more than this many wait.
pub const MAX_DEPTH: u32 = 16;

/// When a sample has followed so many rays, only those that wait already are followed too; the rest is cut.
pub const MAX_RAYS: u32 = 4096;

/// What became of a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Traced {
    /// Linear RGB.
    pub color: Vec3,
    /// Rays that asked for their closest hit, the camera's included.
    pub rays: u32,
    /// Rays that asked whether a light is seen.
    pub shadow_rays: u32,
    /// The weight of the rays, shadow rays too, that were not followed, largest channel, summed up: what is missing in the
    /// colour is at most this part of the brightest thing there is.
    pub cut: f32,
}

impl Traced {
    /// Before anything is traced.
    pub const NOTHING: Traced = Traced {
        color: Vec3::ZERO,
        rays: 0,
        shadow_rays: 0,
        cut: 0.0,
    };
}

/// A ray that is to be followed.
///
/// Aligned like its vectors: naga refuses a structure within another whose size is no multiple of that.
#[derive(Clone, Copy)]
#[repr(align(16))]
struct Pending {
    origin: Vec3,
    /// Reflections and refractions before it.
    depth: u32,
    /// Unit vector, but for the camera's ray.
    direction: Vec3,
    /// What part of its light reaches the eye, linear RGB.
    weight: Vec3,
    /// What it starts inside of.
    media: Media,
}

/// Follows a ray, and what it is reflected and refracted into (T. Whitted, "An improved illumination model for shaded
/// display", CACM 23(6), 1980): ambient, diffuse and specular light of each surface, plus the weighted light of the
/// reflected and of the transmitted ray.
///
/// - A surface's reflected ray has the weight [`crate::material::Material::mirror`], its transmitted one
///   [`crate::material::Material::transmission`]. With the flag `FRESNEL` the angle decides: of the transmission, the
///   reflectance goes to the reflected ray; and where there is no transmission, the mirror is multiplied with it.
///   Where all is reflected (total internal reflection), all of the transmission is, flag or not.
/// - Front and back follow from the face normal and the ray's direction alone. A surface inside a medium of higher
///   priority is passed as if it were not there (see [`Media`]).
/// - A ray whose weight is below the frame's cut-off, beyond its depth, or beyond [`MAX_RAYS`] is cut: it sees the
///   environment as if nothing were in its way, and [`Traced::cut`] counts its weight.
pub fn trace<V: Traversal>(frame: &Frame, world: &World<'_>, ray: &Ray) -> Traced {
    let mut traced = Traced::NOTHING;
    let mut next = Pending {
        origin: ray.origin,
        depth: 0,
        direction: ray.direction,
        weight: Vec3::ONE,
        media: Media::of_eye(frame.media),
    };
    let mut stack: Stack<Pending, { MAX_DEPTH as usize }> = Stack::new(next);
    loop {
        traced.rays += 1;
        let children = follow::<V>(frame, world, &next, &mut traced);
        let mut is_found = false;
        let mut i = 0;
        // One body for both: the environment would be in the kernel twice.
        while i < 2 {
            let child = if i == 0 {
                children.reflected
            } else {
                children.transmitted
            };
            i += 1;
            let weight = max_component(child.weight);
            if weight > frame.cutoff && child.depth <= frame.depth && child.depth <= MAX_DEPTH && traced.rays < MAX_RAYS
            {
                if is_found {
                    // Of rays at the same depth one waits at most, so there is room.
                    stack.push(child);
                } else {
                    next = child;
                    is_found = true;
                }
            } else if weight > 0.0 {
                let appearance = &world.appearance;
                traced.color += child.weight
                    * frame
                        .environment
                        .radiance(appearance.textures, appearance.texels, child.direction);
                if child.depth != OUTSIDE {
                    traced.cut += weight;
                }
            }
        }
        if !is_found {
            if stack.waiting == 0 {
                return traced;
            }
            next = stack.pop();
        }
    }
}

/// What a ray goes on as; weight zero for nothing.
struct Children {
    reflected: Pending,
    transmitted: Pending,
}

/// [`Pending::depth`] of a ray that has left the scene: nobody follows it.
const OUTSIDE: u32 = u32::MAX;

fn follow<V: Traversal>(frame: &Frame, world: &World<'_>, from: &Pending, traced: &mut Traced) -> Children {
    let appearance = &world.appearance;
    let nothing = Pending {
        weight: Vec3::ZERO,
        ..*from
    };
    let mut children = Children {
        reflected: nothing,
        transmitted: nothing,
    };
    let ray = Ray::new(from.origin, from.direction);
    let hit = closest_hit::<V, true>(frame, world, &ray);
    let around = from.media.current(appearance.materials);
    let mut weight = from.weight;
    if around != 0 {
        let absorption = load(appearance.materials, around - 1).absorption;
        // Of a ray that never leaves what absorbs, nothing is left: a miss has the largest `t`.
        weight *= attenuation(absorption, hit.t * ray.direction.length());
    }
    if !hit.is_hit() {
        children.reflected = Pending {
            depth: OUTSIDE,
            weight,
            ..*from
        };
        return children;
    }
    let surface = Surface::new::<true>(frame, world, &ray, &hit);
    let material = &surface.material;
    let mut beyond = from.media;
    let mut from_index = if around == 0 {
        1.0
    } else {
        load(appearance.materials, around - 1).ior
    };
    let mut to_index = from_index;
    if material.is_transmissive() {
        beyond = if surface.from_front {
            from.media.entered(surface.material_id)
        } else {
            from.media.left(surface.material_id)
        };
        let then = beyond.current(appearance.materials);
        // A boundary inside a medium of higher priority, or between equal ones.
        let is_hidden = around != 0 && then == around;
        if is_hidden {
            children.transmitted = Pending {
                origin: surface.back_origin(),
                weight,
                media: beyond,
                ..*from
            };
            return children;
        }
        to_index = if then == 0 {
            1.0
        } else {
            load(appearance.materials, then - 1).ior
        };
        if !surface.from_front && around == 0 {
            // Inside of something that was never entered: its surface is not closed, or the eyes are apart.
            from_index = material.ior;
        }
    }
    let view = -ray.direction.normalize();
    let viewer = Viewer {
        direction: view,
        weight,
        media: from.media,
    };
    let shaded = shade::<V, true>(frame, world, &surface, &viewer, traced);
    traced.color += weight * shaded;

    let mut mirror = material.mirror;
    let mut transmission = material.transmission;
    let has_fresnel = material.flags & FRESNEL != 0;
    if material.is_transmissive() {
        let refraction = refracted(-view, surface.normal, from_index, to_index);
        let reflectance = if refraction.total {
            1.0
        } else if has_fresnel {
            refraction.reflectance
        } else {
            0.0
        };
        mirror += transmission * reflectance;
        transmission *= 1.0 - reflectance;
        // An interpolated normal may refract to the wrong side; the face normal does not.
        let mut direction = refraction.direction;
        if direction.dot(surface.side) >= 0.0 {
            direction = refracted(-view, surface.side, from_index, to_index).direction;
        }
        children.transmitted = Pending {
            origin: surface.back_origin(),
            depth: from.depth + 1,
            direction,
            weight: weight * transmission,
            media: beyond,
        };
    } else if has_fresnel && mirror != Vec3::ZERO {
        mirror *= refracted(-view, surface.normal, from_index, material.ior).reflectance;
    }
    children.reflected = Pending {
        origin: surface.front_origin(),
        depth: from.depth + 1,
        direction: reflected(-view, surface.normal),
        weight: weight * mirror,
        media: from.media,
    };
    children
}
