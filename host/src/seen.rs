//! What is seen through the pixels of a picture, before any light.

use crate::picture::split;
use crate::scene::Scene;
use crate::slots::Slots;
use glam::{Vec3, uvec2};
use oktant_shared::frame::Frame;
use oktant_shared::hit::Hit;
use oktant_shared::ray::Ray;
use oktant_shared::render::sample_ray;
use oktant_shared::sampling::REGULAR;
use oktant_shared::scene::World;
use oktant_shared::surface::Surface;
use oktant_shared::variant::{EVERYTHING, PLAIN};
use rayon::prelude::*;

/// The first surfaces, row by row from the upper left.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Seen {
    /// Pixels in a row.
    pub width: u32,
    /// Where the ray through the middle of each pixel hit; its `t` is the depth along the line of sight. Where two eyes
    /// share a pixel, it is the left one's ray.
    pub hits: Vec<Hit>,
    /// The unit normals that shade, on the side that is seen; zero where nothing was hit.
    pub normals: Vec<Vec3>,
}

impl Seen {
    /// Looks through the middle of each pixel of a frame; `hits` does what [`crate::backend::Backend::hits`] does, on
    /// the scene.
    ///
    /// # Errors
    /// Those of `hits`.
    pub fn new<E>(frame: &Frame, scene: &Scene, hits: impl FnOnce(&Frame) -> Result<Vec<Hit>, E>) -> Result<Self, E> {
        let middles = middles(frame);
        let hits = hits(&middles)?;
        let world = scene.world();
        let surface = surface_of(scene);
        let width = middles.size().x;
        let slots = Slots::of(scene);
        let normals = hits
            .par_iter()
            .enumerate()
            .map(|(index, hit)| {
                if !hit.is_hit() {
                    return Vec3::ZERO;
                }
                let pixel = uvec2(index as u32 % width, index as u32 / width);
                let ray = sample_ray(&middles, pixel, 0);
                surface(&middles, &world, &ray, &slots.placed(hit)).normal
            })
            .collect();
        Ok(Seen { width, hits, normals })
    }

    /// The first rows, and the others.
    pub fn split(self, rows: u32) -> [Seen; 2] {
        let [upper_hits, lower_hits] = split(self.hits, self.width, rows);
        let [upper_normals, lower_normals] = split(self.normals, self.width, rows);
        [(upper_hits, upper_normals), (lower_hits, lower_normals)].map(|(hits, normals)| Seen {
            width: self.width,
            hits,
            normals,
        })
    }
}

/// The frame whose only sample of each pixel is its middle.
pub(crate) fn middles(frame: &Frame) -> Frame {
    Frame {
        samples: 1,
        samples_per_side: 1,
        first_sample: 0,
        sample_count: 1,
        most_samples: 0,
        pattern: REGULAR,
        ..*frame
    }
}

/// What makes a scene's surfaces of its hits.
pub(crate) fn surface_of(scene: &Scene) -> fn(&Frame, &World<'_>, &Ray, &Hit) -> Surface {
    // Of a plain scene no material ids need be there, and nothing bends its normals.
    if scene.material_ids.len() < scene.ids.len() {
        Surface::new::<PLAIN>
    } else {
        Surface::new::<EVERYTHING>
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::backend::Backend;
    use crate::backend::cpu::Cpu;
    use crate::balls;
    use crate::model::Model;
    use crate::progress::silent;
    use crate::sampling::{Pattern, Samples};
    use crate::structure::StructureOptions;
    use crate::view::{Shading, View};
    use oktant_shared::plane::{PLANE, Plane};
    use std::sync::Arc;

    fn seen(view: &View, floor: bool) -> Seen {
        let mut model = Model::of_mesh(balls::balls());
        if floor {
            let low = model.mesh.bounds().unwrap().0;
            model.planes.push(Plane::new(low, Vec3::Y, 0));
        }
        let scene = Arc::new(Scene::of_model(model, &StructureOptions::default(), &silent).unwrap());
        let mut cpu = Cpu::new(scene.clone());
        Seen::new(&view.frame(&scene, 64, 48), &scene, |frame| cpu.hits(frame)).unwrap()
    }

    #[test]
    fn normals_are_of_unit_length_where_something_is_hit() {
        for shading in [Shading::Flat, Shading::Phong] {
            let view = View {
                shading,
                ..View::default()
            };
            let seen = seen(&view, false);
            let hits = seen.hits.iter().filter(|hit| hit.is_hit()).count();
            assert!((100..3000).contains(&hits), "{hits}");
            for (hit, normal) in seen.hits.iter().zip(&seen.normals) {
                let wanted = if hit.is_hit() { 1.0 } else { 0.0 };
                assert!((normal.length() - wanted).abs() < 1e-5, "{normal}");
            }
        }
    }

    #[test]
    fn flat_normals_are_those_of_the_triangles_that_are_named() {
        let mesh = balls::balls();
        let view = View {
            shading: Shading::Flat,
            ..View::default()
        };
        let seen = seen(&view, false);
        let mut hits = 0;
        for (hit, normal) in seen.hits.iter().zip(&seen.normals).filter(|(hit, _)| hit.is_hit()) {
            let [a, b, c] = mesh.triangles[hit.triangle as usize].map(|vertex| mesh.positions[vertex as usize]);
            let face = (b - a).cross(c - a).normalize();
            assert!(
                normal.dot(face).abs() > 0.9999,
                "{normal} is not the normal of {}",
                hit.triangle
            );
            hits += 1;
        }
        assert!(hits > 100, "{hits}");
    }

    #[test]
    fn a_floor_is_seen_from_above_however_many_samples_there_are() {
        let one = seen(&View::default(), true);
        let mut floor = 0;
        for (hit, normal) in one.hits.iter().zip(&one.normals) {
            if hit.is_hit() && hit.triangle & PLANE != 0 {
                assert_eq!((*normal, hit.triangle), (Vec3::Y, PLANE));
                floor += 1;
            }
        }
        assert!(floor > 100, "{floor}");
        let many = View {
            samples: Samples::Sixteen,
            pattern: Pattern::Rotated,
            ..View::default()
        };
        assert_eq!(seen(&many, true), one);
    }
}
