//! What is to be measured, and why it could not be.

use super::figure::Figure;
use super::origin::Origin;
use crate::backend::BackendError;
use crate::bench::{Device, MeasureError as BenchError};
use crate::compare::CompareError;
use crate::mesh_source::{MeshError, MeshSource};
use crate::scene::SceneError;
use crate::source::{Source, SourceError};
use glam::UVec2;

/// What is to be measured.
#[derive(Clone)]
pub struct Plan {
    /// Meshes, where a chart is of meshes; at least one.
    pub meshes: Vec<MeshSource>,
    /// Meshes and scenes, where a chart is of pictures; at least one.
    pub sources: Vec<Source>,
    /// Size of these pictures, pixels.
    pub pictures: UVec2,
    /// Where what is offered runs.
    pub devices: Vec<Device>,
    /// Size of the pictures whose rays are traced, pixels.
    pub size: UVec2,
    /// Rays that are aimed where methods fail.
    pub rays: usize,
    /// Measurements of each time, at least one, of which the quickest counts: whatever else runs on the machine only makes
    /// some of them longer.
    pub repeats: u32,
    /// Triangles of the largest mesh of [`growth`](super::growth).
    pub largest: u32,
    /// What makes the charts again.
    pub command: String,
}

/// Why nothing could be measured.
#[derive(Debug, thiserror::Error)]
pub enum MeasureError {
    /// A mesh could not be had.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// Something to measure on could not be had.
    #[error(transparent)]
    Source(#[from] SourceError),
    /// Nothing could be built of it.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A device gave up.
    #[error(transparent)]
    Backend(#[from] BackendError),
    /// One of both.
    #[error(transparent)]
    Bench(#[from] BenchError),
    /// Pictures could not be compared.
    #[error(transparent)]
    Compare(#[from] Box<CompareError>),
}

impl Plan {
    /// This program on this machine.
    pub(super) fn origin(&self) -> Origin {
        let adapters = self.devices.iter().filter(|device| matches!(device, Device::Gpu(_)));
        Origin::here(
            &adapters.map(Device::name).collect::<Vec<String>>(),
            self.command.clone(),
        )
    }

    /// A figure without panels and records.
    pub(super) fn figure(&self, stem: impl Into<String>, title: &str, explanation: &str) -> Figure {
        Figure {
            stem: stem.into(),
            title: title.into(),
            explanation: explanation.into(),
            panels: Vec::new(),
            records: Vec::new(),
            origin: self.origin(),
        }
    }
}

/// A device in a few letters, for legends.
pub(super) fn short_name(device: &Device) -> String {
    match device {
        Device::Cpu => "CPU".into(),
        Device::Gpu(gpu) => gpu.name.split(" (").next().unwrap_or(&gpu.name).into(),
    }
}

/// A mesh in a few letters: the name of its file without folder and ending.
pub(super) fn mesh_name(mesh: &str) -> &str {
    let path = std::path::Path::new(mesh);
    path.file_stem().and_then(|stem| stem.to_str()).unwrap_or(mesh)
}

/// What the files of a chart of a mesh or scene are called: `mesh_name` with a `-` for all but ASCII's letters and digits.
pub fn chart_name(source: &str) -> String {
    let in_files = |one: char| if one.is_ascii_alphanumeric() { one } else { '-' };
    mesh_name(source).chars().map(in_files).collect()
}

/// The shortest of some times.
pub(super) fn quickest(times: &[f64]) -> f64 {
    times.iter().copied().fold(f64::INFINITY, f64::min)
}
