//! `oktant cast`.

use super::Failure;
use super::arguments::{CastArguments, MeshArguments};
use super::engine::Engine;
use super::progress_bar::ProgressBar;
use super::render::counted;
use oktant::backend::Query;
use oktant::bench::PartNames;
use oktant::output::HitsFile;
use oktant::rays::RayFile;
use oktant::slots::Slots;
use oktant::spread::Spread;
use oktant_shared::hit::Hit;
use oktant_shared::parts::Parts;
use oktant_shared::ray::{PreparedRay, Ray};
use rayon::prelude::*;
use serde::Serialize;
use std::sync::Arc;
use std::time::Instant;

/// Rays that are traced at a time: 128 MiB of them, which every GPU binds at once and none works on for long.
const BATCH: usize = 1 << 22;

/// Traces the rays of a file, writes their hits and says how fast it went.
pub fn run(arguments: &CastArguments) -> Result<(), Failure> {
    let engine = arguments.engine.options()?;
    // First of all, so that nobody waits for hits of rays that cannot be read, or that cannot be stored.
    let output = arguments.output.as_deref().map(HitsFile::create).transpose()?;
    let file = RayFile::open(&arguments.rays)?;
    let query = match (arguments.any, arguments.closest) {
        (true, _) => Query::Any,
        (_, true) => Query::Closest,
        _ => file.query().unwrap_or(Query::Closest),
    };
    if file.count() == 0 && arguments.repeat.is_some() {
        return Err(Failure {
            sentence: format!(
                "{}: there are no rays to time; leave --repeat out, or give a file with some.",
                arguments.rays.display()
            ),
            code: 1,
        });
    }
    let mesh = MeshArguments {
        meshes: vec![arguments.mesh.clone()],
        structure: arguments.structure.clone(),
    };
    let loaded = mesh.load(&[])?;
    if loaded.scene.plane_count > 0 {
        return Err(Failure {
            sentence: format!(
                "{}: rays are cast at triangles only, and this scene has planes; use a [[quad]] in the place of each [[plane]].",
                arguments.mesh.display()
            ),
            code: 1,
        });
    }
    let scene = Arc::new(loaded.scene);
    let rays = {
        let bar = ProgressBar::new();
        file.read(loaded.shift, &|stage, fraction| bar.show(stage, fraction))?
    };
    warn_of_invalid(&rays);
    let mut engine = Engine::new(&engine, &scene)?;
    if let Some(output) = output {
        let start = Instant::now();
        let hits = cast(&mut engine, scene.parts, query, &rays)?;
        let seconds = start.elapsed().as_secs_f64();
        match query {
            Query::Closest => {
                let slots = Slots::of(&scene);
                output.save_closest(&hits, |id| {
                    let triangle = slots.triangle(&scene, id);
                    [triangle.a, triangle.b, triangle.c]
                })?;
            }
            Query::Any => output.save_any(&hits)?,
        }
        let found = hits.iter().filter(|hit| hit.is_hit()).count();
        eprintln!(
            "{}: {}, {}, {}, {}, {seconds:.3} s",
            arguments.output.as_deref().unwrap_or(&arguments.rays).display(),
            counted(rays.len(), "ray"),
            counted(found, "hit"),
            counted(loaded.triangles, "triangle"),
            engine.name(),
        );
    }
    if let Some(repeats) = arguments.repeat {
        let milliseconds = engine.time_cast(scene.parts, query, &rays, repeats)?;
        let report = Report::new(&engine, scene.parts, query, rays.len(), milliseconds);
        let json = serde_json::to_string(&report)?;
        super::print(&format!("{json}\n"))?;
    }
    Ok(())
}

/// Traces all rays, with progress on a terminal.
fn cast(engine: &mut Engine, parts: Parts, query: Query, rays: &[Ray]) -> Result<Vec<Hit>, Failure> {
    let bar = ProgressBar::new();
    let mut hits = Vec::with_capacity(rays.len());
    for batch in rays.chunks(BATCH) {
        hits.extend(engine.cast(parts, query, batch)?);
        bar.show("tracing", hits.len() as f32 / rays.len() as f32);
    }
    Ok(hits)
}

/// Says how many rays can hit nothing, whatever there is.
fn warn_of_invalid(rays: &[Ray]) {
    let invalid = rays.par_iter().filter(|ray| !PreparedRay::new(ray).valid).count();
    if invalid > 0 {
        tracing::warn!(
            "{} can hit nothing: a number is not finite, the direction is zero, or tmax is below tmin or zero",
            counted(invalid, "ray")
        );
    }
}

/// How fast rays were traced, for programs.
#[derive(Serialize)]
struct Report {
    rays: usize,
    query: &'static str,
    backend: String,
    parts: PartNames,
    mrays_per_second: Spread,
    milliseconds: Spread,
    repeats: usize,
}

impl Report {
    /// Of at least one time.
    fn new(engine: &Engine, parts: Parts, query: Query, rays: usize, milliseconds: Vec<f64>) -> Option<Self> {
        Some(Report {
            rays,
            query: match query {
                Query::Closest => "closest",
                Query::Any => "any",
            },
            backend: engine.name(),
            parts: PartNames::of(parts),
            mrays_per_second: Spread::of_speeds(rays, &milliseconds)?,
            repeats: milliseconds.len(),
            milliseconds: Spread::new(milliseconds)?,
        })
    }
}
