//! Everyone on the same rays, in the device's memory.

use super::caster::{Caster, GpuRays, Uploaded};
use super::clock::{Clock, read};
use super::entries::{GpuEntry, structures};
use crate::contestant::Failure;
use crate::course::{Course, Set};
use crate::report::{ContestantReport, CourseReport, SetReport};
use oktant::backend::BackendError;
use oktant::backend::gpu::Gpu;
use oktant::bench::Judgement;
use oktant::spread::Spread;
use oktant_shared::hit::Hit;
use std::rc::Rc;
use std::time::{Duration, Instant};

/// Why nothing was measured.
#[derive(Debug, thiserror::Error)]
pub enum GpuRaceError {
    /// A structure could not be built.
    #[error(transparent)]
    Build(#[from] Failure),
    /// The device cannot do its work.
    #[error(transparent)]
    Backend(#[from] BackendError),
    /// The device has no clock.
    #[error("{0} has no timestamps; give --repeat 0, which only checks.")]
    Clock(String),
}

/// Dispatches between two timestamps, one after the other, as oktant's own measurements have them.
const AT_ONCE: u32 = 8;

/// A device that has been idle takes so long to reach its clock again.
const WARM_UP: Duration = Duration::from_millis(100);

/// A contestant in the race.
struct Runner {
    entry: GpuEntry,
    pipelines: [wgpu::ComputePipeline; 2],
    structure: Rc<Uploaded>,
    build_milliseconds: f64,
    bytes: usize,
    judgements: Vec<Judgement>,
    /// Milliseconds by set.
    times: Vec<Vec<f64>>,
}

/// Builds everyone whose name is wanted once, on all threads, checks them by the oracle and times their kernels by the
/// device's clock. Repetitions are the outer loop and contestants the inner one, whose order turns round each time.
///
/// # Errors
/// [`GpuRaceError`].
pub fn race(
    course: &Course,
    gpu: &Gpu,
    wanted: impl Fn(&GpuEntry) -> bool,
    repeats: usize,
) -> Result<CourseReport, GpuRaceError> {
    let caster = Caster::new(gpu);
    let rays: Vec<GpuRays> = course
        .sets
        .iter()
        .map(|set| caster.rays(&set.rays))
        .collect::<Result<_, _>>()?;
    let mut runners = Vec::new();
    for structure in structures() {
        let entries: Vec<GpuEntry> = structure.entries.into_iter().filter(&wanted).collect();
        if entries.is_empty() {
            continue;
        }
        let mesh = course.own_mesh();
        let start = Instant::now();
        let arrays = (structure.build)(mesh)?;
        let build_milliseconds = start.elapsed().as_secs_f64() * 1e3;
        let uploaded = Rc::new(caster.upload(&arrays)?);
        for entry in entries {
            let mut runner = Runner {
                pipelines: caster.pipelines(entry.kernel)?,
                entry,
                structure: uploaded.clone(),
                build_milliseconds,
                bytes: arrays.bytes(),
                judgements: Vec::new(),
                times: vec![Vec::new(); course.sets.len()],
            };
            for (set, rays) in course.sets.iter().zip(&rays) {
                runner.judgements.push(runner.judge(gpu, course, set, rays)?);
            }
            runners.push(runner);
        }
    }
    if repeats > 0 {
        let clock = Clock::new(gpu).ok_or_else(|| GpuRaceError::Clock(gpu.name.clone()))?;
        time(course, gpu, &clock, &rays, &mut runners, repeats)?;
    }
    let way = if gpu.passthrough {
        "passed through"
    } else {
        "through naga"
    };
    Ok(CourseReport {
        name: course.name.clone(),
        triangles: course.mesh.triangles.len(),
        conditions: vec![format!("{}, {way}", gpu.name)],
        contestants: runners.into_iter().map(|runner| runner.report(course)).collect(),
    })
}

fn time(
    course: &Course,
    gpu: &Gpu,
    clock: &Clock,
    rays: &[GpuRays],
    runners: &mut [Runner],
    repeats: usize,
) -> Result<(), BackendError> {
    let start = Instant::now();
    for repetition in 0..repeats {
        let mut order: Vec<usize> = (0..runners.len()).collect();
        if repetition % 2 == 1 {
            order.reverse();
        }
        for place in order {
            let runner = &mut runners[place];
            for (index, (set, rays)) in course.sets.iter().zip(rays).enumerate() {
                let once = || {
                    clock.time(gpu, |pass| {
                        rays.cast(pass, runner.pipeline(set), &runner.structure, AT_ONCE)
                    })
                };
                while start.elapsed() < WARM_UP {
                    once()?;
                }
                let time = once()? / f64::from(AT_ONCE);
                runner.times[index].push(time);
            }
        }
    }
    Ok(())
}

impl Runner {
    fn pipeline(&self, set: &Set) -> &wgpu::ComputePipeline {
        let [closest, any] = &self.pipelines;
        if set.is_any() { any } else { closest }
    }

    fn judge(&self, gpu: &Gpu, course: &Course, set: &Set, rays: &GpuRays) -> Result<Judgement, BackendError> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        // Whoever writes nothing is not to be taken for the one before.
        encoder.clear_buffer(rays.hits(), 0, None);
        rays.cast(
            &mut encoder.begin_compute_pass(&Default::default()),
            self.pipeline(set),
            &self.structure,
            1,
        );
        gpu.queue.submit([encoder.finish()]);
        let hits: Vec<Hit> = read(gpu, rays.hits())?;
        Ok(set.truth.judge(&course.oracle, &set.rays, &hits))
    }

    fn report(self, course: &Course) -> ContestantReport {
        let sets = course.sets.iter().zip(self.judgements).zip(self.times);
        ContestantReport {
            name: self.entry.name,
            is_ours: self.entry.is_ours,
            twin_of: self.entry.twin_of,
            build_milliseconds: vec![Spread::new(vec![self.build_milliseconds])],
            bytes_per_triangle: Some(self.bytes as f64 / course.mesh.triangles.len() as f64),
            sets: sets
                .map(|((set, judgement), times)| SetReport {
                    set: set.kind.name(),
                    rays: set.rays.len(),
                    mrays_per_second: vec![Spread::of_speeds(set.rays.len(), &times)],
                    judgement,
                })
                .collect(),
        }
    }
}
