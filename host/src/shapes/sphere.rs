//! A sphere.

use super::grid::{GridVertex, add_grid};
use crate::mesh::Mesh;
use glam::{Vec3, vec2, vec3};
use std::f64::consts::{PI, TAU};

/// Triangles of a sphere of `stacks` stacks, 2 and up, and twice as many slices.
const fn triangles(stacks: u32) -> u32 {
    4 * stacks * (stacks - 1)
}

/// Stacks of the finest sphere with at most so many triangles, 8 and up.
fn stacks(most: u32) -> u32 {
    let mut stacks = 2;
    while triangles(stacks + 1) <= most {
        stacks += 1;
    }
    stacks
}

/// How many triangles [`sphere`] makes where at most so many are wanted: the largest `4 n (n - 1)` not above it.
pub fn sphere_triangles(most: u32) -> u32 {
    triangles(stacks(most))
}

/// A sphere about the origin, of at most so many triangles, 8 and up: all vertices lie on it, and their normals are
/// its own. Texture coordinates are longitude (from the back, eastwards) and latitude (from the south pole), 0 to 1.
pub fn sphere(radius: f32, most: u32) -> Mesh {
    let stacks = stacks(most);
    let slices = 2 * stacks;
    let mut mesh = Mesh::default();
    add_grid(&mut mesh, [slices, stacks], |slice, stack| {
        let normal = direction(slice % slices, slices, stack, stacks);
        GridVertex {
            position: normal * radius,
            normal,
            coordinates: vec2(slice as f32 / slices as f32, stack as f32 / stacks as f32),
        }
    });
    mesh
}

/// From the south pole at stack 0 up to the north pole.
fn direction(slice: u32, slices: u32, stack: u32, stacks: u32) -> Vec3 {
    if stack == 0 {
        return Vec3::NEG_Y;
    }
    if stack == stacks {
        return Vec3::Y;
    }
    let (longitude_sin, longitude_cos) = (TAU * f64::from(slice) / f64::from(slices)).sin_cos();
    let (latitude_sin, latitude_cos) = (PI * (f64::from(stack) / f64::from(stacks) - 0.5)).sin_cos();
    vec3(
        (-longitude_sin * latitude_cos) as f32,
        latitude_sin as f32,
        (-longitude_cos * latitude_cos) as f32,
    )
}
