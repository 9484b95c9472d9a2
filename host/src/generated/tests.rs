//! What must be true of every generated mesh.

use super::*;
use crate::mesh::Mesh;
use crate::oracle::{Oracle, OracleRay};
use glam::Vec3;
use std::collections::HashMap;

/// Six times the volume that a mesh encloses, its front outside.
fn volume(mesh: &Mesh) -> f64 {
    let corners = |triangle: &[u32; 3]| triangle.map(|i| mesh.positions[i as usize].as_dvec3());
    let part = |triangle| {
        let [a, b, c] = corners(triangle);
        a.dot(b.cross(c))
    };
    mesh.triangles.iter().map(part).sum()
}

/// Whether each edge is there as often in one direction as in the other, vertices at one place being the same.
fn is_closed(mesh: &Mesh) -> bool {
    let mut edges = HashMap::new();
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|i| (mesh.positions[i as usize] + Vec3::ZERO).to_array().map(f32::to_bits));
        for (from, to) in [(a, b), (b, c), (c, a)] {
            *edges.entry((from.min(to), from.max(to))).or_insert(0) += if from < to { 1 } else { -1 };
        }
    }
    edges.values().all(|&surplus| surplus == 0)
}

#[test]
fn balls_are_closed_and_have_the_triangles_asked_for() {
    for (most, count) in [(0, 8), (8, 8), (31, 8), (32, 32), (1_000, 968), (20_000, 20_000)] {
        let ball = bumpy_ball(most);
        assert_eq!(ball.triangles.len(), count);
        assert!(is_closed(&ball), "{most}");
        assert!(volume(&ball) > 0.0);
        assert!(
            ball.triangles
                .iter()
                .flatten()
                .all(|&i| (i as usize) < ball.positions.len())
        );
        // Euler's formula for a closed surface without holes.
        assert_eq!(ball.positions.len(), count / 2 + 2);
    }
}

#[test]
fn knots_are_closed_and_have_the_triangles_asked_for() {
    for (most, count) in [(0, 18), (1_000, 1_000), (4_000, 4_000), (20_000, 19_976)] {
        let knot = knot(most);
        assert_eq!(knot.triangles.len(), count);
        assert!(is_closed(&knot), "{most}");
        // Of so few triangles that the tube crosses itself, nothing is outside.
        assert!(most == 0 || volume(&knot) > 0.0);
        // Euler's formula for a closed surface with one hole.
        assert_eq!(knot.positions.len(), count / 2);
    }
}

/// Its shape is there at 1,000 triangles: more of them move the surface by less than an eighth of the tube's radius.
#[test]
fn knots_have_their_shape_at_a_thousand_triangles() {
    let coarse = knot(1_000);
    let fine = Oracle::new(&knot(256_000));
    for corners in &coarse.triangles {
        let [a, b, c] = corners.map(|corner| coarse.positions[corner as usize]);
        let (middle, normal) = ((a + b + c) / 3.0, (b - a).cross(c - a).normalize());
        let ray = OracleRay::new(middle - normal * 0.2, normal, 0.0, f32::INFINITY);
        let hit = fine.closest(&ray).expect("the fine surface is about there");
        assert!((hit.t - 0.2).abs() < 0.0625, "{} at {middle}", hit.t - 0.2);
    }
}

#[test]
fn splitting_keeps_the_surface() {
    let ball = bumpy_ball(1_000);
    let finer = split(&ball);
    assert_eq!(finer.triangles.len(), 4 * ball.triangles.len());
    assert_eq!(finer.positions.len(), finer.triangles.len() / 2 + 2);
    assert!(is_closed(&finer));
    assert!((volume(&finer) / volume(&ball) - 1.0).abs() < 1e-6);
    // Each part lies in the plane of what it was cut from, faces as it did, and has a quarter of its area.
    let normal = |mesh: &Mesh, triangle: usize| {
        let [a, b, c] = mesh.triangles[triangle].map(|i| mesh.positions[i as usize].as_dvec3());
        (b - a).cross(c - a)
    };
    for triangle in 0..finer.triangles.len() {
        let (part, whole) = (normal(&finer, triangle), normal(&ball, triangle / 4));
        assert!((part * 4.0).distance(whole) < 1e-4 * whole.length(), "{triangle}");
    }
}

#[test]
fn soups_have_their_triangles_and_rays_meet_about_three() {
    for count in [1_000, 20_000] {
        let soup = soup(count);
        assert_eq!(soup.triangles.len(), count as usize);
        let (low, high) = soup.bounds().unwrap();
        assert!(low.cmplt(Vec3::splat(-0.95)).all() && high.cmpgt(Vec3::splat(0.95)).all());
        let oracle = Oracle::new(&soup);
        let rays = (0..400).map(|i| {
            let start = Vec3::new((i % 20) as f32 / 10.0 - 0.95, (i / 20) as f32 / 10.0 - 0.95, -2.0);
            OracleRay::new(start, Vec3::Z, 0.0, f32::INFINITY)
        });
        let mean = rays.map(|ray| oracle.hits(&ray).len()).sum::<usize>() as f64 / 400.0;
        assert!((1.5..5.0).contains(&mean), "{mean} of {count}");
    }
}

#[test]
fn nobody_can_look_out_of_the_room() {
    let Interior { mesh, eye, target } = room();
    assert!(is_closed(&mesh));
    let count = mesh.triangles.len();
    assert!((150_000..250_000).contains(&count), "{count}");
    let oracle = Oracle::new(&mesh);
    let (low, high) = mesh.bounds().unwrap();
    assert_eq!((low, high), (Vec3::new(-4.0, 0.0, -3.0), Vec3::new(4.0, 3.0, 3.0)));
    let direct = OracleRay::new(eye.as_vec3(), (target - eye).as_vec3(), 0.0, 0.5);
    assert!(!oracle.any(&direct), "something stands before the camera");
    for direction in bumpy_ball(2_000).positions {
        let ray = OracleRay::new(eye.as_vec3(), direction, 0.0, f32::INFINITY);
        let hit = oracle.closest(&ray).expect("the room is closed");
        let [a, b, c] = oracle.corners(hit.triangle);
        assert!((b - a).cross(c - a).dot(ray.direction) < 0.0, "fronts are seen");
    }
}

/// Half of the picture is the ball, the rest is the stadium, and the ball hides none of it in its grass.
#[test]
fn the_teapot_is_seen_in_the_stadium() {
    let Interior { mesh, eye, target } = teapot_in_stadium();
    assert!(is_closed(&mesh));
    let stadium = crate::shapes::stadium().triangles.len() as u32;
    assert_eq!(mesh.triangles.len() as u32, stadium + 20_000);
    let low = mesh
        .positions
        .iter()
        .map(|position| position.y)
        .fold(f32::INFINITY, f32::min);
    assert_eq!(low, 0.0, "the ball stands on the field");
    let oracle = Oracle::new(&mesh);
    let [seen, beside] = [target, target + glam::dvec3(0.3, 0.0, 0.0)].map(|aim| {
        let ray = OracleRay::new(eye.as_vec3(), (aim - eye).as_vec3(), 0.0, f32::INFINITY);
        oracle.closest(&ray).expect("the stadium is closed").triangle
    });
    assert!(seen >= stadium && beside < stadium, "{seen} {beside}");
}

#[test]
fn meshes_are_the_same_every_time() {
    assert_eq!(soup(1_000), soup(1_000));
    assert_eq!(room(), room());
    assert_eq!(split(&bumpy_ball(50_000)), split(&bumpy_ball(50_000)));
}
