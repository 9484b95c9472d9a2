//! What the oracle says of a set of rays, and of who traced it.

use crate::backend::Query;
use crate::oracle::judge::{Answer, Excuse, judge_any, judge_closest};
use crate::oracle::{Oracle, OracleRay};
use oktant_shared::hit::Hit;
use oktant_shared::ray::Ray;
use rayon::prelude::*;
use serde::Serialize;
use std::fmt;

/// The largest part of itself by which a `t` may be off and count as right.
pub const TOLERANCE: f64 = 1e-5;

/// Disagreements that are written down of each judgement; the others are counted.
const LISTED: usize = 20;

/// The right answers to the rays of a set.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    query: Query,
    /// Of closest hits `t`, of any hits 0; infinity where there is none.
    answers: Vec<f64>,
}

/// How a tracer answered the rays of a set.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Judgement {
    /// Rays in all.
    pub rays: usize,
    /// The oracle hits something, the tracer nothing.
    pub missed: usize,
    /// The tracer hits something, the oracle nothing.
    #[serde(rename = "false")]
    pub phantom: usize,
    /// Both hit, and `t` is off by more than 10^-5 of itself.
    pub wrong_t: usize,
    /// How many of all these the rounding of f32 can be blamed for: the ray passes that close to an edge or a limit, or
    /// the triangle is that steep.
    pub excused: usize,
    /// The first of them, in the order of the rays.
    pub disagreements: Vec<Disagreement>,
}

/// A ray that was answered otherwise than by the oracle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Disagreement {
    /// Its place in the set.
    pub ray: usize,
    /// What the oracle says; none for a miss, 0 of any hits.
    pub right: Option<f64>,
    /// What the tracer says.
    pub answer: Option<f64>,
    /// Whether the rounding of f32 can be blamed.
    pub excused: bool,
}

impl Truth {
    /// Asks the oracle.
    pub fn new(oracle: &Oracle, query: Query, rays: &[Ray]) -> Self {
        let answer = |ray: &Ray| {
            let ray = for_oracle(ray);
            match query {
                Query::Closest => oracle.closest(&ray).map_or(f64::INFINITY, |hit| hit.t),
                Query::Any if oracle.any(&ray) => 0.0,
                Query::Any => f64::INFINITY,
            }
        };
        Truth {
            query,
            answers: rays.par_iter().map(answer).collect(),
        }
    }

    /// Rays that hit something.
    pub fn hits(&self) -> usize {
        self.answers.iter().filter(|t| t.is_finite()).count()
    }

    /// Judges a tracer's hits, with triangles by id; of any hits only whether they are hits counts.
    pub fn judge(&self, oracle: &Oracle, rays: &[Ray], hits: &[Hit]) -> Judgement {
        let both = self.answers.par_iter().zip(hits.par_iter());
        let wrong: Vec<Disagreement> = both
            .enumerate()
            .filter_map(|(ray, (&right, hit))| {
                let answer = match (hit.is_hit(), self.query) {
                    (false, _) => f64::INFINITY,
                    (true, Query::Closest) => f64::from(hit.t),
                    (true, Query::Any) => 0.0,
                };
                let agrees = right == answer || (right - answer).abs() <= TOLERANCE * right && right.is_finite();
                (!agrees).then(|| Disagreement {
                    ray,
                    right: right.is_finite().then_some(right),
                    answer: answer.is_finite().then_some(answer),
                    excused: self.is_excused(oracle, &rays[ray], hit),
                })
            })
            .collect();
        let of = |is: fn(&Disagreement) -> bool| wrong.iter().filter(|one| is(one)).count();
        Judgement {
            rays: rays.len(),
            missed: of(|one| one.answer.is_none()),
            phantom: of(|one| one.right.is_none()),
            wrong_t: of(|one| one.right.is_some() && one.answer.is_some()),
            excused: of(|one| one.excused),
            disagreements: wrong.into_iter().take(LISTED).collect(),
        }
    }

    fn is_excused(&self, oracle: &Oracle, ray: &Ray, hit: &Hit) -> bool {
        let ray = for_oracle(ray);
        let verdict = match self.query {
            Query::Closest => {
                let answer = hit.is_hit().then(|| Answer {
                    triangle: hit.triangle,
                    t: f64::from(hit.t),
                });
                judge_closest(oracle, &ray, answer)
            }
            Query::Any => judge_any(oracle, &ray, hit.is_hit()),
        };
        // Where it agrees after all, its tolerance for steep triangles has done it.
        verdict.excuse != Excuse::None || !verdict.is_wrong()
    }
}

impl Judgement {
    /// Everything in which it differs from the oracle.
    pub fn disagreeing(&self) -> usize {
        self.missed + self.phantom + self.wrong_t
    }
}

/// The ray and both answers, in a few words.
impl fmt::Display for Disagreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let told = |t: Option<f64>| t.map_or("miss".to_owned(), |t| t.to_string());
        write!(f, "{} ({} for {}", self.ray, told(self.answer), told(self.right))?;
        f.write_str(if self.excused { ", excused)" } else { ")" })
    }
}

fn for_oracle(ray: &Ray) -> OracleRay {
    OracleRay::new(ray.origin, ray.direction, ray.t_min, ray.t_max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generated::bumpy_ball;
    use glam::Vec3;

    /// One ray that hits the middle of a ball and one that passes it, answered rightly and in every wrong way.
    #[test]
    fn every_error_is_counted_as_what_it_is() {
        let oracle = Oracle::new(&bumpy_ball(1_000));
        let rays = [Vec3::new(0.1, 0.2, 3.0), Vec3::new(2.0, 0.0, 3.0)].map(|origin| Ray::new(origin, Vec3::NEG_Z));
        let hit = oracle.closest(&for_oracle(&rays[0])).unwrap();
        let at = |t: f64| Hit {
            t: t as f32,
            triangle: hit.triangle,
            u: 0.0,
            v: 0.0,
        };
        let miss = Hit::miss(1.0);
        let truth = Truth::new(&oracle, Query::Closest, &rays);
        assert_eq!(truth.hits(), 1);
        for (hits, counts) in [
            ([at(hit.t), miss], (0, 0, 0)),
            ([at(hit.t * (1.0 + 0.5 * TOLERANCE)), miss], (0, 0, 0)),
            ([at(hit.t * (1.0 + 9.0 * TOLERANCE)), miss], (0, 0, 1)),
            ([miss, miss], (1, 0, 0)),
            ([at(hit.t), at(2.0)], (0, 1, 0)),
            ([miss, at(2.0)], (1, 1, 0)),
        ] {
            let judged = truth.judge(&oracle, &rays, &hits);
            assert_eq!((judged.missed, judged.phantom, judged.wrong_t), counts);
            assert_eq!((judged.rays, judged.excused), (2, 0));
            assert_eq!(judged.disagreements.len(), judged.disagreeing());
        }
        let truth = Truth::new(&oracle, Query::Any, &rays);
        let judged = truth.judge(&oracle, &rays, &[at(0.0), at(0.0)]);
        assert_eq!((judged.missed, judged.phantom, judged.wrong_t), (0, 1, 0));
        let listed = judged.disagreements[0];
        assert_eq!((listed.ray, listed.right, listed.answer), (1, None, Some(0.0)));
    }
}
