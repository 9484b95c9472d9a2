//! The crate `bvh`: its iterator in depth-first order with a query that shrinks at every hit, and our triangle test.

use crate::contestant::{Contestant, Entry, corners, hit};
use crate::triangle::{Line, Triangle};
use bvh::aabb::{Aabb, Bounded, IntersectsAabb};
use bvh::bounding_hierarchy::{BHShape, BoundingHierarchy};
use bvh::bvh::{Bvh, BvhNode};
use glam::Vec3A;
use nalgebra::Point3;
use oktant::mesh::Mesh;
use oktant_shared::hit::Hit;
use oktant_shared::ray::Ray;
use std::cell::Cell;

struct Shape {
    bounds: Aabb<f32, 3>,
    triangle: Triangle,
    id: u32,
    node: usize,
}

impl Bounded<f32, 3> for Shape {
    fn aabb(&self) -> Aabb<f32, 3> {
        self.bounds
    }
}

impl BHShape<f32, 3> for Shape {
    fn set_bh_node_index(&mut self, index: usize) {
        self.node = index;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

/// A ray whose limit comes nearer, so that boxes behind the best hit are passed over.
struct Shrinking {
    origin: Vec3A,
    reciprocal: Vec3A,
    limit: Cell<f32>,
}

impl IntersectsAabb<f32, 3> for Shrinking {
    #[inline(always)]
    fn intersects_aabb(&self, bounds: &Aabb<f32, 3>) -> bool {
        let corner = |point: &Point3<f32>| (Vec3A::new(point.x, point.y, point.z) - self.origin) * self.reciprocal;
        let (low, high) = (corner(&bounds.min), corner(&bounds.max));
        let enter = low.min(high).max_element();
        let exit = low.max(high).min_element();
        exit >= enter && exit >= 0.0 && enter <= self.limit.get()
    }
}

struct Tree {
    bvh: Bvh<f32, 3>,
    shapes: Vec<Shape>,
}

impl Tree {
    #[inline(always)]
    fn trace(&self, ray: &Ray, any: bool) -> Hit {
        let line = Line::new(ray);
        let query = Shrinking {
            origin: line.origin,
            reciprocal: Vec3A::ONE / line.direction,
            limit: Cell::new(ray.t_max),
        };
        let mut best = Hit::miss(ray.t_max);
        for shape in self.bvh.traverse_iterator(&query, &self.shapes) {
            if let Some(t) = shape.triangle.crossing(&line, best.t) {
                best = hit(t, shape.id);
                if any {
                    break;
                }
                query.limit.set(t);
            }
        }
        best
    }
}

impl Contestant for Tree {
    fn closest(&self, rays: &[Ray], hits: &mut [Hit]) {
        for (ray, found) in rays.iter().zip(hits) {
            *found = self.trace(ray, false);
        }
    }

    fn any(&self, rays: &[Ray], found: &mut [bool]) {
        for (ray, found) in rays.iter().zip(found) {
            *found = self.trace(ray, true).is_hit();
        }
    }

    fn bytes(&self) -> Option<usize> {
        Some(self.bvh.nodes.len() * size_of::<BvhNode<f32, 3>>() + size_of_val(self.shapes.as_slice()))
    }
}

fn build(mesh: Mesh, threads: usize) -> Box<dyn Contestant> {
    let shape = |(id, corners): (usize, [[f32; 3]; 3])| {
        let [a, b, c] = corners.map(Point3::from);
        Shape {
            bounds: Aabb::with_bounds(a.inf(&b).inf(&c), a.sup(&b).sup(&c)),
            triangle: Triangle::new(corners),
            id: id as u32,
            node: 0,
        }
    };
    let mut shapes: Vec<Shape> = corners(&mesh).enumerate().map(shape).collect();
    let bvh = if threads == 1 {
        Bvh::build(&mut shapes)
    } else {
        Bvh::build_par(&mut shapes)
    };
    Box::new(Tree { bvh, shapes })
}

pub fn entries() -> Vec<Entry> {
    vec![Entry {
        name: "bvh",
        is_ours: false,
        build: |mesh, threads| Ok(build(mesh, threads)),
    }]
}
