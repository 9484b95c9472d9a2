//! That the rays of each class are what the class says.

use glam::Vec3;
use oktant_shared::ray::Ray;

use super::{CellGrid, RayClass, rays};
use crate::meshes::{flat_grid, icosphere};

const COUNT: usize = 2_000;
const CELLS: CellGrid = CellGrid {
    low: Vec3::splat(-1.25),
    size: 2.5,
    depth: 7,
};

fn sphere_rays(class: RayClass) -> Vec<Ray> {
    rays(class, &icosphere(3), &CELLS, COUNT, 1)
}

fn zeros(vector: Vec3) -> usize {
    vector
        .to_array()
        .into_iter()
        .filter(|&component| component == 0.0)
        .count()
}

fn in_cell_plane(axis: usize, coordinate: f32) -> bool {
    let cells = (coordinate - CELLS.low[axis]) / (CELLS.size / 128.0);
    cells.fract() == 0.0
}

fn planes(ray: &Ray) -> usize {
    (0..3)
        .filter(|&axis| ray.direction[axis].abs() < 1e-10 && in_cell_plane(axis, ray.origin[axis]))
        .count()
}

#[test]
fn numbers_follow_the_order_and_names_differ() {
    for (index, class) in RayClass::ALL.into_iter().enumerate() {
        assert_eq!(class.number() as usize, index + 1);
        assert!(
            RayClass::ALL
                .iter()
                .all(|other| *other == class || other.name() != class.name())
        );
    }
}

#[test]
fn every_class_is_deterministic_finite_and_meets_the_mesh() {
    let sphere = icosphere(3);
    for class in RayClass::ALL {
        let made = rays(class, &sphere, &CELLS, COUNT, 1);
        assert_eq!(made.len(), COUNT);
        assert_eq!(
            format!("{made:?}"),
            format!("{:?}", rays(class, &sphere, &CELLS, COUNT, 1))
        );
        assert_ne!(made, rays(class, &sphere, &CELLS, COUNT, 2));
        assert!(
            made.iter()
                .all(|ray| ray.origin.is_finite() && ray.direction.is_finite())
        );
        // The distance of the ray from the sphere's centre.
        let close = made.iter().filter(|ray| {
            let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3().normalize());
            (origin - direction * direction.dot(origin)).length() < 1.0
        });
        assert!(close.count() > COUNT / 4, "{}", class.name());
    }
}

#[test]
fn aimed_classes_start_as_far_away_as_they_say() {
    let size = 12.0_f32.sqrt();
    for (class, sizes) in [
        (RayClass::AimedNear, 2.0),
        (RayClass::AimedFar, 1e3),
        (RayClass::AimedVeryFar, 1e5),
        (RayClass::AimedAtCorner, 2.0),
    ] {
        for ray in sphere_rays(class) {
            assert!((ray.origin.length() / size / sizes - 1.0).abs() < 0.01);
        }
    }
}

#[test]
fn axis_parallel_classes_have_two_zeros_of_the_right_sign() {
    for class in [
        RayClass::AxisParallel,
        RayClass::NegativeZero,
        RayClass::AxisParallelInCellPlane,
        RayClass::AxisParallelFromInside,
    ] {
        let made = sphere_rays(class);
        assert!(made.iter().all(|ray| zeros(ray.direction) == 2));
        let negative = |ray: &&Ray| {
            ray.direction
                .to_array()
                .iter()
                .any(|x| x.to_bits() == (-0.0_f32).to_bits())
        };
        let expected = match class {
            RayClass::NegativeZero => COUNT..COUNT + 1,
            RayClass::AxisParallelInCellPlane => 1..COUNT,
            _ => 0..1,
        };
        assert!(
            expected.contains(&made.iter().filter(negative).count()),
            "{}",
            class.name()
        );
    }
}

#[test]
fn cell_plane_classes_lie_in_cell_planes() {
    let axis_parallel = sphere_rays(RayClass::AxisParallelInCellPlane);
    assert!(axis_parallel.iter().all(|ray| planes(ray) >= 1));
    assert!(axis_parallel.iter().any(|ray| planes(ray) == 1));
    assert!(axis_parallel.iter().any(|ray| planes(ray) == 2));
    for ray in sphere_rays(RayClass::ZeroComponentInCellPlane) {
        assert_eq!((zeros(ray.direction), planes(&ray)), (1, 1));
    }
    // A plane within the bounds is found even where only some levels have one.
    let flat = rays(RayClass::ZeroComponentInCellPlane, &flat_grid(4), &CELLS, COUNT, 1);
    assert!(
        flat.iter()
            .filter(|ray| ray.direction.z == 0.0 && ray.origin.z == 0.0)
            .count()
            > COUNT / 6
    );
}

#[test]
fn diagonals_pass_cell_corners_exactly() {
    for ray in sphere_rays(RayClass::DiagonalThroughCorner) {
        let direction = ray.direction;
        assert_eq!(direction.abs(), Vec3::splat(direction.x.abs()));
        // All coordinates are multiples of the finest cell, and all components of equal size: the ray passes a
        // corner of the finest cells again and again.
        assert!((0..3).all(|axis| in_cell_plane(axis, ray.origin[axis])));
    }
}

#[test]
fn small_components_are_as_small_as_they_say() {
    for (class, sizes) in [
        (RayClass::TinyComponents, &[1e-20, 1e-30][..]),
        (RayClass::DenormalComponents, &[1e-39]),
    ] {
        let made = sphere_rays(class);
        for ray in &made {
            let small = ray.direction.to_array().into_iter().filter(|x| x.abs() < 1e-10);
            let small: Vec<f32> = small.map(f32::abs).collect();
            assert!((1..=2).contains(&small.len()));
            assert!(small.iter().all(|size| sizes.contains(size)));
        }
        let in_planes = made.iter().filter(|ray| planes(ray) > 0).count();
        assert!((COUNT / 3..COUNT * 2 / 3).contains(&in_planes));
    }
}
