//! A small thing in a very large room.

use super::bumpy_ball::bumpy_ball;
use super::room::Interior;
use crate::mesh::Mesh;
use crate::shapes::stadium;
use glam::{Vec3, dvec3, vec3};

/// Triangles, radius and middle of the ball, metres.
const BALL: u32 = 20_000;
const RADIUS: f32 = 0.12;
const MIDDLE: Vec3 = vec3(0.31, 0.132, -0.17);

/// What is known as the teapot in a stadium: a bumpy ball of the size of a teapot, 20,000 triangles, on the field of
/// [`stadium`], seen from half a metre away. All that is fine lies in a few billionths of the whole.
pub fn teapot_in_stadium() -> Interior {
    let Mesh {
        mut positions,
        mut triangles,
        ..
    } = stadium();
    let ball = bumpy_ball(BALL);
    let first = positions.len() as u32;
    positions.extend(ball.positions.iter().map(|position| *position * RADIUS + MIDDLE));
    triangles.extend(
        ball.triangles
            .iter()
            .map(|corners| corners.map(|corner| first + corner)),
    );
    Interior {
        mesh: Mesh {
            positions,
            triangles,
            ..Mesh::default()
        },
        eye: dvec3(0.55, 0.38, 0.31),
        target: MIDDLE.as_dvec3(),
    }
}
