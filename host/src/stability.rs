//! The stability lab: where methods fail, and that the default does not.
//!
//! A row is a failure mode: rays that some method has failed on, found in the literature, in other people's trackers and in
//! the thesis of 2011. What is offered runs on it, and exhibits beside it; the row names those that must fail, so that a
//! row whose rays are no longer hard is noticed.

mod aim;
mod box_cases;
mod boxes;
mod builds;
mod cases;
mod clock;
mod departures;
mod exhibits;
mod html;
mod invalid;
mod meshes;
mod method;
mod modes;
mod report;
mod shading;
mod subject;
mod surface_case;
mod table;
mod tally;
mod touches;

pub use html::page;
pub use report::{MethodReport, Report, Role, RowReport};
pub use table::table;
pub use tally::{Counts, Failure};

pub(crate) use aim::{Aim, at};
pub(crate) use exhibits::cell_grid::GridForm;
pub(crate) use exhibits::revelles::Form;
pub(crate) use exhibits::rounding::{Contracted, Kernel, Plain};
pub(crate) use exhibits::triangle_tests::{Epsilon, Exact, HavelHerout, MollerTrumbore, Slack, Woop};
pub(crate) use method::Method;
pub(crate) use subject::Wanted;

use crate::backend::{BackendError, Query};
use crate::bench::Device;
use crate::mesh::Mesh;
use crate::mesh_source::MeshError;
use crate::progress::Progress;
use crate::scene::SceneError;
use boxes::BOX_MODES;
use builds::BUILD_ROWS;
use cases::Row;
use clock::quickest;
use departures::{DEPARTURE_MODES, DepartureMode};
use invalid::INVALID_ROWS;
use modes::{Mode, TRAVERSALS, TRIANGLE_TESTS};
use oktant_shared::general::AnyTriangle;
use oktant_shared::parts::{Parts, TraversalKind};
use oktant_shared::scene::Scene as View;
use oktant_shared::triangle_test::TriangleTest;
use shading::SHADING_ROWS;
use std::time::Duration;
pub(crate) use subject::Subject;

/// What is to be run.
#[derive(Clone)]
pub struct Plan {
    /// Rays of each row, where there are not fewer.
    pub rays: usize,
    /// Rows by id; all where there are none.
    pub rows: Vec<String>,
    /// Where what is offered runs; exhibits, box tests and rays that leave a surface run on the CPU.
    pub devices: Vec<Device>,
}

/// Why the lab could not do its work.
#[derive(Debug, thiserror::Error)]
pub enum LabError {
    /// A mesh could not be had.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// Nothing could be built of it.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A device gave up.
    #[error(transparent)]
    Backend(#[from] BackendError),
}

/// Triangle tests that brute force may make in a row.
const BRUTE_BUDGET: usize = 1 << 30;

/// Ids of all rows.
pub fn row_ids() -> Vec<&'static str> {
    let modes = TRIANGLE_TESTS.iter().chain(TRAVERSALS).map(|mode| mode.id);
    modes
        .chain(BOX_MODES.iter().map(|mode| mode.id))
        .chain(DEPARTURE_MODES.iter().map(|mode| mode.id))
        .chain(rows().map(|row| row.id))
        .collect()
}

/// Those that have a way of their own to run.
fn rows() -> impl Iterator<Item = &'static Row> {
    INVALID_ROWS.iter().chain(SHADING_ROWS).chain(BUILD_ROWS)
}

/// Ids of the rows whose rays are traced at a mesh.
pub fn row_ids_with_mesh() -> Vec<&'static str> {
    let modes = TRIANGLE_TESTS.iter().chain(TRAVERSALS).map(|mode| mode.id);
    let modes = modes.chain(DEPARTURE_MODES.iter().map(|mode| mode.id));
    let rows = rows().filter(|row| row.mesh.is_some());
    modes.chain(rows.map(|row| row.id)).collect()
}

/// The mesh of a row; an empty one where it has none.
///
/// # Errors
/// [`MeshError`] where it cannot be had.
pub fn mesh_of_row(id: &str) -> Result<Mesh, MeshError> {
    if let Some(mode) = TRIANGLE_TESTS.iter().chain(TRAVERSALS).find(|mode| mode.id == id) {
        return (mode.mesh)();
    }
    if let Some(mesh) = rows().find(|row| row.id == id).and_then(|row| row.mesh) {
        return Ok(mesh());
    }
    let mode = DEPARTURE_MODES.iter().find(|mode| mode.id == id);
    Ok(mode.map(DepartureMode::mesh).unwrap_or_default())
}

/// Runs the rows.
///
/// # Errors
/// [`LabError`].
pub fn run(plan: &Plan, progress: Progress<'_>) -> Result<Report, LabError> {
    let is_wanted = |id: &str| plan.rows.is_empty() || plan.rows.iter().any(|row| row == id);
    let count = row_ids().into_iter().filter(|id| is_wanted(id)).count().max(1);
    let mut rows_run = Vec::new();
    for (family, modes) in [("triangle tests", TRIANGLE_TESTS), ("traversals", TRAVERSALS)] {
        for mode in modes.iter().filter(|mode| is_wanted(mode.id)) {
            rows_run.push(row(family, mode, plan)?);
            progress("testing", rows_run.len() as f32 / count as f32);
        }
    }
    for mode in BOX_MODES.iter().filter(|mode| is_wanted(mode.id)) {
        rows_run.push(mode.run(plan)?);
        progress("testing", rows_run.len() as f32 / count as f32);
    }
    for mode in DEPARTURE_MODES.iter().filter(|mode| is_wanted(mode.id)) {
        rows_run.push(mode.run(plan.rays)?);
        progress("testing", rows_run.len() as f32 / count as f32);
    }
    for row in rows().filter(|row| is_wanted(row.id)) {
        rows_run.push((row.run)(plan)?);
        progress("testing", rows_run.len() as f32 / count as f32);
    }
    Ok(Report {
        version: env!("CARGO_PKG_VERSION"),
        rays: plan.rays,
        devices: plan.devices.iter().map(Device::name).collect(),
        arithmetic: plan.devices.iter().filter_map(arithmetic).collect(),
        rows: rows_run,
    })
}

/// How a GPU rounds what the watertight test relies on.
fn arithmetic(device: &Device) -> Option<String> {
    let Device::Gpu(gpu) = device else {
        return None;
    };
    Some(format!("{}: {}", gpu.name, gpu.fused_multiply_add()))
}

/// What is offered on all devices, then the exhibits.
fn row(family: &'static str, mode: &Mode, plan: &Plan) -> Result<RowReport, LabError> {
    let mesh = (mode.mesh)()?;
    let rays = (mode.rays)(&mesh, plan.rays);
    let brute = mesh.triangles.len() * rays.len();
    let subject = Subject::new(mesh, rays, mode.wanted, TraversalKind::ALL)?;
    let mut methods = Vec::new();
    let mut base = None;
    for device in &plan.devices {
        let mut base_here = None;
        for parts in offered() {
            let tests = subject.mesh.triangles.len();
            if parts.traversal == TraversalKind::Brute && (brute > BRUTE_BUDGET || tests > device.most_brute()) {
                continue;
            }
            let Some(scene) = subject.scene(parts.traversal) else {
                continue;
            };
            let mut tracer = device.with(scene)?;
            let (hits, time) = quickest(|| tracer.cast(parts, Query::Closest, &subject.rays));
            let hits = hits?;
            let (mut counts, failures) = subject.judge(&hits);
            let failures = replayed(failures, mode.id, &format!(" {parts}"));
            if mode.counts_doubles && matches!(device, Device::Cpu) && parts.traversal == TraversalKind::Octants {
                // Any triangle test, chosen while it runs, so that a new one needs nothing here.
                let view = View {
                    parts: parts.number(),
                    ..scene.view()
                };
                counts.doubled = Some(subject.doubled_by(|ray| AnyTriangle::prepare_in(&view, ray)));
            }
            if matches!(device, Device::Cpu) {
                base.get_or_insert(time);
            }
            methods.push(MethodReport {
                name: name(parts),
                role: if parts == Parts::default() {
                    Role::Default
                } else {
                    Role::Offered
                },
                device: device.name(),
                counts,
                time_ratio: ratio(time, *base_here.get_or_insert(time), subject.rays.len()),
                failures,
            });
        }
    }
    for method in mode.exhibits {
        let Some((hits, time)) = method.closest_hits(&subject) else {
            continue;
        };
        let (mut counts, failures) = subject.judge(&hits);
        let failures = replayed(failures, mode.id, "");
        if mode.counts_doubles {
            counts.doubled = method.doubled(&subject);
        }
        methods.push(MethodReport {
            name: method.name().into(),
            role: if method.is_twin() { Role::Twin } else { Role::Exhibit },
            device: Device::Cpu.name(),
            counts,
            time_ratio: base.and_then(|base| ratio(time, base, subject.rays.len())),
            failures,
        });
    }
    Ok(RowReport {
        id: mode.id,
        family,
        title: mode.title,
        input: mode.input,
        remedy: mode.remedy,
        must_fail: mode.fails.into(),
        methods,
    })
}

/// With the commands that trace the rays again.
fn replayed(failures: Vec<Failure>, id: &str, options: &str) -> Vec<Failure> {
    let mesh = format!("lab:{id}");
    failures
        .into_iter()
        .map(|failure| failure.replayed(&mesh, options))
        .collect()
}

/// The default first.
fn offered() -> impl Iterator<Item = Parts> {
    let others = Parts::OFFERED
        .iter()
        .copied()
        .filter(|parts| *parts != Parts::default());
    std::iter::once(Parts::default()).chain(others)
}

fn name(parts: Parts) -> String {
    if parts.traversal.takes_box_test() {
        format!("{}, {}, {}", parts.traversal, parts.triangle, parts.box_test)
    } else {
        format!("{}, {}", parts.traversal, parts.triangle)
    }
}

/// Of few rays no time tells anything.
fn ratio(time: Duration, base: Duration, rays: usize) -> Option<f64> {
    (rays >= 1000).then(|| time.as_secs_f64() / base.as_secs_f64())
}
