//! The tests of triangles: what both promise, and where they differ.

use super::{Crossing, MollerTrumbore, TriangleTest, Watertight};
use crate::ray::{PreparedRay, Ray};
use crate::triangle::Triangle;
use bytemuck::Zeroable;
use glam::{Vec3, vec3};

fn triangle(corners: [[f32; 3]; 3]) -> Triangle {
    Triangle {
        a: corners[0].into(),
        b: corners[1].into(),
        c: corners[2].into(),
        ..Triangle::zeroed()
    }
}

fn crossing<T: TriangleTest>(triangle: &Triangle, origin: Vec3, direction: Vec3) -> Crossing {
    T::prepare(&PreparedRay::new(&Ray::new(origin, direction))).crossing(triangle)
}

fn common<T: TriangleTest>() {
    let unit = triangle([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let from = |x, y| crossing::<T>(&unit, vec3(x, y, -2.0), Vec3::Z);
    for (x, y) in [
        (0.25, 0.25),
        (0.0, 0.0),
        (1.0, 0.0),
        (0.0, 1.0),
        (0.5, 0.5),
        (0.5, 0.0),
        (0.0, 0.5),
    ] {
        let hit = from(x, y);
        assert!(hit.crosses, "({x}, {y})");
        assert_eq!((hit.t, hit.u, hit.v), (2.0, x, y), "({x}, {y})");
        let behind = crossing::<T>(&unit, vec3(x, y, 2.0), Vec3::Z);
        assert!(behind.crosses && behind.t == -2.0, "two-sided, behind the origin");
    }
    for (x, y) in [(-1e-6, 0.5), (0.5, -1e-6), (0.500_001, 0.500_001), (2.0, 0.0)] {
        assert!(!from(x, y).crosses, "({x}, {y})");
    }
    assert!(
        !crossing::<T>(&unit, vec3(-1.0, 0.2, 0.0), Vec3::X).crosses,
        "in the plane"
    );
    let needle = triangle([[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [2.0, 2.0, 2.0]]);
    assert!(!crossing::<T>(&needle, vec3(1.0, 1.0, 0.0), Vec3::Z).crosses, "no area");
    let point = triangle([[1.0, 1.0, 1.0]; 3]);
    assert!(!crossing::<T>(&point, vec3(1.0, 1.0, 0.0), Vec3::Z).crosses, "a point");
    // A triangle of the size of the raw scans' and smaller: an absolute epsilon would lose it.
    for size in [2e-4, 1e-6, 1e-9, 1e6] {
        let small = triangle([[0.0, 0.0, 0.0], [size, 0.0, 0.0], [0.0, size, 0.0]]);
        let hit = crossing::<T>(&small, vec3(size / 4.0, size / 4.0, -size), Vec3::Z);
        assert!(hit.crosses && (hit.t - size).abs() <= 1e-6 * size, "size {size}");
    }
}

#[test]
fn moller_trumbore_common() {
    common::<MollerTrumbore>();
}

#[test]
fn watertight_common() {
    common::<Watertight>();
}

#[test]
fn a_ray_between_two_triangles() {
    // A ray through the edge AC of two triangles of a scan.
    let (a, b) = ([0.0185807, -0.13282, 0.589612], [0.0172833, -0.109403, 0.584628]);
    let (c, d) = ([0.0047078, -0.115145, 0.584423], [0.00386001, -0.133219, 0.585925]);
    let origin = vec3(-0.083_557_74, -0.003_311_134_9, -0.018_921_29);
    let direction = vec3(0.093_284_43, -0.118_228_264, 0.605_221_57);
    let (first, second) = (triangle([a, b, c]), triangle([d, a, c]));
    let either = |x: Crossing, y: Crossing| x.crosses || y.crosses;
    assert!(either(
        crossing::<Watertight>(&first, origin, direction),
        crossing::<Watertight>(&second, origin, direction),
    ));
    assert!(
        !either(
            crossing::<MollerTrumbore>(&first, origin, direction),
            crossing::<MollerTrumbore>(&second, origin, direction),
        ),
        "Moller-Trumbore is known to leak here; if it no longer does, its documentation is wrong"
    );
}

/// Aims at points on the shared edges of a fan of slivers; a ray that crosses no triangle has leaked.
fn leaks<T: TriangleTest>() -> u32 {
    let mut state = 1_u32;
    let mut next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / (1 << 24) as f32
    };
    let centre = vec3(0.1, 0.2, 0.3);
    let mut leaked = 0;
    for _ in 0..20_000 {
        let origin = vec3(next() - 0.5, next() - 0.5, next() - 3.0);
        let rim = [
            vec3(1.0 + next(), next() * 0.1, next()),
            vec3(-next(), 1.0 + next(), next()),
            vec3(-next(), -1.0 - next(), next()),
        ];
        let target = centre + (rim[0] - centre) * next();
        let crosses = |i: usize| {
            let fan = triangle([centre.to_array(), rim[i].to_array(), rim[(i + 1) % 3].to_array()]);
            crossing::<T>(&fan, origin, target - origin).crosses
        };
        leaked += u32::from(!(crosses(0) || crosses(1) || crosses(2)));
    }
    leaked
}

#[test]
fn only_moller_trumbore_leaks_at_shared_edges() {
    assert_eq!(leaks::<Watertight>(), 0);
    assert!(leaks::<MollerTrumbore>() > 100);
}
