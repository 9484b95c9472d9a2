//! The whole body of the kernel.

use crate::frame::Frame;
use crate::hit::Hit;
use crate::ray::Ray;
use crate::scene::Scene;
use crate::shading::shade;
use crate::traversal::Traversal;
use glam::{UVec2, Vec3, Vec4};

/// The ray of a pixel's sample, on a regular grid in the pixel.
pub fn sample_ray(frame: &Frame, pixel: UVec2, sample: u32) -> Ray {
    let side = frame.samples_per_side;
    let spacing = 1.0 / side as f32;
    frame.camera.ray(
        pixel.x as f32 + ((sample % side) as f32 + 0.5) * spacing,
        pixel.y as f32 + ((sample / side) as f32 + 0.5) * spacing,
    )
}

/// The sum of the colours, linear RGB, of this pass's samples of a pixel, and in `w` their number.
pub fn render_pixel<V: Traversal>(frame: &Frame, scene: &Scene<'_>, pixel: UVec2) -> Vec4 {
    let mut sum = Vec3::ZERO;
    let mut sample = 0;
    while sample < frame.sample_count {
        let ray = sample_ray(frame, pixel, frame.first_sample + sample);
        let hit = V::closest_hit(scene, &ray);
        sum += if hit.is_hit() {
            shade::<V>(frame, scene, &ray, &hit)
        } else {
            frame.background
        };
        sample += 1;
    }
    sum.extend(frame.sample_count as f32)
}

/// What the first sample of this pass sees through a pixel.
pub fn hit_pixel<V: Traversal>(frame: &Frame, scene: &Scene<'_>, pixel: UVec2) -> Hit {
    V::closest_hit(scene, &sample_ray(frame, pixel, frame.first_sample))
}
