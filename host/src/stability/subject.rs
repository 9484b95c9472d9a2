//! A mesh and rays that some method has failed on, and what is right.

use super::tally::{Counts, Failure};
use crate::mesh::Mesh;
use crate::oracle::judge::{Answer, Excuse, Outcome, judge_closest};
use crate::oracle::{Contact, Oracle, OracleRay};
use crate::progress::silent;
use crate::scene::{Scene, SceneError};
use crate::structure::StructureOptions;
use glam::{DVec3, Vec3};
use oktant_shared::hit::Hit;
use oktant_shared::parts::TraversalKind;
use oktant_shared::ray::{PreparedRay, Ray};
use oktant_shared::triangle::Triangle;
use oktant_shared::triangle_test::TriangleTest;
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::Arc;

/// What is asked of the answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// The oracle's closest hit, but where f32 cannot tell.
    Oracle,
    /// As before, and some hit of every ray: the surface is closed, or the ray meets it exactly.
    Hit,
}

/// The subject of a row.
pub struct Subject {
    /// The mesh.
    pub mesh: Mesh,
    /// The rays.
    pub rays: Vec<Ray>,
    /// What is asked.
    pub wanted: Wanted,
    oracle: Oracle,
    scenes: HashMap<TraversalKind, Arc<Scene>>,
}

/// Wrong answers that are written down of each method.
pub const KEPT: usize = 5;

impl Subject {
    /// Asks the oracle and builds the structures of some traversals.
    ///
    /// # Errors
    /// [`SceneError`] where the mesh has nothing to build from.
    pub fn new(mesh: Mesh, rays: Vec<Ray>, wanted: Wanted, traversals: &[TraversalKind]) -> Result<Self, SceneError> {
        let mut scenes = HashMap::new();
        for traversal in traversals {
            let options = StructureOptions::of(*traversal);
            scenes.insert(*traversal, Arc::new(Scene::new(&mesh, &options, &silent)?));
        }
        Ok(Subject {
            oracle: Oracle::new(&mesh),
            mesh,
            rays,
            wanted,
            scenes,
        })
    }

    /// The mesh with the structure of a traversal, where it was asked for.
    pub fn scene(&self, traversal: TraversalKind) -> Option<&Arc<Scene>> {
        self.scenes.get(&traversal)
    }

    /// Judges closest hits, with ids.
    pub fn judge(&self, hits: &[Hit]) -> (Counts, Vec<Failure>) {
        let kinds: Vec<(Option<&'static str>, bool)> = self
            .rays
            .par_iter()
            .zip(hits)
            .map(|(ray, hit)| self.kind(ray, hit))
            .collect();
        let of = |wanted| kinds.iter().filter(|(kind, _)| *kind == Some(wanted)).count();
        let counts = Counts {
            rays: hits.len(),
            missed: of("missed"),
            phantom: of("false"),
            farther: of("farther"),
            not_finite: of("not finite"),
            doubled: None,
            excused: kinds.iter().filter(|(_, excused)| *excused).count(),
            excess: 0,
        };
        let wrong = kinds
            .iter()
            .enumerate()
            .filter_map(|(at, (kind, _))| Some((at, (*kind)?)));
        let failures = wrong
            .take(KEPT)
            .map(|(at, kind)| self.failure(kind, &self.rays[at], &hits[at]))
            .collect();
        (counts, failures)
    }

    /// What is wrong with an answer, and whether something is that rounding excuses.
    fn kind(&self, ray: &Ray, hit: &Hit) -> (Option<&'static str>, bool) {
        let answer = hit.is_hit().then(|| Answer {
            triangle: hit.triangle,
            t: f64::from(hit.t),
        });
        if hit.is_hit() && ![hit.t, hit.u, hit.v].iter().all(|number| number.is_finite()) {
            return (Some("not finite"), false);
        }
        if self.wanted == Wanted::Hit && !hit.is_hit() {
            return (Some("missed"), false);
        }
        let verdict = judge_closest(&self.oracle, &for_oracle(ray), answer);
        let kind = match verdict.outcome {
            Outcome::Agrees => return (None, false),
            Outcome::Missed => "missed",
            Outcome::Farther => "farther",
            Outcome::Nearer | Outcome::False => "false",
        };
        if verdict.excuse == Excuse::None {
            (Some(kind), false)
        } else {
            (None, true)
        }
    }

    fn failure(&self, kind: &'static str, ray: &Ray, hit: &Hit) -> Failure {
        let exact = for_oracle(ray);
        let mut ids: Vec<u32> = self.touched(&exact).into_iter().map(|(id, _)| id).collect();
        if hit.is_hit() && !ids.contains(&hit.triangle) {
            ids.push(hit.triangle);
        }
        let corners = |id: &u32| {
            let corners = self.oracle.corners(*id);
            corners.map(|corner| corner.as_vec3().to_array()).to_vec()
        };
        Failure {
            kind,
            corners: ids.iter().take(8).map(corners).collect(),
            right: self.oracle.closest(&exact).map(|hit| hit.t),
            answer: hit.is_hit().then_some(hit.t),
            ..Failure::of_ray(ray)
        }
    }

    /// The triangles that a ray has contact with, exactly.
    fn touched(&self, ray: &OracleRay) -> Vec<(u32, Contact)> {
        if !ray.is_valid() {
            return Vec::new();
        }
        let near = self.oracle.triangles_within(ray, 0.0).into_iter();
        near.filter_map(|id| Some((id, self.oracle.contact(id, ray)?)))
            .filter(|(_, contact)| *contact != Contact::None)
            .collect()
    }

    /// Rays that cross more triangles by the test `T` than they do exactly, of those that cross any.
    pub fn doubled<T: TriangleTest>(&self) -> usize {
        self.doubled_by(T::prepare)
    }

    /// The same by a test that is prepared otherwise.
    pub fn doubled_by<T: TriangleTest>(&self, prepare: impl Fn(&PreparedRay) -> T + Sync) -> usize {
        let doubled = |ray: &&Ray| {
            let prepared = PreparedRay::new(ray);
            let exact = for_oracle(ray);
            if !prepared.valid || !exact.is_valid() {
                return false;
            }
            let test = prepare(&prepared);
            // No test that is any good is off by more.
            let reach = 1e-5 * (exact.origin.length() + self.oracle.bounds().1.abs().max_element());
            let crossed = self.oracle.triangles_within(&exact, reach).into_iter().filter(|id| {
                let [a, b, c] = self.oracle.corners(*id).map(DVec3::as_vec3);
                let crossing = test.crossing(&triangle([a, b, c]));
                crossing.crosses && crossing.t >= prepared.t_min && crossing.t <= prepared.t_max
            });
            let crossed = crossed.count();
            crossed > 1 && crossed > self.touched(&exact).len()
        };
        self.rays.par_iter().filter(doubled).count()
    }
}

/// The ray as the oracle takes it: hits count at `t >= 0` only.
fn for_oracle(ray: &Ray) -> OracleRay {
    OracleRay::new(ray.origin, ray.direction, ray.t_min.max(0.0), ray.t_max)
}

/// A triangle of corners alone.
pub fn triangle([a, b, c]: [Vec3; 3]) -> Triangle {
    Triangle {
        a,
        vertex_a: 0,
        b,
        vertex_b: 0,
        c,
        vertex_c: 0,
    }
}

/// The triangles of a mesh by id.
pub fn triangles(mesh: &Mesh) -> Vec<Triangle> {
    let of = |corners: &[u32; 3]| triangle(corners.map(|corner| mesh.positions[corner as usize]));
    mesh.triangles.iter().map(of).collect()
}
