//! Everyone on the same rays.

use crate::contestant::{Contestant, Entry, Failure};
use crate::course::{Course, Set};
use crate::report::{ContestantReport, CourseReport, SetReport};
use crate::threads::fill;
use oktant::bench::Judgement;
use oktant::spread::Spread;
use oktant_shared::hit::Hit;
use std::time::Instant;

/// Numbers of threads that times are taken with.
const THREADS: [usize; 2] = [1, 2];

/// Why nothing was measured.
#[derive(Debug, thiserror::Error)]
pub enum RaceError {
    /// A contestant could not be built.
    #[error(transparent)]
    Build(#[from] Failure),
    /// No threads.
    #[error("No threads could be started ({0}); end other programs.")]
    Threads(#[from] rayon::ThreadPoolBuildError),
}

/// Where hits go.
struct Memory {
    hits: Vec<Hit>,
    found: Vec<bool>,
}

/// A contestant in the race.
struct Runner<'a> {
    entry: &'a Entry,
    built: Box<dyn Contestant>,
    judgements: Vec<Judgement>,
    /// Milliseconds by number of threads and set.
    times: [Vec<Vec<f64>>; 2],
}

/// Builds, checks and times all entries on a course.
///
/// Builds are repeated in turn, each dropped before the next. Then everyone is checked by the oracle, which warms up. Of the
/// times, repetitions are the outer loop and contestants the inner one, whose order turns round each time, so that what
/// disturbs falls on all alike.
///
/// # Errors
/// [`RaceError`].
pub fn race(course: &Course, entries: &[Entry], repeats: usize) -> Result<CourseReport, RaceError> {
    let building = builds(course, entries, repeats)?;
    let most = course.sets.iter().map(|set| set.rays.len()).max().unwrap_or(0);
    let mut memory = Memory {
        hits: vec![Hit::miss(0.0); most],
        found: vec![false; most],
    };
    let mut runners = Vec::new();
    for entry in entries {
        let built = (entry.build)(course.own_mesh(), rayon::current_num_threads())?;
        let judge = |set| judge(course, set, &*built, &mut memory);
        runners.push(Runner {
            entry,
            judgements: course.sets.iter().map(judge).collect(),
            built,
            times: [(); 2].map(|()| vec![Vec::new(); course.sets.len()]),
        });
    }
    for (times, threads) in THREADS.into_iter().enumerate() {
        for repetition in 0..repeats {
            let mut order: Vec<usize> = (0..runners.len()).collect();
            if repetition % 2 == 1 {
                order.reverse();
            }
            for place in order {
                let runner = &mut runners[place];
                for (set, so_far) in course.sets.iter().zip(&mut runner.times[times]) {
                    let start = Instant::now();
                    trace(set, &*runner.built, threads, &mut memory);
                    so_far.push(start.elapsed().as_secs_f64() * 1e3);
                }
            }
        }
    }
    let reports = runners.into_iter().zip(building);
    Ok(CourseReport {
        name: course.name.clone(),
        triangles: course.mesh.triangles.len(),
        conditions: THREADS
            .map(|threads| format!("{threads} thread{}", if threads == 1 { "" } else { "s" }))
            .into(),
        contestants: reports.map(|(runner, builds)| report(course, runner, builds)).collect(),
    })
}

/// Milliseconds of each entry's builds by number of threads.
fn builds(course: &Course, entries: &[Entry], repeats: usize) -> Result<Vec<[Vec<f64>; 2]>, RaceError> {
    let mut times: Vec<[Vec<f64>; 2]> = entries.iter().map(|_| Default::default()).collect();
    for (place, threads) in THREADS.into_iter().enumerate() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
        for _ in 0..repeats {
            for (entry, times) in entries.iter().zip(&mut times) {
                let mesh = course.own_mesh();
                let (built, time) = pool.install(|| {
                    let start = Instant::now();
                    let built = (entry.build)(mesh, threads);
                    (built, start.elapsed())
                });
                built?;
                times[place].push(time.as_secs_f64() * 1e3);
            }
        }
    }
    Ok(times)
}

fn trace(set: &Set, contestant: &dyn Contestant, threads: usize, memory: &mut Memory) {
    let count = set.rays.len();
    if set.is_any() {
        fill(&set.rays, &mut memory.found[..count], threads, |rays, found| {
            contestant.any(rays, found)
        });
    } else {
        fill(&set.rays, &mut memory.hits[..count], threads, |rays, hits| {
            contestant.closest(rays, hits)
        });
    }
}

fn judge(course: &Course, set: &Set, contestant: &dyn Contestant, memory: &mut Memory) -> Judgement {
    trace(set, contestant, rayon::current_num_threads(), memory);
    let count = set.rays.len();
    if set.is_any() {
        for ((hit, found), ray) in memory.hits.iter_mut().zip(&memory.found).zip(&set.rays) {
            *hit = if *found {
                Hit {
                    triangle: 0,
                    ..Hit::miss(0.0)
                }
            } else {
                Hit::miss(ray.t_max)
            };
        }
    }
    set.truth.judge(&course.oracle, &set.rays, &memory.hits[..count])
}

fn report(course: &Course, runner: Runner<'_>, builds: [Vec<f64>; 2]) -> ContestantReport {
    let bytes = runner.built.bytes();
    let sets = course.sets.iter().zip(runner.judgements).enumerate();
    ContestantReport {
        name: runner.entry.name,
        is_ours: runner.entry.is_ours,
        twin_of: None,
        build_milliseconds: builds.map(Spread::new).into(),
        bytes_per_triangle: bytes.map(|bytes| bytes as f64 / course.mesh.triangles.len() as f64),
        sets: sets
            .map(|(place, (set, judgement))| SetReport {
                set: set.kind.name(),
                rays: set.rays.len(),
                mrays_per_second: [0, 1]
                    .map(|threads| Spread::of_speeds(set.rays.len(), &runner.times[threads][place]))
                    .into(),
                judgement,
            })
            .collect(),
    }
}
