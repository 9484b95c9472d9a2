//! A closed surface of any number of triangles.

use crate::mesh::Mesh;
use glam::{DVec3, dvec3};

/// A ball of radius 1 with bumps of up to a tenth of that, closed, its front outside: as many triangles as the largest
/// `8 n^2` up to `most` has, at least 8, all of about the same size.
///
/// The faces of an octahedron are cut into n^2 triangles each and blown up.
pub fn bumpy_ball(most: u32) -> Mesh {
    let parts = (most / 8).isqrt().max(1);
    let rings = 2 * parts;
    let mut mesh = Mesh::default();
    // Where each ring begins among the vertices.
    let mut starts = Vec::new();
    for ring in 0..=rings {
        starts.push(mesh.positions.len() as u32);
        let segments = segments(ring, parts);
        for place in 0..(4 * segments).max(1) {
            let on_ball = on_octahedron(ring, place, parts).normalize();
            mesh.positions.push((on_ball * height(on_ball)).as_vec3());
        }
    }
    for ring in 0..rings {
        let (upper, lower) = (segments(ring, parts), segments(ring + 1, parts));
        let at = |ring: u32, segments: u32, place: u32| starts[ring as usize] + place % (4 * segments).max(1);
        for quarter in 0..4 {
            let above = |i| at(ring, upper, quarter * upper + i);
            let below = |i| at(ring + 1, lower, quarter * lower + i);
            if lower > upper {
                mesh.triangles
                    .extend((0..lower).map(|i| [above(i), below(i), below(i + 1)]));
                mesh.triangles
                    .extend((0..upper).map(|i| [above(i), below(i + 1), above(i + 1)]));
            } else {
                mesh.triangles
                    .extend((0..upper).map(|i| [above(i), below(i), above(i + 1)]));
                mesh.triangles
                    .extend((0..lower).map(|i| [below(i), below(i + 1), above(i + 1)]));
            }
        }
    }
    mesh
}

/// Parts of a quarter of a ring; rings go from the top, number 0, to the bottom.
fn segments(ring: u32, parts: u32) -> u32 {
    ring.min(2 * parts - ring)
}

/// A vertex of a ring, counted eastwards from +z, on an octahedron.
fn on_octahedron(ring: u32, place: u32, parts: u32) -> DVec3 {
    const CORNERS: [DVec3; 4] = [DVec3::Z, DVec3::X, DVec3::NEG_Z, DVec3::NEG_X];
    let segments = segments(ring, parts);
    let y = f64::from(parts) - f64::from(ring);
    if segments == 0 {
        return dvec3(0.0, y, 0.0);
    }
    let (quarter, step) = (place / segments, place % segments);
    let [from, to] = [0, 1].map(|next| CORNERS[(quarter as usize + next) % 4]);
    from * f64::from(segments - step) + to * f64::from(step) + DVec3::Y * y
}

/// Distance of the surface from the middle in a direction.
fn height(direction: DVec3) -> f64 {
    let waves = |frequency: f64| {
        let DVec3 { x, y, z } = direction * frequency;
        (x + 1.3 * y).sin() * (1.1 * y - z).cos() + (z + 0.7 * x).sin() * 0.5
    };
    1.0 + 0.04 * waves(7.0) + 0.02 * waves(23.0)
}
