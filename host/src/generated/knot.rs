//! A closed surface that has its whole shape at any number of triangles.

use crate::mesh::Mesh;
use glam::{DVec3, dvec3};
use std::f64::consts::TAU;

/// Radius of the tube. Its middle is 5.5 x 5.1 x 2 wide; strands that cross are 1.21 apart, and no bend is narrower than 1.28.
const RADIUS: f64 = 0.5;

/// A tube tied into a trefoil knot, closed, its front outside: up to `most` triangles, at least 18, all of about the same size.
///
/// It is smooth, and coarse at once: nothing of it is smaller than the tube, which 1,000 triangles give ten sides and fifty
/// segments. More triangles make it rounder and add no relief, so that what a ray costs more is due to their number
/// alone. Strands pass before each other and shadow each other, as limbs of scanned figures do.
pub fn knot(most: u32) -> Mesh {
    let sides = (most / 10).isqrt().max(3);
    let segments = (most / (2 * sides)).max(3);
    let rings = (0..segments).flat_map(|segment| {
        let turn = TAU * f64::from(segment) / f64::from(segments);
        let (center, across) = (curve(turn), across(turn));
        let up = along(turn).cross(across);
        (0..sides).map(move |side| {
            let (sine, cosine) = (TAU * f64::from(side) / f64::from(sides)).sin_cos();
            (center + RADIUS * (across * cosine + up * sine)).as_vec3()
        })
    });
    let triangles = (0..segments).flat_map(|segment| {
        (0..sides).flat_map(move |side| {
            let at = |along: u32, around: u32| (segment + along) % segments * sides + (side + around) % sides;
            let [a, b, c, d] = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
            [[a, c, b], [a, d, c]]
        })
    });
    Mesh {
        positions: rings.collect(),
        triangles: triangles.collect(),
        ..Mesh::default()
    }
}

/// The middle of the tube: a trefoil, about the axis z.
fn curve(turn: f64) -> DVec3 {
    let twice = 2.0 * turn;
    dvec3(
        turn.sin() + 2.0 * twice.sin(),
        turn.cos() - 2.0 * twice.cos(),
        -(3.0 * turn).sin(),
    )
}

/// Its direction, a unit vector.
fn along(turn: f64) -> DVec3 {
    let twice = 2.0 * turn;
    dvec3(
        turn.cos() + 4.0 * twice.cos(),
        4.0 * twice.sin() - turn.sin(),
        -3.0 * (3.0 * turn).cos(),
    )
    .normalize()
}

/// The unit vector across it that points away from the axis the most.
fn across(turn: f64) -> DVec3 {
    let outwards = curve(turn).with_z(0.0);
    outwards.reject_from_normalized(along(turn)).normalize()
}
