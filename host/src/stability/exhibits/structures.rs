//! Structures without bounds, and what a BVH reads for rays that are none.

use super::box_tests::Ignoring;
use crate::mesh::Mesh;
use crate::octree::overlapped_children;
use crate::scene::Scene;
use glam::{UVec4, Vec3};
use oktant_shared::aabb::Aabb;
use oktant_shared::box_test::BoxTest;
use oktant_shared::bvh2::{LEAF, NODE_VECTORS};
use oktant_shared::ray::{PreparedRay, Ray};

/// References of an octree that is split wherever a cell has more than 8 triangles, until a depth, with closed cells and the
/// mesh's own cube as its root; no more than `most` are counted.
pub fn cells_of(mesh: &Mesh, depth: u32, most: usize) -> usize {
    let triangles: Vec<[Vec3; 3]> = mesh
        .triangles
        .iter()
        .map(|triangle| triangle.map(|vertex| mesh.positions[vertex as usize]))
        .collect();
    // NaN is neither least nor greatest.
    let corners = || triangles.iter().flatten().filter(|corner| corner.is_finite());
    let low = corners().fold(Vec3::INFINITY, |low, corner| low.min(*corner));
    let high = corners().fold(Vec3::NEG_INFINITY, |high, corner| high.max(*corner));
    let half = 0.5 * (high - low).max_element();
    let ids: Vec<u32> = (0..triangles.len() as u32).collect();
    let mut references = 0;
    split(&triangles, &ids, 0.5 * (low + high), half, depth, most, &mut references);
    references
}

fn split(
    triangles: &[[Vec3; 3]],
    ids: &[u32],
    center: Vec3,
    half: f32,
    depth: u32,
    most: usize,
    references: &mut usize,
) {
    if ids.len() <= 8 || depth == 0 || *references >= most {
        *references += ids.len();
        return;
    }
    let children: Vec<u8> = ids
        .iter()
        .map(|id| overlapped_children(&triangles[*id as usize], center, half, 0.0))
        .collect();
    for child in 0..8 {
        let inside = |(id, children): (&u32, &u8)| (children >> child & 1 == 1).then_some(*id);
        let ids: Vec<u32> = ids.iter().zip(&children).filter_map(inside).collect();
        let side = |bit: u32| if child >> bit & 1 == 1 { 0.5 } else { -0.5 };
        let center = center + Vec3::new(side(0), side(1), side(2)) * half;
        split(triangles, &ids, center, 0.5 * half, depth - 1, most, references);
    }
}

/// Whether a triangle's plane passes a cube by, as f32 computes it (the axis of the normal of T. Akenine-Moller, "Fast 3D
/// triangle-box overlap testing", JGT 6(1), 2001).
pub fn is_apart_in_f32(corners: &[Vec3; 3], center: Vec3, half: f32) -> bool {
    let [a, b, c] = corners.map(|corner| corner - center);
    let normal = (b - a).cross(c - a);
    normal.dot(a).abs() > half * normal.abs().element_sum()
}

/// Boxes of a plain BVH that a ray reads which is taken as it is, with minima and maxima that leave NaN out.
pub fn unrefused_boxes(scene: &Scene, ray: &Ray) -> usize {
    let test = Ignoring::prepare(&PreparedRay {
        origin: ray.origin,
        direction: ray.direction,
        t_min: ray.t_min,
        t_max: ray.t_max,
        scale: 1.0,
        valid: true,
    });
    let corner = |words: UVec4| Vec3::from_array([words.x, words.y, words.z].map(f32::from_bits));
    let (mut boxes, mut waiting) = (0, vec![0]);
    while let Some(node) = waiting.pop() {
        let words = &scene.nodes[(node * NODE_VECTORS) as usize..];
        for at in [0, 2] {
            boxes += 1;
            let interval = test.interval(&Aabb {
                low: corner(words[at]),
                high: corner(words[at + 1]),
            });
            if words[at].w & LEAF == 0 && interval.enter <= interval.exit && interval.exit >= ray.t_min {
                waiting.push(words[at].w);
            }
        }
    }
    boxes
}
