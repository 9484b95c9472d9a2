//! The judge against tracers that are known to be right, sloppy or wrong.

use glam::{DVec3, Vec3};
use oktant::mesh::Mesh;
use oktant::oracle::judge::{Answer, Excuse, Outcome, Verdict, judge_any, judge_closest};
use oktant::oracle::{Oracle, OracleHit};
use oktant_shared::ray::Ray;
use oktant_tests::meshes::soup;
use oktant_tests::ray_classes::{RayClass, for_oracle, rays};
use oktant_tests::tally::Tally;
use rayon::prelude::*;

use super::{bunny, cells, meshes};

/// Moller and Trumbore in f32 by brute force; misses where the determinant is at most `epsilon`.
struct MollerTrumbore {
    triangles: Vec<[Vec3; 3]>,
    epsilon: f32,
}

impl MollerTrumbore {
    fn new(mesh: &Mesh, epsilon: f32) -> Self {
        let corners = |triangle: &[u32; 3]| triangle.map(|vertex| mesh.positions[vertex as usize]);
        MollerTrumbore {
            triangles: mesh.triangles.iter().map(corners).collect(),
            epsilon,
        }
    }

    fn t(&self, ray: &Ray, [a, b, c]: [Vec3; 3]) -> Option<f32> {
        let (to_b, to_c) = (b - a, c - a);
        let p = ray.direction.cross(to_c);
        let determinant = to_b.dot(p);
        if determinant.abs() <= self.epsilon {
            return None;
        }
        let to_origin = ray.origin - a;
        let u = to_origin.dot(p) / determinant;
        let q = to_origin.cross(to_b);
        let v = ray.direction.dot(q) / determinant;
        let t = to_c.dot(q) / determinant;
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= ray.t_min && t <= ray.t_max).then_some(t)
    }

    fn closest(&self, ray: &Ray) -> Option<Answer> {
        let mut best: Option<Answer> = None;
        for (id, &triangle) in (0..).zip(&self.triangles) {
            if let Some(t) = self.t(ray, triangle)
                && best.is_none_or(|best| f64::from(t) < best.t)
            {
                best = Some(Answer {
                    triangle: id,
                    t: t.into(),
                });
            }
        }
        best
    }
}

/// Verdicts on a tracer's closest and any hits.
fn judge(oracle: &Oracle, rays: &[Ray], tracer: impl Fn(&Ray) -> Option<Answer> + Sync) -> [Tally; 2] {
    let verdicts: Vec<[Verdict; 2]> = rays
        .par_iter()
        .map(|ray| {
            let answer = tracer(ray);
            let ray = for_oracle(ray);
            [
                judge_closest(oracle, &ray, answer),
                judge_any(oracle, &ray, answer.is_some()),
            ]
        })
        .collect();
    [0, 1].map(|kind| verdicts.iter().map(|verdict| verdict[kind]).collect())
}

/// Brute force in f32 is right but for rays within the f32 error of an edge, in all classes of rays that start near
/// the mesh. From far away, where Moller-Trumbore is worse than f32 need be, its counts are only printed.
#[test]
fn f32_brute_force_is_right_but_for_its_rounding() {
    for (name, mesh) in meshes() {
        let (oracle, tracer) = (Oracle::new(&mesh), MollerTrumbore::new(&mesh, 0.0));
        let count = if mesh.triangles.len() > 20_000 { 50 } else { 500 };
        for class in RayClass::ALL {
            let rays = rays(class, &mesh, &cells(&mesh), count, 5);
            let [closest, any] = judge(&oracle, &rays, |ray| tracer.closest(ray));
            println!("{name}, {}: closest {closest}; any {any}", class.name());
            if !matches!(class, RayClass::AimedFar | RayClass::AimedVeryFar) {
                assert_eq!((closest.wrong(), any.wrong()), (0, 0), "{name}, {}", class.name());
            }
        }
    }
}

/// On triangles as small as the bunny's, an absolute epsilon of 1e-5 loses everything, and the judge says so.
#[test]
fn an_absolute_epsilon_is_found_to_miss_all() {
    let mesh = bunny();
    let (oracle, tracer) = (Oracle::new(&mesh), MollerTrumbore::new(&mesh, 1e-5));
    let rays: Vec<Ray> = rays(RayClass::AimedNear, &mesh, &cells(&mesh), 600, 6)
        .into_iter()
        .map(|ray| Ray::new(ray.origin, ray.direction.normalize()))
        .collect();
    let [closest, any] = judge(&oracle, &rays, |ray| tracer.closest(ray));
    let hits = rays.iter().filter(|ray| oracle.any(&for_oracle(ray))).count();
    println!("{hits} hits; epsilon 1e-5: closest {closest}; any {any}");
    assert!(hits > 300);
    for tally in [closest, any] {
        // No two rays in a hundred pass within the f32 error of an edge.
        assert_eq!(tally.wrong() + tally.excused(), hits);
        assert!(tally.count(Outcome::Missed, Excuse::None) > hits * 98 / 100);
    }
    assert_eq!(
        judge(&oracle, &rays, |ray| MollerTrumbore::new(&mesh, 0.0).closest(ray))[0].wrong(),
        0
    );
}

/// Every outcome, from answers made wrong on purpose.
#[test]
fn the_judge_tells_wrong_answers_apart() {
    let mesh = soup(2_000, 2);
    let oracle = Oracle::new(&mesh);
    let rays = rays(RayClass::AimedNear, &mesh, &cells(&mesh), 2_000, 7);
    let hits = |ray: &Ray| oracle.hits(&for_oracle(ray));
    let answer = |hit: &OracleHit| Answer {
        triangle: hit.triangle,
        t: hit.t,
    };
    let count = |least: usize| rays.iter().filter(|ray| hits(ray).len() >= least).count();
    let outcome = |tracer: &(dyn Fn(&Ray) -> Option<Answer> + Sync), outcome: Outcome| {
        let [closest, any] = judge(&oracle, &rays, tracer);
        println!("{outcome:?}: closest {closest}; any {any}");
        (
            closest.count(outcome, Excuse::None),
            closest.excused(),
            any.wrong() + any.excused(),
        )
    };
    let right = |ray: &Ray| hits(ray).first().map(answer);
    assert_eq!(outcome(&right, Outcome::Agrees), (2_000, 0, 0));
    let rounded = |ray: &Ray| {
        right(ray).map(|answer| Answer {
            t: answer.t * (1.0 + 9e-6),
            ..answer
        })
    };
    assert_eq!(outcome(&rounded, Outcome::Agrees), (2_000, 0, 0));

    let (missed, excused, any) = outcome(&|_| None, Outcome::Missed);
    assert_eq!((missed + excused, any), (count(1), count(1)));
    assert!(excused < 10);
    let (farther, excused, any) = outcome(
        &|ray| hits(ray).get(1).map(answer).or_else(|| right(ray)),
        Outcome::Farther,
    );
    // Some second hits lie as near as the first within the tolerance.
    assert!((count(2) - 10..=count(2)).contains(&(farther + excused)) && excused < 10);
    assert_eq!(any, 0);

    let scaled = |factor: f64| {
        move |ray: &Ray| {
            right(ray).map(|answer| Answer {
                t: answer.t * factor,
                ..answer
            })
        }
    };
    assert_eq!(outcome(&scaled(0.99), Outcome::Nearer), (count(1), 0, 0));
    assert_eq!(outcome(&scaled(1.01), Outcome::Farther), (count(1), 0, 0));
    assert_eq!(outcome(&scaled(f64::NAN), Outcome::False), (count(1), 0, 0));
    // The right `t` with another triangle, and with none at all.
    for shift in [1_000, 2_000] {
        let elsewhere = |ray: &Ray| {
            right(ray).map(|answer| Answer {
                triangle: if shift == 2_000 {
                    answer.triangle + shift
                } else {
                    (answer.triangle + shift) % 2_000
                },
                ..answer
            })
        };
        assert_eq!(outcome(&elsewhere, Outcome::False), (count(1), 0, 0));
    }
    let phantom = |ray: &Ray| right(ray).or(Some(Answer { triangle: 0, t: 1.0 }));
    let (invented, excused, any) = outcome(&phantom, Outcome::False);
    assert_eq!((invented + excused, any), (2_000 - count(1), 2_000 - count(1)));
}

/// One triangle behind another: misses and false hits are excused at the edge of the one, but not past the other.
#[test]
fn the_judge_excuses_edges_only() {
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
    let behind = [
        Vec3::new(-4.0, -4.0, 1.0),
        Vec3::new(8.0, -4.0, 1.0),
        Vec3::new(-4.0, 8.0, 1.0),
    ];
    let mesh = |triangles: usize| Mesh {
        positions: corners.into_iter().chain(behind).collect(),
        triangles: vec![[0, 1, 2], [3, 4, 5]][..triangles].to_vec(),
        ..Mesh::default()
    };
    let (one, two) = (Oracle::new(&mesh(1)), Oracle::new(&mesh(2)));
    let ray = |x: f64| {
        let mut ray = for_oracle(&Ray::new(Vec3::new(0.0, 0.25, -1.0), Vec3::Z));
        ray.origin.x = x;
        ray
    };
    let front = Some(Answer { triangle: 0, t: 1.0 });
    let back = Some(Answer { triangle: 1, t: 2.0 });
    let closest = |oracle: &Oracle, x: f64, answer: Option<Answer>| {
        let Verdict { outcome, excuse } = judge_closest(oracle, &ray(x), answer);
        (outcome, excuse)
    };
    // The f32 error is 4 * 2^-24 * (1 + 1.4) here.
    let (near, far) = (3e-7, 1e-6);
    assert_eq!(closest(&one, near, None), (Outcome::Missed, Excuse::Edge));
    assert_eq!(closest(&one, far, None), (Outcome::Missed, Excuse::None));
    assert_eq!(closest(&one, -near, front), (Outcome::False, Excuse::Edge));
    assert_eq!(closest(&one, -far, front), (Outcome::False, Excuse::None));
    assert_eq!(closest(&two, near, back), (Outcome::Farther, Excuse::Edge));
    assert_eq!(closest(&two, far, back), (Outcome::Farther, Excuse::None));
    assert_eq!(closest(&two, near, None), (Outcome::Missed, Excuse::None));
    assert_eq!(closest(&two, -near, front), (Outcome::Nearer, Excuse::Edge));
    assert_eq!(closest(&two, -far, front), (Outcome::Nearer, Excuse::None));

    let any = |x: f64, answer: bool| {
        let Verdict { outcome, excuse } = judge_any(&one, &ray(x), answer);
        (outcome, excuse)
    };
    assert_eq!(any(near, false), (Outcome::Missed, Excuse::Edge));
    assert_eq!(any(far, false), (Outcome::Missed, Excuse::None));
    assert_eq!(any(-near, true), (Outcome::False, Excuse::Edge));
    assert_eq!(any(-far, true), (Outcome::False, Excuse::None));

    let mut limited = ray(0.25);
    limited.t_max = 1.0 + 1e-7;
    let verdict = judge_closest(&one, &limited, None);
    assert_eq!((verdict.outcome, verdict.excuse), (Outcome::Missed, Excuse::Limit));
    limited.t_max = 1.0 - 1e-7;
    let verdict = judge_closest(
        &one,
        &limited,
        Some(Answer {
            triangle: 0,
            t: 1.0 - 1e-7,
        }),
    );
    assert_eq!((verdict.outcome, verdict.excuse), (Outcome::False, Excuse::Limit));
    assert!(judge_any(&one, &limited, true).excuse == Excuse::Limit);
    limited.t_max = 0.9;
    let verdict = judge_closest(&one, &limited, Some(Answer { triangle: 0, t: 0.9 }));
    assert_eq!((verdict.outcome, verdict.excuse), (Outcome::False, Excuse::None));
    limited.origin += DVec3::Z;
    limited.t_min = 0.0;
    assert_eq!(judge_closest(&one, &limited, None).outcome, Outcome::Missed);
}
