//! A closed surface, and rays from within it, of which each one hits it: what does not is a leak.

use crate::generated::bumpy_ball;
use crate::mesh::Mesh;
use crate::stability::{Aim, at};
use oktant_shared::ray::Ray;

/// What charts call it.
pub const LEAKS: &str = "leaks: rays at edges and corners of a closed ball";

/// Triangles of the ball.
const TRIANGLES: u32 = 20_000;

/// The closed ball, and so many rays from the inner quarter of it, a third each at points on its edges, at its corners and
/// in its triangles; the same ones every time.
pub fn leak_rays(count: usize) -> (Mesh, Vec<Ray>) {
    let mesh = bumpy_ball(TRIANGLES);
    let mut aim = Aim::new(&mesh, 31);
    let rays = (0..count)
        .map(|index| {
            let target = match index % 3 {
                0 => aim.on_edge(),
                1 => aim.vertex(),
                _ => aim.in_triangle(),
            };
            at(aim.within(0.25), target)
        })
        .collect();
    (mesh, rays)
}
