//! The special cases of slab tests, for both tests.

use super::{BoxTest, KayKajiya, Williams};
use crate::aabb::Aabb;
use crate::ray::{PreparedRay, Ray};
use glam::{Vec3, vec3};

fn hits<B: BoxTest>(aabb: &Aabb, origin: Vec3, direction: Vec3) -> bool {
    let ray = PreparedRay::new(&Ray::new(origin, direction));
    let inside = B::prepare(&ray).interval(aabb);
    ray.valid && inside.enter <= inside.exit && inside.exit >= 0.0
}

const UNIT: Aabb = Aabb {
    low: Vec3::ZERO,
    high: Vec3::ONE,
};

fn special_cases<B: BoxTest>() {
    let flat = Aabb {
        low: Vec3::ZERO,
        high: vec3(1.0, 1.0, 0.0),
    };
    let cases = [
        (
            "along the face x = 0",
            UNIT,
            vec3(0.0, 0.5, -1.0),
            vec3(0.0, 0.0, 1.0),
            true,
        ),
        (
            "along the face x = 1",
            UNIT,
            vec3(1.0, 0.5, -1.0),
            vec3(0.0, 0.0, 1.0),
            true,
        ),
        (
            "along x = 0, negative zero",
            UNIT,
            vec3(0.0, 0.5, -1.0),
            vec3(-0.0, 0.0, 1.0),
            true,
        ),
        (
            "inside, negative zeros",
            UNIT,
            vec3(0.5, 0.5, 0.5),
            vec3(-0.0, -0.0, 1.0),
            true,
        ),
        (
            "in the plane of a flat box",
            flat,
            vec3(-1.0, 0.5, 0.0),
            vec3(1.0, 0.0, 0.0),
            true,
        ),
        (
            "across a flat box",
            flat,
            vec3(0.5, 0.5, -1.0),
            vec3(0.0, 0.0, 1.0),
            true,
        ),
        (
            "beside a flat box",
            flat,
            vec3(-1.0, 0.5, 1e-6),
            vec3(1.0, 0.0, 0.0),
            false,
        ),
        ("along an edge", UNIT, vec3(1.0, 1.0, -1.0), vec3(0.0, 0.0, 1.0), true),
        (
            "touching a corner",
            UNIT,
            vec3(-1.0, 1.0, 0.0),
            vec3(1.0, -1.0, 0.0),
            true,
        ),
        (
            "leaving from a face",
            UNIT,
            vec3(1.0, 0.5, 0.5),
            vec3(1.0, 0.0, 0.0),
            true,
        ),
        ("beyond the box", UNIT, vec3(1.5, 0.5, 0.5), vec3(1.0, 0.0, 0.0), false),
        (
            "parallel, outside",
            UNIT,
            vec3(1.5, 0.5, -1.0),
            vec3(0.0, 0.0, 1.0),
            false,
        ),
        (
            "denormal direction",
            UNIT,
            vec3(0.3, 0.4, -2.0),
            vec3(1e-39, -1e-39, 1.0),
            true,
        ),
        (
            "tiny direction",
            UNIT,
            vec3(0.3, 0.4, -2.0),
            vec3(1e-30, -1e-20, 1.0),
            true,
        ),
        ("NaN origin", UNIT, vec3(f32::NAN, 0.5, 0.5), vec3(1.0, 0.0, 0.0), false),
        (
            "NaN direction",
            UNIT,
            vec3(0.5, 0.5, 0.5),
            vec3(f32::NAN, 0.0, 1.0),
            false,
        ),
    ];
    for (name, aabb, origin, direction, expected) in cases {
        assert_eq!(hits::<B>(&aabb, origin, direction), expected, "{name}");
    }
}

#[test]
fn kay_kajiya_special_cases() {
    special_cases::<KayKajiya>();
}

#[test]
fn williams_special_cases() {
    special_cases::<Williams>();
}

fn distances<B: BoxTest>() {
    let ray = PreparedRay::new(&Ray::new(vec3(-1.0, 0.25, 0.5), vec3(1.0, 0.25, 0.0)));
    let inside = B::prepare(&ray).interval(&UNIT);
    assert_eq!(inside.enter, 1.0);
    assert!(inside.exit >= 2.0 && inside.exit < 2.000_001);
    let ray = PreparedRay::new(&Ray::new(vec3(2.0, 0.5, 0.5), vec3(-1.0, 0.0, 0.0)));
    let inside = B::prepare(&ray).interval(&UNIT);
    assert_eq!(inside.enter, 1.0);
    assert!(inside.exit >= 2.0 && inside.exit < 2.000_001);
}

#[test]
fn both_return_where_the_ray_enters_and_leaves() {
    distances::<KayKajiya>();
    distances::<Williams>();
}
