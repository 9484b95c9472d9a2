//! The whole body of the kernel.

use crate::adaptive::{Mark, level_of, packed};
use crate::arithmetic::max_component;
use crate::frame::Frame;
use crate::hit::Hit;
use crate::medium::Media;
use crate::plane::PLANE;
use crate::ray::Ray;
use crate::sampling::{Batch, sample};
use crate::scene::{Scene, World};
use crate::shading::{Viewer, shade};
use crate::stereo::EyeView;
use crate::surface::Surface;
use crate::trace::closest_hit;
use crate::traversal::Traversal;
use crate::variant::{EVERYTHING, GLASS, MIRRORS};
use crate::whitted::{Traced, surroundings, trace};
use glam::{UVec2, Vec2, Vec3, Vec4};

/// The ray of a pixel's sample; where two eyes share the pixel, the left one's.
pub fn sample_ray(frame: &Frame, pixel: UVec2, number: u32) -> Ray {
    let place = sample(frame, &Batch::of_frame(frame), number).place;
    ray_of(frame, &EyeView::new(frame, pixel, 0), place)
}

#[inline]
fn ray_of(frame: &Frame, view: &EyeView, place: Vec2) -> Ray {
    let (x, y) = (view.pixel.x as f32 + place.x, view.pixel.y as f32 + place.y);
    frame.camera.ray(x, y, view.eye)
}

/// What a pixel's samples came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pixel {
    /// The weighted sum of the colours, linear RGB, of this pass's samples, and in `w` the sum of their weights.
    pub sum: Vec4,
    /// Closest-hit rays, shadow rays, and the weight that was cut (see [`Traced`]), largest channel, times the sample's,
    /// summed over the samples; `w` is 0.
    pub work: Vec4,
    /// What adaptive sampling wants to know of them; of the middle, if the first of them is the pixel's only one.
    pub mark: Mark,
}

/// Renders a batch of a pixel's samples, there is at least one, with what the needs of [`crate::variant`] have; what
/// else there is, is ignored.
pub fn render_pixel<V: Traversal, const NEEDS: u32>(
    frame: &Frame,
    world: &World<'_>,
    pixel: UVec2,
    batch: &Batch,
) -> Pixel {
    let world = &World {
        scene: Scene {
            parts: V::parts(world.scene.parts),
            ..world.scene
        },
        ..*world
    };
    let mut result = Pixel {
        sum: Vec4::ZERO,
        work: Vec4::ZERO,
        mark: Mark::of_level(level_of(batch.samples)),
    };
    let eyes = EyeView::eyes(frame);
    let mut number = 0;
    loop {
        let sample = sample(frame, batch, batch.first + number / eyes);
        let view = EyeView::new(frame, pixel, number % eyes);
        let ray = ray_of(frame, &view, sample.place);
        let traced = if NEEDS & (MIRRORS | GLASS) != 0 {
            trace::<V, NEEDS>(frame, world, &ray)
        } else {
            first_surface::<V, NEEDS>(frame, world, &ray)
        };
        let (color, weight) = view.share(frame, traced.color * sample.weight, sample.weight);
        result.sum += color.extend(weight);
        let cut = max_component(traced.cut) * sample.weight;
        result.work += Vec4::new(traced.rays as f32, traced.shadow_rays as f32, cut, 0.0);
        if frame.most_samples != 0 {
            if number < eyes {
                // What either eye sees.
                result.mark.seen = result.mark.seen.rotate_left(16) ^ traced.seen;
                result.mark.nearness = traced.nearness;
                result.mark.normal = packed(traced.normal);
            }
            result.mark = result.mark.with(frame, traced.color);
        }
        number += 1;
        if number >= batch.count * eyes {
            return result;
        }
    }
}

/// The colour of the first surface that a ray meets.
#[inline]
fn first_surface<V: Traversal, const NEEDS: u32>(frame: &Frame, world: &World<'_>, ray: &Ray) -> Traced {
    let mut traced = Traced {
        rays: 1,
        ..Traced::NOTHING
    };
    let hit = closest_hit::<V, NEEDS>(frame, world, ray);
    traced.color = if hit.is_hit() {
        let surface = Surface::new::<NEEDS>(frame, world, ray, &hit);
        traced.sees(surface.material_id + 1);
        traced.meets(&hit, &surface);
        let viewer = Viewer {
            direction: -ray.direction.normalize(),
            weight: Vec3::ONE,
            media: Media::AIR,
            is_seen: true,
        };
        shade::<V, NEEDS>(frame, world, &surface, &viewer, &mut traced)
    } else {
        surroundings::<NEEDS>(frame, world, ray.direction)
    };
    traced
}

/// What the first sample of this pass sees through a pixel.
pub fn hit_pixel<V: Traversal>(frame: &Frame, world: &World<'_>, pixel: UVec2) -> Hit {
    let hit = closest_hit::<V, EVERYTHING>(frame, world, &sample_ray(frame, pixel, frame.first_sample));
    if hit.triangle & PLANE != 0 {
        hit
    } else {
        world.scene.identified(hit)
    }
}
