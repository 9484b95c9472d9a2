//! From points of the scene to points of the picture.

use glam::{Vec3, vec3};
use oktant_shared::camera::Camera;

/// What a camera does to points.
pub(super) struct Projection {
    eye: Vec3,
    /// Rows that take an offset from the eye to (across, upwards, depth), where across and upwards are as large as the depth
    /// at the picture's edges in perspective.
    rows: [Vec3; 3],
    size: [f32; 2],
    /// Whether what is seen is as wide at any depth: across and upwards are 1 at the picture's edges then.
    is_parallel: bool,
}

/// A line in the picture.
pub(super) struct Segment {
    /// Where it begins and ends, pixels from the upper left corner; within the picture.
    pub ends: [[f32; 2]; 2],
    /// Along the line of sight, scene units, in the middle of what is seen.
    pub depth: f32,
}

/// Nearer than this part of the offset's length, nothing is drawn: it has no place in the picture.
const NEAREST: f32 = 1e-4;

impl Projection {
    pub fn new(camera: &Camera) -> Self {
        Projection {
            eye: camera.eye,
            rows: [
                camera.right / camera.right.length_squared(),
                camera.up / camera.up.length_squared(),
                camera.forward,
            ],
            size: [camera.width as f32, camera.height as f32],
            is_parallel: camera.parallel != 0.0,
        }
    }

    /// What is seen of a line between two points; none where nothing is.
    pub fn segment(&self, ends: [Vec3; 2]) -> Option<Segment> {
        let [from, to] = ends.map(|end| self.turned(end));
        // How far inside of each of the planes that bound what is seen an end is.
        let nearest = NEAREST * from.length().max(to.length());
        let inside = |point: Vec3| {
            let edge = self.edge(point);
            [
                point.z - nearest,
                edge - point.x,
                edge + point.x,
                edge - point.y,
                edge + point.y,
            ]
        };
        let (mut first, mut last) = (0.0_f32, 1.0_f32);
        for (a, b) in inside(from).into_iter().zip(inside(to)) {
            if a < 0.0 && b < 0.0 {
                return None;
            }
            let crossing = a / (a - b);
            if a < 0.0 {
                first = first.max(crossing);
            } else if b < 0.0 {
                last = last.min(crossing);
            }
        }
        if first > last {
            return None;
        }
        let ends = [first, last].map(|place| from.lerp(to, place));
        Some(Segment {
            depth: 0.5 * (ends[0].z + ends[1].z),
            ends: ends.map(|end| self.placed(end)),
        })
    }

    fn turned(&self, point: Vec3) -> Vec3 {
        let offset = point - self.eye;
        let [across, upwards, depth] = self.rows.map(|row| row.dot(offset));
        vec3(across, upwards, depth)
    }

    /// How large across and upwards are at the picture's edges, at a point's depth.
    fn edge(&self, turned: Vec3) -> f32 {
        if self.is_parallel { 1.0 } else { turned.z }
    }

    fn placed(&self, turned: Vec3) -> [f32; 2] {
        let edge = self.edge(turned);
        [
            (turned.x / edge + 1.0) / 2.0 * self.size[0],
            (1.0 - turned.y / edge) / 2.0 * self.size[1],
        ]
    }
}
