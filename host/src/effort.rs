//! What a picture took, and what was left out of it.

use crate::picture::Picture;
use crate::scene::Scene;
use glam::Vec4;
use oktant_shared::display::{STEPS, steps};
use oktant_shared::frame::Frame;
use oktant_shared::present::mean_color;
use rayon::prelude::*;

/// Figures of a rendered picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Effort {
    /// Rays that asked for their closest hit.
    pub closest: f64,
    /// Rays that asked whether a light is seen.
    pub shadow: f64,
    /// The weight of the rays that were not followed, in the pixel where it is greatest: what is missing there is at most
    /// this part of the brightest light that a ray can see ([`Scene::brightest_through`]).
    pub greatest_cut: f64,
    /// The same, in the mean of all pixels that were traced: of interpolated ones it is not known.
    pub mean_cut: f64,
    /// By how many steps of 8 bits a channel of the output can be off for that, in the pixel where it is most; 0 where nobody
    /// said how bright things are.
    pub greatest_steps: f64,
    /// The same, in the mean of all pixels that were traced.
    pub mean_steps: f64,
}

impl Effort {
    /// Of a picture all of whose samples are taken; its scene says how bright things are, its frame how they are shown.
    pub fn new(picture: &Picture, of: Option<(&Scene, &Frame)>) -> Self {
        let of = of.map(|(scene, frame)| (frame, scene.brightest_through(&frame.light)));
        let mut effort = picture
            .sums
            .par_iter()
            .zip(&picture.work)
            .map(|(sum, work)| {
                let cut = cut(*sum, *work);
                let off = of.map_or(0.0, |(frame, brightest)| {
                    // No output has more.
                    f64::from(steps(frame, mean_color(*sum), brightest * cut as f32).min(STEPS))
                });
                Effort {
                    closest: f64::from(work.x),
                    shadow: f64::from(work.y),
                    greatest_cut: cut,
                    mean_cut: cut,
                    greatest_steps: off,
                    mean_steps: off,
                }
            })
            .reduce(Effort::default, Effort::plus);
        effort.divide_means(picture.work.par_iter().filter(|work| work.x > 0.0).count());
        effort
    }

    /// Of some pictures of the same size, as if they were one.
    pub fn together(efforts: &[Effort]) -> Self {
        let mut effort = efforts.iter().copied().fold(Effort::default(), Effort::plus);
        effort.divide_means(efforts.len());
        effort
    }

    /// The greater bounds of two, and the sums of all else.
    fn plus(self, other: Self) -> Self {
        Effort {
            closest: self.closest + other.closest,
            shadow: self.shadow + other.shadow,
            greatest_cut: self.greatest_cut.max(other.greatest_cut),
            mean_cut: self.mean_cut + other.mean_cut,
            greatest_steps: self.greatest_steps.max(other.greatest_steps),
            mean_steps: self.mean_steps + other.mean_steps,
        }
    }

    /// Makes means of sums over so many.
    fn divide_means(&mut self, count: usize) {
        let count = count.max(1) as f64;
        self.mean_cut /= count;
        self.mean_steps /= count;
    }

    /// Both kinds of rays.
    pub fn rays(&self) -> f64 {
        self.closest + self.shadow
    }
}

/// What was cut of a pixel, as a part of its light.
pub(crate) fn cut(sum: Vec4, work: Vec4) -> f64 {
    if sum.w > 0.0 {
        f64::from(work.z) / f64::from(sum.w)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::backend::Backend;
    use crate::backend::cpu::Cpu;
    use crate::balls;
    use crate::model::{Model, plain_material};
    use crate::progress::silent;
    use crate::sampling::{Filter, Samples};
    use crate::structure::StructureOptions;
    use crate::view::View;
    use glam::{Vec3, vec4};
    use oktant_shared::environment::Environment;
    use oktant_shared::material::Material;
    use oktant_shared::plane::Plane;
    use std::sync::Arc;

    #[test]
    fn pixels_are_summed_up() {
        let picture = Picture {
            work: vec![vec4(4.0, 8.0, 0.5, 0.0), vec4(6.0, 1.0, 0.0, 0.0), Vec4::ZERO],
            ..Picture::of_sums(
                3,
                1,
                vec![vec4(1.0, 1.0, 1.0, 4.0), vec4(0.0, 0.0, 0.0, 4.0), Vec4::ZERO],
            )
        };
        assert_eq!(
            Effort::new(&picture, None),
            Effort {
                closest: 10.0,
                shadow: 9.0,
                greatest_cut: 0.125,
                mean_cut: 0.125 / 2.0,
                greatest_steps: 0.0,
                mean_steps: 0.0,
            }
        );
    }

    #[test]
    fn pictures_are_summed_up() {
        let of = |number: f64| Effort {
            closest: number,
            shadow: 2.0 * number,
            greatest_cut: 0.5 / number,
            mean_cut: 0.25 / number,
            greatest_steps: number,
            mean_steps: number / 2.0,
        };
        assert_eq!(
            Effort::together(&[of(1.0), of(4.0)]),
            Effort {
                closest: 5.0,
                shadow: 10.0,
                greatest_cut: 0.5,
                mean_cut: 0.15625,
                greatest_steps: 4.0,
                mean_steps: 1.25,
            }
        );
        assert_eq!(Effort::together(&[]), Effort::default());
    }

    /// Mirrors that reflect all, between two planes of radiance 1 in a black environment: whatever is cut is missing.
    #[test]
    fn what_is_missing_is_what_was_cut() {
        let mut model = Model::of_mesh(balls::balls());
        model.materials[0].mirror = Vec3::ONE;
        (model.materials[0].diffuse, model.materials[0].ambient) = (0.0, 0.0);
        model.materials[0].specular = Vec3::ZERO;
        model.materials.push(Material {
            base: Vec3::ONE,
            diffuse: 0.0,
            specular: Vec3::ZERO,
            ..plain_material()
        });
        model.planes = vec![
            Plane::new(Vec3::NEG_Y, Vec3::Y, 1),
            Plane::new(Vec3::Y * 10.0, Vec3::Y, 1),
        ];
        model.ambient = Vec3::ONE;
        model.environment = Environment::constant(Vec3::ZERO);
        let scene = Arc::new(Scene::of_model(model, &StructureOptions::default(), &silent).unwrap());
        for filter in [Filter::Box, Filter::Tent] {
            let view = View {
                depth: 1,
                samples: Samples::Four,
                filter,
                ..View::default()
            };
            let frame = view.frame(&scene, 64, 48);
            let picture = Cpu::new(scene.clone()).render(&frame, &silent).unwrap();
            let effort = Effort::new(&picture, Some((&scene, &frame)));
            assert!(effort.greatest_steps > 0.1 * 255.0 && effort.greatest_steps > effort.mean_steps);
            assert!(effort.greatest_cut > 0.1 && effort.mean_cut < 0.1, "{effort:?}");
            assert!(effort.closest >= 64.0 * 48.0 * 4.0);
            for (sum, work) in picture.sums.iter().zip(&picture.work) {
                let missing = 1.0 - f64::from(sum.x / sum.w);
                let cut = cut(*sum, *work);
                assert!((missing - cut).abs() < 1e-5, "{missing} is missing, {cut} was cut");
            }
        }
    }
}
