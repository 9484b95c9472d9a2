//! Triangle tests that fail, and the ones that are offered as a GPU may round them.

use super::rounding::Rounding;
use glam::Vec3;
use oktant_shared::ray::PreparedRay;
use oktant_shared::triangle::Triangle;
use oktant_shared::triangle_test::{Crossing, TriangleTest};
use std::marker::PhantomData;

/// What a variant of Moller and Trumbore's test compares with.
pub trait Bounds: Copy + Send + Sync {
    /// Determinants up to this size are taken for zero.
    const EPSILON: f32 = 0.0;
    /// By how much the weights may be outside.
    const SLACK: f32 = 0.0;
    /// Whether each weight is held against zero; else only their sum is, as in the thesis.
    const EACH: bool = true;
}

/// As offered.
#[derive(Clone, Copy, Debug)]
pub struct Exact;

/// With an epsilon, in powers of ten.
#[derive(Clone, Copy, Debug)]
pub struct Epsilon<const POWER: u32>;

/// With a slack of 10^-6 on both weights.
#[derive(Clone, Copy, Debug)]
pub struct Slack;

/// As the thesis has it: `u + v >= 0` in the place of `u >= 0` and `v >= 0`.
#[derive(Clone, Copy, Debug)]
pub struct OneBound;

impl Bounds for Exact {}

impl<const POWER: u32> Bounds for Epsilon<POWER> {
    const EPSILON: f32 = match POWER {
        5 => 1e-5,
        6 => 1e-6,
        _ => 1e-7,
    };
}

impl Bounds for Slack {
    const SLACK: f32 = 1e-6;
}

impl Bounds for OneBound {
    const EACH: bool = false;
}

/// T. Moller and B. Trumbore, "Fast, minimum storage ray/triangle intersection", JGT 2(1), 1997.
#[derive(Clone, Copy, Debug)]
pub struct MollerTrumbore<R, B> {
    origin: Vec3,
    direction: Vec3,
    how: PhantomData<(R, B)>,
}

impl<R: Rounding, B: Bounds> TriangleTest for MollerTrumbore<R, B> {
    fn prepare(ray: &PreparedRay) -> Self {
        MollerTrumbore {
            origin: ray.origin,
            direction: ray.direction,
            how: PhantomData,
        }
    }

    fn crossing(&self, triangle: &Triangle) -> Crossing {
        let edge_ab = triangle.b - triangle.a;
        let edge_ac = triangle.c - triangle.a;
        let p = R::cross(self.direction, edge_ac);
        let determinant = R::dot(p, edge_ab);
        let reciprocal = 1.0 / determinant;
        let to_origin = self.origin - triangle.a;
        let u = R::dot(p, to_origin) * reciprocal;
        let q = R::cross(to_origin, edge_ab);
        let v = R::dot(q, self.direction) * reciprocal;
        let t = R::dot(q, edge_ac) * reciprocal;
        let solvable = determinant.abs() > f32::MIN_POSITIVE.max(B::EPSILON);
        let above = if B::EACH {
            u >= -B::SLACK && v >= -B::SLACK
        } else {
            u + v >= 0.0
        };
        Crossing {
            crosses: solvable && above && u + v <= 1.0 + B::SLACK,
            t,
            u,
            v,
        }
    }
}

/// S. Woop, C. Benthin, I. Wald, "Watertight ray/triangle intersection", JCGT 2(1), 2013, without its fall-back to f64; the
/// shear `DIVIDED` as published, or by a reciprocal as in what is offered.
#[derive(Clone, Copy, Debug)]
pub struct Woop<R, const DIVIDED: bool> {
    origin: Vec3,
    axis: usize,
    shear: Vec3,
    how: PhantomData<R>,
}

impl<R: Rounding, const DIVIDED: bool> TriangleTest for Woop<R, DIVIDED> {
    fn prepare(ray: &PreparedRay) -> Self {
        let axis = ray.direction.abs().max_position();
        let direction = rotated(ray.direction, axis);
        let reciprocal = 1.0 / direction.z;
        Woop {
            origin: rotated(ray.origin, axis),
            axis,
            shear: if DIVIDED {
                Vec3::new(direction.x / direction.z, direction.y / direction.z, reciprocal)
            } else {
                Vec3::new(direction.x * reciprocal, direction.y * reciprocal, reciprocal)
            },
            how: PhantomData,
        }
    }

    fn crossing(&self, triangle: &Triangle) -> Crossing {
        let [a, b, c] = [triangle.a, triangle.b, triangle.c].map(|corner| self.sheared(corner));
        let weight_a = R::difference(c.x, b.y, c.y, b.x);
        let weight_b = R::difference(a.x, c.y, a.y, c.x);
        let weight_c = R::difference(b.x, a.y, b.y, a.x);
        let determinant = weight_a + weight_b + weight_c;
        let reciprocal = 1.0 / determinant;
        let distance = R::dot(Vec3::new(weight_a, weight_b, weight_c), Vec3::new(a.z, b.z, c.z));
        Crossing {
            crosses: on_one_side([weight_a, weight_b, weight_c], 0.0) && determinant.abs() > f32::MIN_POSITIVE,
            t: distance * reciprocal,
            u: weight_b * reciprocal,
            v: weight_c * reciprocal,
        }
    }
}

impl<R: Rounding, const DIVIDED: bool> Woop<R, DIVIDED> {
    fn sheared(&self, corner: Vec3) -> Vec3 {
        let p = rotated(corner, self.axis) - self.origin;
        Vec3::new(
            R::subtract(self.shear.x, p.z, p.x),
            R::subtract(self.shear.y, p.z, p.y),
            p.z * self.shear.z,
        )
    }
}

/// The components in cyclic order, the one at `axis` last.
fn rotated(v: Vec3, axis: usize) -> Vec3 {
    Vec3::new(v[(axis + 1) % 3], v[(axis + 2) % 3], v[axis])
}

/// Whether all weights are positive, or all negative, but for `slack`.
fn on_one_side(weights: [f32; 3], slack: f32) -> bool {
    weights.iter().all(|weight| *weight >= -slack) || weights.iter().all(|weight| *weight <= slack)
}

/// The sides of the edges by Pluecker coordinates, moved to the ray's origin; with `SLACK`, a side within a unit in the last
/// place of the sum of all sides counts as either one.
#[derive(Clone, Copy, Debug)]
pub struct Plucker<R, const SLACK: bool> {
    origin: Vec3,
    direction: Vec3,
    how: PhantomData<R>,
}

impl<R: Rounding, const SLACK: bool> TriangleTest for Plucker<R, SLACK> {
    fn prepare(ray: &PreparedRay) -> Self {
        Plucker {
            origin: ray.origin,
            direction: ray.direction,
            how: PhantomData,
        }
    }

    fn crossing(&self, triangle: &Triangle) -> Crossing {
        let [a, b, c] = [triangle.a, triangle.b, triangle.c].map(|corner| corner - self.origin);
        let side = |from: Vec3, to: Vec3| R::dot(R::cross(to - from, to + from), self.direction);
        let weights = [side(b, c), side(c, a), side(a, b)];
        let sum: f32 = weights.iter().sum();
        let normal = R::cross(triangle.b - triangle.a, triangle.c - triangle.a);
        let towards = R::dot(normal, self.direction);
        let reciprocal = 1.0 / sum;
        let slack = if SLACK { f32::EPSILON * sum.abs() } else { 0.0 };
        Crossing {
            crosses: on_one_side(weights, slack) && sum != 0.0 && towards.abs() > f32::MIN_POSITIVE,
            t: R::dot(normal * (1.0 / towards), a),
            u: weights[1] * reciprocal,
            v: weights[2] * reciprocal,
        }
    }
}

/// J. Havel and A. Herout, "Yet faster ray-triangle intersection (using SSE4)", IEEE TVCG 16(3), 2010: three planes of each
/// triangle, in coordinates of the world.
#[derive(Clone, Copy, Debug)]
pub struct HavelHerout {
    origin: Vec3,
    direction: Vec3,
}

impl TriangleTest for HavelHerout {
    fn prepare(ray: &PreparedRay) -> Self {
        HavelHerout {
            origin: ray.origin,
            direction: ray.direction,
        }
    }

    fn crossing(&self, triangle: &Triangle) -> Crossing {
        let edge_ab = triangle.b - triangle.a;
        let edge_ac = triangle.c - triangle.a;
        let normal = edge_ab.cross(edge_ac);
        let squared = normal.dot(normal);
        let u_plane = edge_ac.cross(normal) / squared;
        let v_plane = normal.cross(edge_ab) / squared;
        let towards = normal.dot(self.direction);
        let above = normal.dot(triangle.a) - normal.dot(self.origin);
        let point = self.origin * towards + self.direction * above;
        let reciprocal = 1.0 / towards;
        let u = (u_plane.dot(point) - towards * u_plane.dot(triangle.a)) * reciprocal;
        let v = (v_plane.dot(point) - towards * v_plane.dot(triangle.a)) * reciprocal;
        Crossing {
            crosses: towards.abs() > f32::MIN_POSITIVE && u >= 0.0 && v >= 0.0 && u + v <= 1.0,
            t: above * reciprocal,
            u,
            v,
        }
    }
}
