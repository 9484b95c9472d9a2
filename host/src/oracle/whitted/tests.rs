//! The parts of the reference against what is known without it. Whole pictures are compared with those of the other
//! renderers in `tests/tests/reference_renderer.rs`.

use super::optics::{Refraction, refracted};
use super::sampling::samples;
use super::{Reference, Takes};
use crate::balls;
use crate::model::{Model, plain_material};
use crate::progress::silent;
use crate::sampling::{Filter, Pattern};
use crate::view::{Place, View};
use glam::{DVec2, DVec3, Vec3};
use oktant_shared::environment::Environment;
use oktant_shared::light::{AREA, Light};
use oktant_shared::material::{FRESNEL, Material};
use oktant_shared::plane::Plane;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

#[test]
fn grids_fill_the_pixel_evenly() {
    for pattern in [Pattern::Regular, Pattern::Rotated] {
        for side in [1, 2, 4, 32] {
            let samples = samples(side, pattern, Filter::Box);
            let mean = samples.iter().map(|sample| sample.place).sum::<DVec2>() / samples.len() as f64;
            assert!(
                mean.abs_diff_eq(DVec2::splat(0.5), 1e-12),
                "{pattern:?}, {side}: {mean}"
            );
            // Each cell of the grid holds one.
            let mut cells: Vec<_> = samples
                .iter()
                .map(|sample| (sample.place * f64::from(side)).floor().as_uvec2().to_array())
                .collect();
            cells.sort_unstable();
            cells.dedup();
            assert_eq!(cells.len(), (side * side) as usize, "{pattern:?}, {side}");
        }
    }
}

#[test]
fn fresnel_and_snell() {
    let at = |degrees: f64, from, to| {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        refracted(DVec3::new(sine, -cosine, 0.0), DVec3::Y, from, to)
    };
    let Refraction::Partial { reflectance, direction } = at(0.0, 1.0, 1.5) else {
        panic!("straight on")
    };
    assert!((reflectance - 0.04).abs() < 1e-15 && direction == DVec3::NEG_Y);
    // Brewster's angle: of the polarisation in the plane nothing is reflected, of the other (n^2 - 1)^2 / (n^2 + 1)^2.
    let Refraction::Partial { reflectance, direction } = at(1.5_f64.atan().to_degrees(), 1.0, 1.5) else {
        panic!("into the denser")
    };
    assert!((reflectance - 0.5 * (1.25_f64 / 3.25).powi(2)).abs() < 1e-15);
    assert!((direction.x - 1.5_f64.atan().sin() / 1.5).abs() < 1e-15);
    let critical = (1.0 / 1.5_f64).asin().to_degrees();
    assert_eq!(at(critical + 1e-9, 1.5, 1.0), Refraction::Total);
    assert!(matches!(at(critical - 1e-9, 1.5, 1.0), Refraction::Partial { .. }));
}

fn pixels(model: Model, view: &View, takes: Takes) -> Vec<Vec3> {
    let reference = Reference::new(Arc::new(model)).unwrap();
    let sitting = reference.sitting(view, [32, 24], takes);
    let picture = sitting.render(&AtomicBool::new(false), &silent).unwrap();
    picture.sums.iter().map(|sum| sum.truncate() / sum.w).collect()
}

/// Glass that absorbs nothing, in surroundings that are bright everywhere, is not to be seen: what is not reflected goes
/// through.
#[test]
fn clear_glass_in_a_furnace_is_not_to_be_seen() {
    let mut model = Model::of_mesh(balls::balls());
    model.materials[0] = Material {
        base: Vec3::ZERO,
        specular: Vec3::ZERO,
        transmission: Vec3::ONE,
        ior: 1.5,
        flags: model.materials[0].flags | FRESNEL,
        ..plain_material()
    };
    model.environment = Environment::constant(Vec3::ONE);
    let view = View {
        depth: 8,
        ..View::default()
    };
    for color in pixels(model, &view, Takes::Grid(2)) {
        assert!(color.abs_diff_eq(Vec3::ONE, 1e-6), "{color}");
    }
}

/// A plane below an area light that is small and far: `cosine^2 / distance^2`, as for a point that shines downwards.
#[test]
fn an_area_light_over_a_plane() {
    let mut model = Model::of_mesh(Default::default());
    model.planes = vec![Plane::new(Vec3::ZERO, Vec3::Y, 0)];
    model.materials[0] = Material {
        base: Vec3::ONE,
        ambient: 0.0,
        diffuse: 1.0,
        specular: Vec3::ZERO,
        ..plain_material()
    };
    model.lights[0] = Light {
        kind: AREA,
        // Seen from below it is its front.
        edge_u: Vec3::X * 1e-3,
        edge_v: Vec3::Z * 1e-3,
        samples_per_side: 3,
        falloff_radius: 1e-3,
        ..model.lights[0]
    };
    let view = View {
        light: Place {
            azimuth: 0.0,
            elevation: 90.0,
            distance: 2.0,
        },
        camera: Place {
            azimuth: 0.0,
            elevation: 90.0,
            distance: 4.0,
        },
        ..View::default()
    };
    let half_height = 4.0 * 20_f64.to_radians().tan();
    for (i, color) in pixels(model, &view, Takes::Grid(1)).into_iter().enumerate() {
        let (x, y) = ((i % 32) as f64 + 0.5, (i / 32) as f64 + 0.5);
        let step = 2.0 * half_height / 24.0;
        let squared = ((x - 16.0) * step).powi(2) + ((y - 12.0) * step).powi(2) + 4.0;
        let wanted = 4.0 / squared / squared;
        assert!(
            (f64::from(color.x) - wanted).abs() < 1e-6,
            "{i}: {} and {wanted}",
            color.x
        );
    }
}

/// The mean of more samples of an edge comes nearer to the part of the pixel that it covers.
#[test]
fn more_samples_are_nearer_to_the_whole() {
    let picture = |takes| pixels(Model::of_mesh(balls::balls()), &View::default(), takes);
    let wanted = picture(Takes::Grid(32));
    let errors = [1, 2, 4, 8].map(|side| {
        let is = picture(Takes::Grid(side));
        let squares = is.iter().zip(&wanted).map(|(is, wanted)| is.distance_squared(*wanted));
        squares.sum::<f32>().sqrt()
    });
    assert!(errors.is_sorted_by(|more, less| more > &(1.4 * less)), "{errors:?}");
}

#[test]
fn whoever_cancels_gets_no_picture() {
    let reference = Reference::new(Arc::new(Model::of_mesh(balls::balls()))).unwrap();
    let sitting = reference.sitting(&View::default(), [32, 24], Takes::View);
    assert_eq!(sitting.render(&AtomicBool::new(true), &silent), None);
}
