//! The tree of a ray's reflections and refractions.

use crate::adaptive::{NO_NORMAL, packed};
use crate::arithmetic::{greater, max_component};
use crate::buffer::{Stack, load};
use crate::display::steps;
use crate::frame::Frame;
use crate::hit::Hit;
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
use crate::variant::{GLASS, IMAGE};
use glam::Vec3;

/// A ray is followed through at most so many reflections and refractions, one after the other. One more is the size of the
/// stack: of two rays that leave a surface one waits there while the other is followed.
pub const MAX_DEPTH: u32 = 16;

/// When a sample has followed so many rays, only those that wait already are followed too; the rest is cut.
pub const MAX_RAYS: u32 = 4096;

/// What a sample saw goes into its [`Traced::seen`] down to so many reflections and refractions: into a glass and out again.
const SEEN_DEPTH: u32 = 2;

/// What became of a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Traced {
    /// Linear RGB.
    pub color: Vec3,
    /// Rays that asked for their closest hit, the camera's included.
    pub rays: u32,
    /// Rays that asked whether a light is seen.
    pub shadow_rays: u32,
    /// The weight of the rays, shadow rays too, that were not followed, of each its largest channel, summed up: what the colour
    /// is off by is at most this part of the brightest thing there is.
    pub cut: f32,
    /// A number made of the materials that were met and of the lights that reach them: differs where something else is seen.
    pub seen: u32,
    /// One by the `t` of the first hit; 0 where there is none.
    pub nearness: f32,
    /// Normal of the first surface, see [`packed`]; of zero where there is none.
    pub normal: u32,
}

impl Traced {
    /// Before anything is traced.
    pub const NOTHING: Traced = Traced {
        color: Vec3::ZERO,
        rays: 0,
        shadow_rays: 0,
        cut: 0.0,
        seen: 0,
        nearness: 0.0,
        normal: NO_NORMAL,
    };

    /// Takes note of something that is seen.
    #[inline]
    pub fn sees(&mut self, what: u32) {
        // As G. Fowler, L. C. Noll and K.-P. Vo hash bytes.
        self.seen = (self.seen ^ what).wrapping_mul(0x0100_0193);
    }

    /// Takes note of what the camera's ray met first.
    #[inline]
    pub fn meets(&mut self, hit: &Hit, surface: &Surface) {
        self.nearness = 1.0 / greater(hit.t, f32::MIN_POSITIVE);
        self.normal = packed(surface.normal);
    }
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
/// - A ray that could not be seen in the output, together with all that was cut before (R. A. Hall, D. P. Greenberg, "A
///   testbed for realistic image synthesis", IEEE CG&A 3(8), 1983; here by [`steps`], not by the weight alone), or is beyond
///   the frame's depth or [`MAX_RAYS`], is cut: it sees the environment as if nothing were in its way, and [`Traced::cut`]
///   counts its weight. Of two rays that leave a surface the one of more weight is followed first: the brighter a pixel is
///   already, the less the other may show.
///
/// Without [`GLASS`] among the needs no ray is transmitted, and none waits.
pub fn trace<V: Traversal, const NEEDS: u32>(frame: &Frame, world: &World<'_>, ray: &Ray) -> Traced {
    let mut traced = Traced::NOTHING;
    let mut next = Pending {
        origin: ray.origin,
        depth: 0,
        direction: ray.direction,
        weight: Vec3::ONE,
        media: Media::of_eye(frame.media),
    };
    let mut stack: Stack<Pending, { MAX_DEPTH as usize + 1 }> = Stack::new(next);
    loop {
        traced.rays += 1;
        let children = follow::<V, NEEDS>(frame, world, &next, &mut traced);
        next = children.reflected;
        if NEEDS & GLASS != 0 {
            let mut other = children.transmitted;
            if max_component(other.weight) > max_component(next.weight) {
                next = children.transmitted;
                other = children.reflected;
            }
            if other.weight != Vec3::ZERO {
                // Of rays at the same depth one waits at most, so there is room.
                stack.push(other);
            }
        }
        while !goes_on(frame, &next, &traced) {
            leave::<NEEDS>(frame, world, &next, &mut traced);
            if NEEDS & GLASS == 0 || stack.waiting == 0 {
                return traced;
            }
            next = stack.pop();
        }
    }
}

/// Whether a ray is followed.
#[inline]
fn goes_on(frame: &Frame, ray: &Pending, traced: &Traced) -> bool {
    let is_wanted = (ray.weight != Vec3::ZERO) & (ray.depth <= frame.depth) & (ray.depth <= MAX_DEPTH);
    if !(is_wanted & (traced.rays < MAX_RAYS)) {
        return false;
    }
    if frame.cutoff == 0.0 {
        return true;
    }
    steps(frame, traced.color, ray.weight * frame.brightest) > frame.cutoff
}

/// What a ray that is not followed contributes, or that has left the scene.
fn leave<const NEEDS: u32>(frame: &Frame, world: &World<'_>, ray: &Pending, traced: &mut Traced) {
    if ray.weight == Vec3::ZERO {
        return;
    }
    traced.color += ray.weight * surroundings::<NEEDS>(frame, world, ray.direction);
    if ray.depth != OUTSIDE {
        traced.cut += max_component(ray.weight);
    }
}

/// What is seen in a direction where nothing is in the way.
#[inline]
pub fn surroundings<const NEEDS: u32>(frame: &Frame, world: &World<'_>, direction: Vec3) -> Vec3 {
    if NEEDS & IMAGE != 0 {
        let appearance = &world.appearance;
        frame
            .environment
            .radiance(appearance.textures, appearance.texels, direction)
    } else {
        frame.environment.gradient(direction)
    }
}

/// What a ray goes on as; weight zero for nothing.
struct Children {
    reflected: Pending,
    transmitted: Pending,
}

/// [`Pending::depth`] of a ray that has left the scene: nobody follows it.
const OUTSIDE: u32 = u32::MAX;

fn follow<V: Traversal, const NEEDS: u32>(
    frame: &Frame,
    world: &World<'_>,
    from: &Pending,
    traced: &mut Traced,
) -> Children {
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
    let hit = closest_hit::<V, NEEDS>(frame, world, &ray);
    let around = if NEEDS & GLASS != 0 {
        from.media.current(appearance.materials)
    } else {
        0
    };
    let mut weight = from.weight;
    if NEEDS & GLASS != 0 && around != 0 {
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
    let surface = Surface::new::<NEEDS>(frame, world, &ray, &hit);
    let is_seen = from.depth <= SEEN_DEPTH;
    if is_seen {
        traced.sees(surface.material_id + 1);
    }
    if from.depth == 0 {
        traced.meets(&hit, &surface);
    }
    if NEEDS & GLASS != 0 && around != 0 && surface.material.is_transmissive() {
        // A boundary inside a medium of higher priority, or between equal ones.
        let beyond = beyond(from, &surface);
        if beyond.current(appearance.materials) == around {
            children.transmitted = Pending {
                origin: surface.back_origin(),
                weight,
                media: beyond,
                ..*from
            };
            return children;
        }
    }
    let view = -ray.direction.normalize();
    let viewer = Viewer {
        direction: view,
        weight,
        media: from.media,
        is_seen,
    };
    let shaded = shade::<V, NEEDS>(frame, world, &surface, &viewer, traced);
    traced.color += weight * shaded;

    // What follows is found out only now, so that none of it is kept in registers across the rays to the lights.
    let material = &surface.material;
    let around = if NEEDS & GLASS != 0 {
        from.media.current(appearance.materials)
    } else {
        0
    };
    let mut from_index = if NEEDS & GLASS == 0 || around == 0 {
        1.0
    } else {
        load(appearance.materials, around - 1).ior
    };
    let mut to_index = from_index;
    let mut media = from.media;
    if NEEDS & GLASS != 0 && material.is_transmissive() {
        media = beyond(from, &surface);
        let then = media.current(appearance.materials);
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
    let mut mirror = material.mirror;
    let mut transmission = material.transmission;
    let has_fresnel = material.flags & FRESNEL != 0;
    if NEEDS & GLASS != 0 && material.is_transmissive() {
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
            media,
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

/// What a ray is inside of behind a transmissive surface.
#[inline]
fn beyond(from: &Pending, surface: &Surface) -> Media {
    if surface.from_front {
        from.media.entered(surface.material_id)
    } else {
        from.media.left(surface.material_id)
    }
}
