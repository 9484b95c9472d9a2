//! Where a ray of f32 numbers and a triangle meet, without any rounding.
//!
//! The volume that the ray's direction spans with two corners as seen from its origin, `d . ((a - o) x (b - o))`, says on
//! which side of the edge the ray passes; `t` is the quotient of two such volumes. The usual predicates take four points
//! (the crate `robust` has them), but `o + d` is no f64 where the two differ much in size. So the volume is multiplied out,
//! `d . (a x b) - d . (a x o) - d . (o x b)`: 18 products of three f32 numbers, whose sum an [`Expansion`] holds exactly.
//!
//! That is done only where it matters. f64 decides first, with differences in place of the products, and is believed where
//! the result exceeds the bound of its error: with every difference, product and sum rounded once, less than eight roundings
//! of the sum of the products' sizes (Shewchuk's bound A of `orient3d`).

use glam::DVec3;
use std::cmp::Ordering;

use super::expansion::Expansion;
use super::ray::OracleRay;

/// The bound of f64's error in parts of the sum of the products' sizes: twice what is proven.
const DOUBT: f64 = 8.0 * f64::EPSILON;

/// How a ray and a triangle lie to each other, exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Contact {
    /// Apart, or the ray lies in the plane of the triangle, or the triangle is degenerate, or they meet beyond an end of the
    /// ray's `t`.
    None,
    /// The ray passes through the triangle's interior, between the ends of its `t`.
    Inside,
    /// The ray touches the triangle: on an edge, at a corner, or with an end of its `t`.
    Touch,
}

/// A ray all of whose numbers are f32, limits that are infinite aside.
#[derive(Clone, Copy, Debug)]
pub(super) struct ExactRay {
    origin: DVec3,
    direction: DVec3,
}

impl ExactRay {
    /// `None` where some number is no f32.
    pub fn of(ray: &OracleRay) -> Option<Self> {
        let numbers = ray.origin.to_array().into_iter().chain(ray.direction.to_array());
        let limits = [ray.t_min, ray.t_max].into_iter().filter(|limit| limit.is_finite());
        let is_f32 = |number: f64| f64::from(number as f32) == number;
        numbers.chain(limits).all(is_f32).then_some(ExactRay {
            origin: ray.origin,
            direction: ray.direction,
        })
    }

    /// On which side of the edge from `a` to `b` the line passes: -1, 0 or 1. Of two triangles that have an edge in opposite
    /// directions, one gets the negative of the other's.
    fn side(&self, a: DVec3, b: DVec3) -> f64 {
        let (volume, size) = volume(self.direction, a - self.origin, b - self.origin);
        if volume.abs() > DOUBT * size {
            return volume.signum();
        }
        let mut exact = Expansion::default();
        exact.add_determinant(1.0, self.direction, a, b);
        exact.add_determinant(-1.0, self.direction, a, self.origin);
        exact.add_determinant(-1.0, self.direction, self.origin, b);
        exact.sign()
    }

    /// On which sides the line passes the three edges, where it passes none of them on the wrong one. `None` where it passes
    /// by, where it lies in the triangle's plane, and where the triangle is degenerate.
    pub fn sides(&self, [a, b, c]: [DVec3; 3]) -> Option<[f64; 3]> {
        let first = self.side(a, b);
        let second = self.side(b, c);
        if first * second < 0.0 {
            return None;
        }
        let sides = [first, second, self.side(c, a)];
        let positive = sides.iter().all(|side| *side >= 0.0);
        let negative = sides.iter().all(|side| *side <= 0.0);
        (positive != negative).then_some(sides)
    }

    /// How the `t` at which the line meets the triangle's plane compares with `limit`, an f32 or infinite. The triangle is
    /// one that the line crosses with these sides.
    pub fn compare_t(&self, [a, b, c]: [DVec3; 3], sides: [f64; 3], limit: f64) -> Ordering {
        if limit.is_infinite() {
            return if limit > 0.0 { Ordering::Less } else { Ordering::Greater };
        }
        // Of the normal with the direction; all sides have it.
        let facing = sides.into_iter().sum::<f64>();
        let [from_a, from_b, from_c] = [a, b, c].map(|corner| corner - self.origin);
        let (above, size) = volume(from_a, from_b, from_c);
        let approaches =
            [(from_a, from_b), (from_b, from_c), (from_c, from_a)].map(|(a, b)| volume(self.direction, a, b));
        let approach: f64 = approaches.iter().map(|(volume, _)| volume).sum();
        let approach_size: f64 = approaches.iter().map(|(_, size)| size).sum();
        let difference = above - limit * approach;
        // Three more roundings than in either volume.
        let sign = if difference.abs() > 2.0 * DOUBT * (size + limit.abs() * approach_size) {
            difference.signum()
        } else {
            let mut exact = Expansion::default();
            exact.add_determinant(1.0, a, b, c);
            for [x, y, z] in [[self.origin, b, c], [a, self.origin, c], [a, b, self.origin]] {
                exact.add_determinant(-1.0, x, y, z);
            }
            // What has the origin in it cancels out.
            for (from, to) in [(a, b), (b, c), (c, a)] {
                exact.add_determinant(-limit, self.direction, from, to);
            }
            exact.sign()
        };
        let sign = sign * facing;
        if sign < 0.0 {
            Ordering::Less
        } else if sign > 0.0 {
            Ordering::Greater
        } else {
            Ordering::Equal
        }
    }

    /// How the ray, with these ends of its `t`, and the triangle lie to each other.
    pub fn contact(&self, corners: [DVec3; 3], [t_min, t_max]: [f64; 2]) -> Contact {
        let Some(sides) = self.sides(corners) else {
            return Contact::None;
        };
        let ends = [
            self.compare_t(corners, sides, t_min),
            self.compare_t(corners, sides, t_max).reverse(),
        ];
        if ends.contains(&Ordering::Less) {
            Contact::None
        } else if sides.contains(&0.0) || ends.contains(&Ordering::Equal) {
            Contact::Touch
        } else {
            Contact::Inside
        }
    }
}

/// Twice the area vector of a triangle of f32 corners, rounded once at the end: `a x b + b x c + c x a`.
pub(super) fn normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|axis| {
        let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut sum = Expansion::default();
        for (from, to) in [(a, b), (b, c), (c, a)] {
            sum.add(from[j] * to[k]);
            sum.add(-(from[k] * to[j]));
        }
        sum.rounded()
    }))
}

/// The determinant of three vectors in f64, and the sum of its products' sizes.
fn volume(x: DVec3, y: DVec3, z: DVec3) -> (f64, f64) {
    let (mut volume, mut size) = (0.0, 0.0);
    for i in 0..3 {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let (plus, minus) = (y[j] * z[k], y[k] * z[j]);
        volume += x[i] * (plus - minus);
        size += x[i].abs() * (plus.abs() + minus.abs());
    }
    (volume, size)
}
