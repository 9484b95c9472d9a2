//! obvhs: its compressed tree of eight children (Ylitie and others 2017) and its binary one, with its own triangle, which
//! lies in the order of the leaves as its documentation advises.

use crate::contestant::{Contestant, Entry, corners, hit};
use glam::Vec3A;
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::cwbvh::node::CwBvhNode;
use obvhs::ray::{Ray as PeerRay, RayHit};
use obvhs::rt_triangle::RtTriangle;
use obvhs::triangle::Triangle;
use oktant::mesh::Mesh;
use oktant_shared::hit::Hit;
use oktant_shared::ray::Ray;
use std::time::Duration;

struct Tree<B> {
    bvh: B,
    triangles: Vec<RtTriangle>,
}

#[inline(always)]
fn peer_ray(ray: &Ray) -> PeerRay {
    let [origin, direction] = [ray.origin, ray.direction].map(|vector| Vec3A::from(vector.to_array()));
    PeerRay::new(origin, direction, ray.t_min, ray.t_max)
}

/// A mesh's triangles as obvhs has them.
pub fn triangles(mesh: &Mesh) -> Vec<Triangle> {
    let triangle = |corners: [[f32; 3]; 3]| {
        let [v0, v1, v2] = corners.map(Vec3A::from);
        Triangle { v0, v1, v2 }
    };
    corners(mesh).map(triangle).collect()
}

macro_rules! contestant {
    ($bvh:ty, $node:ty, $build:ident) => {
        impl Tree<$bvh> {
            fn build(mesh: Mesh, parameters: BvhBuildParams) -> Box<dyn Contestant> {
                let triangles = triangles(&mesh);
                let bvh = $build(&triangles, parameters, &mut Duration::default());
                let order = bvh.primitive_indices.iter();
                let triangles = order
                    .map(|&id| RtTriangle::from(&triangles[id as usize]))
                    .collect();
                Box::new(Tree { bvh, triangles })
            }
        }

        impl Contestant for Tree<$bvh> {
            fn closest(&self, rays: &[Ray], hits: &mut [Hit]) {
                for (ray, found) in rays.iter().zip(hits) {
                    let mut best = RayHit::none();
                    let test = |ray: &PeerRay, place: usize| self.triangles[place].intersect(ray);
                    self.bvh.ray_traverse(peer_ray(ray), &mut best, test);
                    *found = if best.primitive_id == u32::MAX {
                        Hit::miss(ray.t_max)
                    } else {
                        hit(best.t, self.bvh.primitive_indices[best.primitive_id as usize])
                    };
                }
            }

            fn any(&self, rays: &[Ray], found: &mut [bool]) {
                for (ray, found) in rays.iter().zip(found) {
                    let test = |ray: &PeerRay, place: usize| self.triangles[place].intersect(ray);
                    *found = !self.bvh.ray_traverse_miss(peer_ray(ray), test);
                }
            }

            fn bytes(&self) -> Option<usize> {
                let references = size_of_val(self.bvh.primitive_indices.as_slice());
                let triangles = size_of_val(self.triangles.as_slice());
                Some(self.bvh.nodes.len() * size_of::<$node>() + references + triangles)
            }
        }
    };
}

contestant!(CwBvh, CwBvhNode, build_cwbvh_from_tris);
contestant!(Bvh2, Bvh2Node, build_bvh2_from_tris);

macro_rules! entry {
    ($name:literal, $bvh:ty, $parameters:ident) => {
        Entry {
            name: $name,
            is_ours: false,
            build: |mesh, _| Ok(Tree::<$bvh>::build(mesh, BvhBuildParams::$parameters())),
        }
    };
}

pub fn entries() -> Vec<Entry> {
    vec![
        entry!("obvhs cwbvh medium", CwBvh, medium_build),
        entry!("obvhs cwbvh very slow", CwBvh, very_slow_build),
        entry!("obvhs bvh2 medium", Bvh2, medium_build),
        entry!("obvhs bvh2 very slow", Bvh2, very_slow_build),
    ]
}
