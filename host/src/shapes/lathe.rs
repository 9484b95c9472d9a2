//! What a lathe or a potter's wheel makes.

use super::grid::{GridVertex, add_grid};
use crate::mesh::Mesh;
use glam::{DVec2, Vec2, Vec3, dvec2, vec2, vec3};
use std::f64::consts::TAU;

/// A surface of revolution about the up axis.
pub struct Lathe<'a> {
    /// Radius (0 and up) and height of the points of its outline, two and more. Where it runs upwards, the front looks
    /// outwards.
    pub profile: &'a [Vec2],
    /// Parts of the circle.
    pub slices: u32,
    /// Edges of the outline that turn by less than this are round, in degrees.
    pub crease: f64,
}

/// The surface. Between two points of the profile it has `2 * slices` triangles, or `slices` where one of them lies on
/// the axis. A profile that starts and ends on the axis makes a closed surface.
///
/// Texture coordinates are 0 to 1 about the axis, from the back eastwards, and along the profile's length.
pub fn lathe(lathe: &Lathe<'_>) -> Mesh {
    let points: Vec<DVec2> = lathe.profile.iter().map(|point| point.as_dvec2()).collect();
    let edges: Vec<DVec2> = points.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let normals: Vec<DVec2> = edges
        .iter()
        .map(|edge| dvec2(edge.y, -edge.x).normalize_or_zero())
        .collect();
    let length: f64 = edges.iter().map(|edge| edge.length()).sum();
    let mut mesh = Mesh::default();
    let mut so_far = 0.0;
    for (i, edge) in edges.iter().enumerate() {
        let own = normals[i];
        let shared = |other: Option<&DVec2>| match other {
            Some(other) if own.angle_to(*other).abs().to_degrees() < lathe.crease => (own + *other).normalize(),
            _ => own,
        };
        let ends = [
            (
                points[i],
                shared(i.checked_sub(1).map(|before| &normals[before])),
                so_far,
            ),
            (points[i + 1], shared(normals.get(i + 1)), so_far + edge.length()),
        ];
        so_far += edge.length();
        add_grid(&mut mesh, [lathe.slices, 1], |slice, end| {
            let (point, normal, along) = ends[end as usize];
            let angle = TAU * f64::from(slice % lathe.slices) / f64::from(lathe.slices);
            GridVertex {
                position: turned(point, angle),
                normal: turned(normal, angle),
                coordinates: vec2(slice as f32 / lathe.slices as f32, (along / length) as f32),
            }
        });
    }
    mesh
}

/// A point of the profile's plane, turned about the axis; from the back eastwards.
fn turned(point: DVec2, angle: f64) -> Vec3 {
    vec3(
        (-point.x * angle.sin()) as f32,
        point.y as f32,
        (-point.x * angle.cos()) as f32,
    )
}
