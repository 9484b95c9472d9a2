//! The table of the thesis that oktant grew out of.

use super::parts_bench::MeasureError;
use super::tracer::Device;
use crate::mesh_source::MeshSource;
use crate::model::Model;
use crate::progress::silent;
use crate::sampling::Samples;
use crate::scene::Scene;
use crate::source::SourceError;
use crate::spread::Spread;
use crate::structure::StructureOptions;
use crate::view::{Shading, View};
use glam::UVec2;
use serde::Serialize;
use std::sync::Arc;

/// Triangles of the bunny in the thesis; ours, the one of the Stanford repository, has 69,451.
pub const THESIS_BUNNY: usize = 69_666;

/// Frames a second in "Raytracing with CUDA technology" (VSB-TU Ostrava, 2011), in the order of [`STYLES`].
const FRAMES: [(MeshSource, [f64; 4]); 2] = [
    (MeshSource::Bunny, [0.94, 0.93, 0.28, 0.26]),
    (MeshSource::Balls, [1.85, 1.54, 0.58, 0.58]),
];

/// Its columns: what it calls Phong are interpolated normals.
const STYLES: [(&str, Shading, Samples); 4] = [
    ("plain", Shading::Flat, Samples::One),
    ("Phong", Shading::Phong, Samples::One),
    ("4xAA", Shading::Flat, Samples::Four),
    ("Phong, 4xAA", Shading::Phong, Samples::Four),
];

/// The table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ThesisReport {
    /// Triangles of the thesis's bunny.
    pub bunny_triangles_of_the_thesis: usize,
    /// Mesh by mesh, style by style, device by device.
    pub rows: Vec<ThesisRow>,
}

/// A picture: the kernel's time of a frame with one light, a shadow ray a sample and no secondary rays.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ThesisRow {
    /// The mesh.
    pub mesh: String,
    /// Its triangles.
    pub triangles: usize,
    /// Which column of the thesis.
    pub style: &'static str,
    /// Frames a second in the thesis.
    pub thesis: f64,
    /// Who rendered.
    pub device: String,
    /// A frame.
    pub milliseconds: Spread,
    /// Of the median.
    pub frames_per_second: f64,
    /// Of these to the thesis's.
    pub gain: f64,
}

/// Measures the thesis's pictures with the parts that oktant renders with, in the default view.
///
/// # Errors
/// Where a device gives up or is too small for the picture.
pub fn thesis(devices: &[Device], size: UVec2, repeats: u32) -> Result<ThesisReport, ThesisError> {
    let mut rows = Vec::new();
    for (source, frames) in FRAMES {
        let mesh = source.load(&silent).map_err(SourceError::from)?;
        let triangles = mesh.triangles.len();
        let model = Model::of_mesh(mesh);
        let scene = Scene::of_model(model, &StructureOptions::default(), &silent).map_err(MeasureError::from)?;
        let scene = Arc::new(scene);
        for device in devices {
            let mut tracer = device.with(&scene).map_err(MeasureError::from)?;
            for ((style, shading, samples), thesis) in STYLES.into_iter().zip(frames) {
                let view = View {
                    shading,
                    samples,
                    ..View::default()
                };
                let frame = view.frame(&scene, size.x, size.y);
                let times = tracer.time_render(&frame, repeats).map_err(MeasureError::from)?;
                let milliseconds = Spread::new(times).expect("there is a time");
                let frames_per_second = 1e3 / milliseconds.median;
                rows.push(ThesisRow {
                    mesh: source.to_string(),
                    triangles,
                    style,
                    thesis,
                    device: device.name(),
                    milliseconds,
                    frames_per_second,
                    gain: frames_per_second / thesis,
                });
            }
        }
    }
    Ok(ThesisReport {
        bunny_triangles_of_the_thesis: THESIS_BUNNY,
        rows,
    })
}

/// Why the table could not be measured.
#[derive(Debug, thiserror::Error)]
pub enum ThesisError {
    /// A built-in mesh cannot be had.
    #[error(transparent)]
    Source(#[from] SourceError),
    /// As for the parts.
    #[error(transparent)]
    Measure(#[from] MeasureError),
}
