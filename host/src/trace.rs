//! One ray on its way through a structure, written down: what it visits, what it tests, and what each test and the oracle
//! say of it.
//!
//! It is the code of the traversals that runs, with parts put in that write down (`recorder`).

mod cells;
mod descent;
mod export;
mod recorder;
mod table;

pub(crate) use cells::Layout;
pub(crate) use descent::{Cell, Content, children, root};
pub use export::{obj, ply};
pub(crate) use recorder::Recorder;
pub use table::table;

use crate::bench::PartNames;
use crate::mesh::Mesh;
use crate::oracle::judge::{Answer, Excuse, Outcome, judge_closest};
use crate::oracle::{Contact, Oracle, OracleRay};
use crate::scene::Scene;
use glam::Vec3;
use oktant_shared::box_test::{BoxTest, KayKajiya, Williams};
use oktant_shared::general::AnyTriangle;
use oktant_shared::parts::{BoxKind, Parts, TriangleKind};
use oktant_shared::ray::{PreparedRay, Ray};
use oktant_shared::scene::Scene as View;
use oktant_shared::triangle::Triangle;
use oktant_shared::triangle_test::TriangleTest;
use serde::Serialize;

/// All that was written down of a ray.
#[derive(Clone, Debug, Serialize)]
pub struct Trace {
    /// The ray.
    pub ray: TracedRay,
    /// What it was traced with.
    pub parts: PartNames,
    /// What the traversal found.
    pub hit: Option<TracedHit>,
    /// What there is, in f64.
    pub right: Option<TracedHit>,
    /// What there is behind that, in f64, nearest first.
    pub beyond: Vec<TracedHit>,
    /// How the two compare.
    pub verdict: &'static str,
    /// By how much the origin was advanced to the structure, in `t`.
    pub advanced: f32,
    /// What every box test says of the box round the mesh.
    pub boxes: Vec<BoxAnswer>,
    /// What was visited, in that order.
    pub visits: Vec<Visit>,
    /// The triangles that were tested, in that order; one that is in several cells comes again.
    pub tests: Vec<Tested>,
}

/// The ray as it was given.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct TracedRay {
    /// Where it starts, scene units.
    pub origin: Vec3Array,
    /// Where it goes, scene units per `t`.
    pub direction: Vec3Array,
    /// Smallest `t` that counts.
    pub t_min: f32,
    /// Largest `t` that counts.
    pub t_max: f32,
    /// Whether it can hit anything at all.
    pub valid: bool,
}

/// Three coordinates.
pub type Vec3Array = [f32; 3];

/// Where a ray met a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct TracedHit {
    /// The triangle's id.
    pub triangle: u32,
    /// In lengths of the ray's direction.
    pub t: f64,
    /// Weight of the second corner.
    pub u: f64,
    /// Weight of the third corner.
    pub v: f64,
}

/// What a box test says.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct BoxAnswer {
    /// The test.
    pub test: &'static str,
    /// Where the ray enters, in lengths of its direction.
    pub enter: f32,
    /// Where it leaves.
    pub exit: f32,
    /// Whether it is inside at some `t` from 0.
    pub meets: bool,
}

/// A part of the structure on the ray's way.
#[derive(Clone, Debug, Serialize)]
pub struct Visit {
    /// "node" or "leaf"; of the grid "cell".
    pub kind: &'static str,
    /// Its index among the nodes or cells; of leaves of trees of boxes the slot of their first triangle.
    pub index: u32,
    /// Its level; the root's is 0.
    pub depth: u32,
    /// Its corner with the smallest coordinates.
    pub low: Vec3Array,
    /// Its corner with the largest coordinates.
    pub high: Vec3Array,
    /// The nearest hit so far, in lengths of the direction; the ray's largest `t` where there is none.
    pub limit: f32,
    /// Its triangles: how many there are.
    pub triangles: u32,
}

/// A triangle that was tested.
#[derive(Clone, Debug, Serialize)]
pub struct Tested {
    /// Its id.
    pub triangle: u32,
    /// Its corners.
    pub corners: [Vec3Array; 3],
    /// What every test says.
    pub answers: Vec<TestAnswer>,
    /// Where the line meets it, in f64; none where it passes by.
    pub exact: Option<TracedHit>,
    /// How ray and triangle lie to each other, without any rounding: "apart", "inside" or "touch".
    pub contact: &'static str,
    /// How far the line passes from the nearest edge, scene units.
    pub edge_distance: f64,
}

/// What a triangle test says of the ray as the traversal has it.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct TestAnswer {
    /// The test.
    pub test: &'static str,
    /// Whether the line crosses the triangle; the numbers mean nothing otherwise.
    pub crosses: bool,
    /// In lengths of the ray's direction.
    pub t: f32,
    /// Weight of the second corner.
    pub u: f32,
    /// Weight of the third corner.
    pub v: f32,
}

impl Trace {
    /// Traces a ray with the parts that the scene was built for; the scene is that of the mesh.
    pub fn new(mesh: &Mesh, scene: &Scene, ray: &Ray) -> Self {
        let oracle = Oracle::new(mesh);
        let exact = OracleRay::new(ray.origin, ray.direction, ray.t_min.max(0.0), ray.t_max);
        let prepared = PreparedRay::new(ray);
        let record = Recorder::new(scene).record(scene, ray);
        let hit = record.hit.is_hit().then(|| TracedHit {
            triangle: scene.ids[record.hit.triangle as usize],
            t: f64::from(record.hit.t),
            u: f64::from(record.hit.u),
            v: f64::from(record.hit.v),
        });
        let answer = hit.map(|hit| Answer {
            triangle: hit.triangle,
            t: hit.t,
        });
        // Along the main axis, where a difference of origins tells the most.
        let axis = prepared.direction.abs().max_position();
        let advance = (record.ray.origin - prepared.origin)[axis] / prepared.direction[axis];
        let advance = if prepared.valid { advance } else { 0.0 };
        let tested = |slot: &u32| {
            let id = scene.ids[*slot as usize];
            let triangle = &scene.view().triangle(*slot);
            Tested {
                triangle: id,
                corners: [triangle.a, triangle.b, triangle.c].map(|corner| corner.to_array()),
                answers: TriangleKind::ALL
                    .iter()
                    .map(|kind| TestAnswer::new(scene, *kind, &record.ray, advance, triangle))
                    .collect(),
                exact: oracle.meet(id, &exact).map(|met| TracedHit {
                    triangle: id,
                    t: met.t,
                    u: met.u,
                    v: met.v,
                }),
                contact: match oracle.contact(id, &exact) {
                    Some(Contact::Inside) => "inside",
                    Some(Contact::Touch) => "touch",
                    Some(Contact::None) | None => "apart",
                },
                edge_distance: oracle.edge_distance(id, &exact),
            }
        };
        let mut there = oracle.hits(&exact).into_iter().map(|hit| TracedHit {
            triangle: hit.triangle,
            t: hit.t,
            u: hit.u,
            v: hit.v,
        });
        let (low, high) = mesh.bounds().unwrap_or((Vec3::ZERO, Vec3::ZERO));
        let aabb = oktant_shared::aabb::Aabb { low, high };
        let boxes = BoxKind::ALL.iter().map(|kind| {
            let interval = match kind {
                BoxKind::KayKajiya => KayKajiya::prepare(&prepared).interval(&aabb),
                BoxKind::Williams => Williams::prepare(&prepared).interval(&aabb),
            };
            BoxAnswer {
                test: kind.description().name,
                enter: interval.enter * prepared.scale,
                exit: interval.exit * prepared.scale,
                meets: prepared.valid && interval.enter <= interval.exit && interval.exit >= prepared.t_min,
            }
        });
        Trace {
            ray: TracedRay {
                origin: ray.origin.to_array(),
                direction: ray.direction.to_array(),
                t_min: ray.t_min,
                t_max: ray.t_max,
                valid: prepared.valid,
            },
            parts: PartNames::of(scene.parts),
            hit,
            right: there.next(),
            beyond: there.collect(),
            verdict: verdict(&oracle, &exact, answer),
            advanced: advance * prepared.scale,
            boxes: boxes.collect(),
            tests: record.tests.iter().map(tested).collect(),
            visits: Layout::new(scene).visits(scene, &record, prepared.scale, advance),
        }
    }
}

impl TestAnswer {
    fn new(scene: &Scene, kind: TriangleKind, ray: &PreparedRay, advance: f32, triangle: &Triangle) -> Self {
        let view = View {
            parts: Parts {
                triangle: kind,
                ..scene.parts
            }
            .number(),
            ..scene.view()
        };
        let crossing = AnyTriangle::prepare_in(&view, ray).crossing(triangle);
        TestAnswer {
            test: kind.description().name,
            crosses: crossing.crosses,
            t: (crossing.t + advance) * ray.scale,
            u: crossing.u,
            v: crossing.v,
        }
    }
}

fn verdict(oracle: &Oracle, ray: &OracleRay, answer: Option<Answer>) -> &'static str {
    let verdict = judge_closest(oracle, ray, answer);
    match (verdict.outcome, verdict.excuse) {
        (Outcome::Agrees, _) => "agrees with f64",
        (Outcome::Missed, Excuse::None) => "missed",
        (Outcome::Farther, Excuse::None) => "farther than f64",
        (Outcome::Nearer, Excuse::None) => "nearer than f64",
        (Outcome::False, Excuse::None) => "false",
        (_, Excuse::Edge) => "differs from f64, closer to an edge than f32 can tell",
        (_, Excuse::Limit) => "differs from f64, closer to an end of the ray than f32 can tell",
    }
}
