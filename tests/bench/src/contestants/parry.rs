//! parry3d: its mesh of triangles as it comes, and its tree (PLOC) with our triangle test.

use crate::contestant::{Contestant, Entry, Failure, corners, hit};
use crate::triangle::{Line, Triangle};
use oktant::mesh::Mesh;
use oktant_shared::hit::Hit;
use oktant_shared::ray::Ray;
use parry3d::bounding_volume::Aabb;
use parry3d::math::Vector;
use parry3d::partitioning::{Bvh, BvhBuildStrategy};
use parry3d::query::Ray as PeerRay;
use parry3d::shape::{CompositeShapeRef, TriMesh};

#[inline(always)]
fn peer_ray(ray: &Ray) -> PeerRay {
    PeerRay::new(
        Vector::from_array(ray.origin.to_array()),
        Vector::from_array(ray.direction.to_array()),
    )
}

/// There is no infinite limit.
#[inline(always)]
fn limit(ray: &Ray) -> f32 {
    ray.t_max.min(f32::MAX)
}

struct Whole(TriMesh);

impl Contestant for Whole {
    fn closest(&self, rays: &[Ray], hits: &mut [Hit]) {
        for (ray, found) in rays.iter().zip(hits) {
            let best = CompositeShapeRef(&self.0).cast_local_ray(&peer_ray(ray), limit(ray), false);
            *found = best.map_or(Hit::miss(ray.t_max), |(triangle, t)| hit(t, triangle));
        }
    }

    /// There is no query for any hit.
    fn any(&self, rays: &[Ray], found: &mut [bool]) {
        for (ray, found) in rays.iter().zip(found) {
            let best = CompositeShapeRef(&self.0).cast_local_ray(&peer_ray(ray), limit(ray), false);
            *found = best.is_some();
        }
    }

    fn bytes(&self) -> Option<usize> {
        Some(self.0.heap_memory_size())
    }
}

struct Tree {
    bvh: Bvh,
    triangles: Vec<Triangle>,
}

impl Contestant for Tree {
    fn closest(&self, rays: &[Ray], hits: &mut [Hit]) {
        for (ray, found) in rays.iter().zip(hits) {
            let line = Line::new(ray);
            let best = self.bvh.cast_ray(&peer_ray(ray), limit(ray), |id, best| {
                self.triangles[id as usize].crossing(&line, best)
            });
            *found = best.map_or(Hit::miss(ray.t_max), |(triangle, t)| hit(t, triangle));
        }
    }

    /// The first hit reports a distance that no other node can beat, so that nothing more is opened.
    fn any(&self, rays: &[Ray], found: &mut [bool]) {
        for (ray, found) in rays.iter().zip(found) {
            let line = Line::new(ray);
            let first = self.bvh.cast_ray(&peer_ray(ray), limit(ray), |id, _| {
                let crossing = self.triangles[id as usize].crossing(&line, ray.t_max);
                crossing.map(|_| -f32::MAX)
            });
            *found = first.is_some();
        }
    }

    fn bytes(&self) -> Option<usize> {
        Some(self.bvh.heap_memory_size() + size_of_val(self.triangles.as_slice()))
    }
}

fn whole(mesh: Mesh) -> Result<Box<dyn Contestant>, Failure> {
    let positions = mesh.positions.into_iter();
    let vertices = positions
        .map(|position| Vector::from_array(position.to_array()))
        .collect();
    let whole = TriMesh::new(vertices, mesh.triangles).map_err(|error| Failure {
        who: "parry3d trimesh",
        reason: error.to_string(),
    })?;
    Ok(Box::new(Whole(whole)))
}

fn tree(mesh: Mesh) -> Box<dyn Contestant> {
    let bounds = |corners: [[f32; 3]; 3]| {
        let [a, b, c] = corners.map(Vector::from_array);
        Aabb::new(a.min(b).min(c), a.max(b).max(c))
    };
    let boxes: Vec<Aabb> = corners(&mesh).map(bounds).collect();
    Box::new(Tree {
        bvh: Bvh::from_leaves(BvhBuildStrategy::Ploc, &boxes),
        triangles: corners(&mesh).map(Triangle::new).collect(),
    })
}

pub fn entries() -> Vec<Entry> {
    vec![
        Entry {
            name: "parry3d trimesh",
            is_ours: false,
            build: |mesh, _| whole(mesh),
        },
        Entry {
            name: "parry3d ploc",
            is_ours: false,
            build: |mesh, _| Ok(tree(mesh)),
        },
    ]
}
