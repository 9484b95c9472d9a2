//! What pixels tell of the work behind them: what they see, what their rays visit and test, how many rays they take.

mod aspect;
mod camera_rays;
mod drawing;
mod figures;
mod legend;
mod palette;
mod references;
mod scale;

pub use aspect::{Aspect, Meaningless};
pub use drawing::Drawing;
pub use figures::Figures;
pub use legend::Legend;
pub use palette::Palette;
pub(crate) use palette::hashed_color;
pub use scale::Scale;

use crate::backend::cpu::Cpu;
use crate::backend::{Backend, BackendError, Query};
use crate::bench::{Counts, count_each};
use crate::progress::Progress;
use crate::scene::Scene;
use crate::seen::{Seen, middles};
use crate::slots::Slots;
use crate::trace::{Layout, Recorder, Visit};
use camera_rays::CameraRays;
use glam::{Vec4, uvec2};
use oktant_shared::frame::Frame;
use oktant_shared::plane::PLANE;
use oktant_shared::ray::Ray;
use oktant_shared::render::sample_ray;
use oktant_shared::trace::nearest_plane;
use palette::{barycentric_color, normal_color};
use rayon::prelude::*;
use references::references;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// What the pixels of a picture tell of one aspect.
#[derive(Clone, Debug, PartialEq)]
pub struct Insight {
    /// What of.
    pub aspect: Aspect,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// What they tell, row by row from the upper left.
    pub values: Values,
}

/// What pixels tell.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// A number each; not a number where there is none.
    Numbers(Vec<f32>),
    /// What is seen first.
    Seen(Seen),
}

/// Pixels that are looked at between two looks at whether that is still wanted.
const BAND: usize = 1 << 13;
/// Of pixels that tell no number, see nothing, or are not looked at yet: no colour of any palette.
const NOTHING: [u8; 3] = [64; 3];

impl Insight {
    /// Asks the pixels of a frame of the scene, on the CPU: one ray through the middle of each, or, of what rays are counted,
    /// all samples. `progress` hears of the stage "counting" or "rendering". None where `cancel` was raised meanwhile.
    ///
    /// The aspect must mean something with the scene's traversal, see [`Aspect::check`].
    ///
    /// # Errors
    /// As [`Backend::hits`].
    pub fn new(
        aspect: Aspect,
        scene: &Arc<Scene>,
        frame: &Frame,
        cancel: &AtomicBool,
        progress: Progress<'_>,
    ) -> Result<Option<Self>, BackendError> {
        let middles = middles(frame);
        let camera = Camera {
            scene,
            middles: &middles,
            cancel,
            progress,
        };
        let counted = |number: fn(&Counts) -> u64| {
            camera.numbers(|rays| {
                let counts = count_each(scene, scene.parts, Query::Closest, rays);
                counts.iter().map(|counts| number(counts) as f32).collect()
            })
        };
        let of_leaf = |number: fn(&Visit) -> u32| {
            let (recorder, layout) = (Recorder::new(scene), Layout::new(scene));
            let of = |ray: &Ray| {
                let leaf = layout.leaf_of_hit(scene, &recorder.record(scene, ray));
                leaf.map_or(f32::NAN, |leaf| number(&leaf) as f32)
            };
            camera.numbers(|rays| rays.par_iter().map(of).collect())
        };
        let of_work = |number: fn(&Vec4) -> f32| {
            let picture = Cpu::new(scene.clone()).render_unless(frame, cancel, progress)?;
            Some(picture.work.iter().map(number).collect())
        };
        let numbers = match aspect {
            Aspect::Normals | Aspect::Ids | Aspect::Barycentrics => {
                let seen = Seen::new(frame, scene, |frame| Cpu::new(scene.clone()).hits(frame))?;
                return Ok(Some(Insight {
                    aspect,
                    size: middles.size().into(),
                    values: Values::Seen(seen),
                }));
            }
            Aspect::Depth => {
                let hits = Cpu::new(scene.clone()).hits(&middles)?;
                let depths = hits.iter().map(|hit| if hit.is_hit() { hit.t } else { f32::NAN });
                Some(depths.collect())
            }
            Aspect::Steps => counted(|counts| counts.nodes),
            Aspect::Tests => counted(|counts| counts.triangle_tests),
            Aspect::LeafDepth => of_leaf(|leaf| leaf.depth),
            Aspect::LeafFill => of_leaf(|leaf| leaf.triangles),
            Aspect::References => {
                let (references, slots) = (references(scene), Slots::of(scene));
                let hits = Cpu::new(scene.clone()).hits(&middles)?;
                let counts = hits.iter().map(|hit| {
                    // A plane, or nothing.
                    if hit.triangle & PLANE != 0 {
                        f32::NAN
                    } else {
                        references[slots.placed(hit).triangle as usize] as f32
                    }
                });
                Some(counts.collect())
            }
            Aspect::ShadowRays => of_work(|work| work.y),
            Aspect::RecursionRays => {
                let mut camera_rays = CameraRays::new(frame);
                let picture = Cpu::new(scene.clone())
                    .render_watched(frame, cancel, progress, |picture| camera_rays.count(picture));
                picture.map(|picture| {
                    let rays = picture.work.iter().zip(&camera_rays.counts);
                    rays.map(|(work, camera)| work.x - camera).collect()
                })
            }
            Aspect::Rays => of_work(|work| work.x + work.y),
        };
        Ok(numbers.map(|numbers| Insight {
            aspect,
            size: middles.size().into(),
            values: Values::Numbers(numbers),
        }))
    }

    /// The numbers, if the pixels tell some.
    pub fn numbers(&self) -> Option<&[f32]> {
        match &self.values {
            Values::Numbers(numbers) => Some(numbers),
            Values::Seen(_) => None,
        }
    }

    /// The colour of a pixel by its place in the list, sRGB-encoded; numbers need a scale.
    pub fn color(&self, index: usize, scale: Option<&Scale>) -> [u8; 3] {
        match (&self.values, scale) {
            (Values::Numbers(numbers), Some(scale)) if !numbers[index].is_nan() => {
                self.aspect.palette().color(scale.place(f64::from(numbers[index])))
            }
            (Values::Seen(seen), _) if seen.hits[index].is_hit() => {
                let hit = &seen.hits[index];
                match self.aspect {
                    Aspect::Normals => normal_color(seen.normals[index]),
                    Aspect::Barycentrics => barycentric_color(hit.u, hit.v),
                    _ => hashed_color(hit.triangle),
                }
            }
            _ => NOTHING,
        }
    }
}

/// The camera's rays, through the middles of the pixels.
struct Camera<'a> {
    scene: &'a Scene,
    middles: &'a Frame,
    cancel: &'a AtomicBool,
    progress: Progress<'a>,
}

impl Camera<'_> {
    /// The ray of a pixel. It ends at the nearest plane: as when pictures are rendered, no triangle is looked for behind it.
    fn ray(&self, index: usize) -> Ray {
        let width = self.middles.size().x;
        let pixel = uvec2(index as u32 % width, index as u32 / width);
        shortened(self.scene, sample_ray(self.middles, pixel, 0))
    }

    /// A number for each ray, of which many are given at a time; none where that is not wanted any more.
    fn numbers(&self, of: impl Fn(&[Ray]) -> Vec<f32>) -> Option<Vec<f32>> {
        let size = self.middles.size();
        let pixels = size.x as usize * size.y as usize;
        let mut numbers = Vec::with_capacity(pixels);
        while numbers.len() < pixels {
            if self.cancel.load(Ordering::Relaxed) {
                return None;
            }
            let end = (numbers.len() + BAND).min(pixels);
            let rays: Vec<Ray> = (numbers.len()..end)
                .into_par_iter()
                .map(|index| self.ray(index))
                .collect();
            numbers.extend(of(&rays));
            (self.progress)("counting", end as f32 / pixels as f32);
        }
        Some(numbers)
    }
}

/// A ray that ends at the scene's nearest plane, if it meets one.
pub(crate) fn shortened(scene: &Scene, ray: Ray) -> Ray {
    Ray {
        t_max: nearest_plane(&scene.planes, scene.plane_count, &ray).t,
        ..ray
    }
}

#[cfg(test)]
mod tests;
