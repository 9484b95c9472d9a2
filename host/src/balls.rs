//! The mesh `balls`: the second scene of the thesis that oktant grew out of.

use crate::mesh::Mesh;
use glam::{Vec3, vec3};

/// Slices and stacks of a ball: 2 * 24 * (13 - 1) = 576 triangles.
const SLICES: u32 = 24;
const STACKS: u32 = 13;

/// Centres and radii.
const BALLS: [(Vec3, f32); 7] = [
    (vec3(0.0, 1.0, 0.0), 1.0),
    (vec3(-1.9, 0.7, 0.5), 0.7),
    (vec3(1.8, 0.6, 0.7), 0.6),
    (vec3(-0.9, 0.45, 1.6), 0.45),
    (vec3(0.8, 0.5, 1.7), 0.5),
    (vec3(-1.3, 0.9, -1.4), 0.9),
    (vec3(1.4, 0.8, -1.3), 0.8),
];

/// Seven balls that stand on the plane y = 0, 4,032 triangles in all, with normals.
pub fn balls() -> Mesh {
    let mut mesh = Mesh::default();
    for (center, radius) in BALLS {
        add_ball(&mut mesh, center, radius);
    }
    mesh
}

fn add_ball(mesh: &mut Mesh, center: Vec3, radius: f32) {
    let base = mesh.positions.len() as u32;
    let mut add = |normal: Vec3| {
        mesh.positions.push(center + normal * radius);
        mesh.normals.push(normal);
    };
    add(Vec3::Y);
    for stack in 1..STACKS {
        let polar = std::f32::consts::PI * stack as f32 / STACKS as f32;
        for slice in 0..SLICES {
            let azimuth = std::f32::consts::TAU * slice as f32 / SLICES as f32;
            let (sin, cos) = polar.sin_cos();
            add(vec3(sin * azimuth.sin(), cos, sin * azimuth.cos()));
        }
    }
    add(Vec3::NEG_Y);
    let at = |stack: u32, slice: u32| match stack {
        0 => base,
        STACKS => base + 1 + (STACKS - 1) * SLICES,
        _ => base + 1 + (stack - 1) * SLICES + slice % SLICES,
    };
    for stack in 0..STACKS {
        for slice in 0..SLICES {
            let corners = [
                at(stack, slice),
                at(stack + 1, slice),
                at(stack + 1, slice + 1),
                at(stack, slice + 1),
            ];
            if stack + 1 < STACKS {
                mesh.triangles.push([corners[0], corners[1], corners[2]]);
            }
            if stack > 0 {
                mesh.triangles.push([corners[0], corners[2], corners[3]]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_count_of_the_thesis_facing_outwards() {
        let mesh = balls();
        assert_eq!(mesh.triangles.len(), 4_032);
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|i| mesh.positions[i as usize]);
            let outwards = triangle.map(|i| mesh.normals[i as usize]).iter().sum::<Vec3>();
            assert!((b - a).cross(c - a).dot(outwards) > 0.0);
        }
    }
}
