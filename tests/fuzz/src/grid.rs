//! Small whole numbers, of which f32 computes exactly what decides whether a ray crosses a triangle.

use crate::everywhere::cast_everywhere;
use arbitrary::Arbitrary;
use glam::Vec3;
use oktant::mesh::Mesh;
use oktant::oracle::judge::{Answer, judge_closest, t_error};
use oktant::oracle::{Oracle, OracleRay};
use oktant::structure::StructureOptions;
use oktant_shared::hit::Hit;
use oktant_shared::parts::{Parts, TraversalKind, TriangleKind};
use oktant_shared::ray::{Ray, T_MAX};

/// Triangles with corners at whole numbers, and rays from one to another.
#[derive(Arbitrary, Debug)]
pub struct Grid {
    triangles: Vec<[[u8; 3]; 3]>,
    rays: Vec<GridRay>,
}

/// A ray whose largest component is a power of two, by which f32 divides exactly.
#[derive(Arbitrary, Debug)]
struct GridRay {
    origin: [u8; 3],
    axis: u8,
    is_negative: bool,
    power: u8,
    others: [u8; 2],
}

/// More take too long.
const MOST: usize = 64;

/// Coordinates of corners are so far from 0 at most.
const REACH: u8 = 8;

/// It reaches as far as any corner may: no ray of a [`Grid`] is so far away that its origin is advanced, and rounded.
const FRAME: [[u8; 3]; 3] = [[0, 0, 0], [2 * REACH, 0, 0], [0, 2 * REACH, 2 * REACH]];

/// Relative error of the watertight test's `t`: it is a quotient of whole numbers, which is rounded.
const RELATIVE_T: f64 = 1e-6;

impl Grid {
    /// All traversals find what the oracle does, and with the watertight test what brute force finds, to the bit: of
    /// triangles at one place the one that comes out nearest, and of those at equal `t` the one with the lowest id.
    ///
    /// # Panics
    /// Where they do not.
    pub fn check(&self) {
        let (mesh, rays) = (self.mesh(), self.rays());
        let oracle = Oracle::new(&mesh);
        let exact: Vec<OracleRay> = rays
            .iter()
            .map(|ray| OracleRay::new(ray.origin, ray.direction, 0.0, T_MAX))
            .collect();
        let mut watertight: Vec<(Parts, Vec<Hit>)> = Vec::new();
        let done = cast_everywhere(&mesh, &StructureOptions::default(), &rays, |parts, closest, any| {
            if parts.triangle == TriangleKind::Watertight {
                watertight.push((parts, closest.to_vec()));
            }
            for ((ray, hit), any) in exact.iter().zip(closest).zip(any) {
                assert_eq!(hit.is_hit(), *any, "{parts}: {ray:?}");
                judge(&oracle, parts.triangle, ray, hit);
            }
        });
        done.unwrap_or_else(|error| panic!("{error}"));
        let brute = watertight
            .iter()
            .find(|(parts, _)| parts.traversal == TraversalKind::Brute);
        let (_, wanted) = brute.expect("brute force is offered with the watertight test");
        for (parts, found) in &watertight {
            for ((ray, found), wanted) in rays.iter().zip(found).zip(wanted) {
                assert_eq!(found, wanted, "{parts}: {ray:?}");
            }
        }
    }

    fn mesh(&self) -> Mesh {
        let corner = |corner: [u8; 3]| Vec3::from_array(corner.map(|it| number(it, REACH)));
        let triangles = self.triangles.iter().take(MOST).chain(std::iter::once(&FRAME));
        let positions: Vec<Vec3> = triangles.flatten().copied().map(corner).collect();
        Mesh {
            triangles: (0..positions.len() as u32 / 3)
                .map(|id| [3 * id, 3 * id + 1, 3 * id + 2])
                .collect(),
            positions,
            ..Mesh::default()
        }
    }

    fn rays(&self) -> Vec<Ray> {
        self.rays.iter().take(MOST).map(GridRay::ray).collect()
    }
}

impl GridRay {
    fn ray(&self) -> Ray {
        let main = 1 << (self.power % 4);
        let axis = usize::from(self.axis % 3);
        let mut direction = Vec3::ZERO;
        direction[axis] = if self.is_negative {
            -f32::from(main)
        } else {
            f32::from(main)
        };
        direction[(axis + 1) % 3] = number(self.others[0], main);
        direction[(axis + 2) % 3] = number(self.others[1], main);
        let origin = Vec3::from_array(self.origin.map(|it| number(it, 2 * REACH)));
        Ray::new(origin, direction)
    }
}

/// A whole number from `-reach` to `reach`.
fn number(byte: u8, reach: u8) -> f32 {
    f32::from(byte % (2 * reach + 1)) - f32::from(reach)
}

/// Whether there is a hit, by the watertight test and by Pluecker's, follows from sums of products of whole numbers; the
/// other tests round weights, and may err at edges.
fn judge(oracle: &Oracle, test: TriangleKind, ray: &OracleRay, hit: &Hit) {
    let answer = hit.is_hit().then(|| Answer {
        triangle: hit.triangle,
        t: f64::from(hit.t),
    });
    let right = oracle.closest(ray);
    // A sum of quotients that should be 0 may be a little less.
    let is_at_origin = right.is_some_and(|right| right.t <= t_error(oracle, right.triangle, ray));
    if !(test == TriangleKind::Watertight || test == TriangleKind::Plucker && !is_at_origin) {
        let verdict = judge_closest(oracle, ray, answer);
        assert!(!verdict.is_wrong(), "{test}: {ray:?}: {verdict:?}, {hit:?}");
        return;
    }
    match (right, answer) {
        (None, None) => {}
        (Some(right), Some(answer)) => {
            // Of two at the same place, the nearer by rounding. Pluecker's `t` is a sum of quotients.
            let met = oracle.meet(answer.triangle, ray).map(|met| met.t);
            let sum = match test {
                TriangleKind::Watertight => 0.0,
                _ => t_error(oracle, answer.triangle, ray) + t_error(oracle, right.triangle, ray),
            };
            let is_there = |t: f64| (t - right.t).abs() <= RELATIVE_T * right.t + sum;
            assert!(
                is_there(answer.t) && met.is_some_and(is_there),
                "{test}: {ray:?}: {right:?}, {hit:?}"
            );
        }
        _ => panic!("{test}: {ray:?}: {right:?}, {hit:?}"),
    }
}
