//! The whole body of the kernel.

use crate::adaptive::{Mark, level_of};
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

/// What samples of a pixel came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pixel {
    /// The weighted sum of the colours, linear RGB, and in `w` the sum of their weights.
    pub sum: Vec4,
    /// Closest-hit rays, shadow rays, and the weight that was cut (see [`Traced`]) times the sample's, summed over the samples; `w` is 0.
    pub work: Vec4,
    /// What adaptive sampling wants to know of them; of the middle, if the first of them is the pixel's only one.
    pub mark: Mark,
}

/// Renders a batch of a pixel's samples, there is at least one, with what the needs of [`crate::variant`] have; what
/// else there is, is ignored.
///
/// A GPU does the same sample by sample, and keeps what they come to in memory: see [`render_sample`].
pub fn render_pixel<V: Traversal, const NEEDS: u32>(
    frame: &Frame,
    world: &World<'_>,
    pixel: UVec2,
    batch: &Batch,
) -> Pixel {
    let mut result = render_sample::<V, NEEDS>(frame, world, pixel, batch, 0);
    for number in 1..looks(frame, batch) {
        let other = render_sample::<V, NEEDS>(frame, world, pixel, batch, number);
        result.sum += other.sum;
        result.work += other.work;
        result.mark = result.mark.and(&other.mark, batch, number);
    }
    result
}

/// How often a batch looks through a pixel: each eye that shares it takes all samples.
#[inline]
pub fn looks(frame: &Frame, batch: &Batch) -> u32 {
    batch.count * EyeView::eyes(frame)
}

/// Looks once through a pixel; `number` is less than [`looks`] and counts samples, of each one eye after the other.
#[inline(always)]
pub fn render_sample<V: Traversal, const NEEDS: u32>(
    frame: &Frame,
    world: &World<'_>,
    pixel: UVec2,
    batch: &Batch,
    number: u32,
) -> Pixel {
    let world = &World {
        scene: Scene {
            parts: V::parts(world.scene.parts),
            ..world.scene
        },
        ..*world
    };
    let eyes = EyeView::eyes(frame);
    let sample = sample(frame, batch, batch.first + number / eyes);
    let view = EyeView::new(frame, pixel, number % eyes);
    let ray = ray_of(frame, &view, sample.place);
    let traced = if NEEDS & (MIRRORS | GLASS) != 0 {
        trace::<V, NEEDS>(frame, world, &ray)
    } else {
        first_surface::<V, NEEDS>(frame, world, &ray)
    };
    let (color, weight) = view.share(frame, traced.color * sample.weight, sample.weight);
    let mut mark = Mark::of_level(frame, level_of(batch.samples));
    if frame.most_samples != 0 {
        mark = Mark {
            seen: traced.seen,
            nearness: traced.nearness,
            normal: traced.normal,
            ..mark.with(frame, traced.color)
        };
    }
    let cut = traced.cut * sample.weight;
    Pixel {
        sum: color.extend(weight),
        work: Vec4::new(traced.rays as f32, traced.shadow_rays as f32, cut, 0.0),
        mark,
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
