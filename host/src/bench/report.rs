//! What was measured, for programs.

use super::counting::Counts;
use super::judgement::Judgement;
use super::thesis::ThesisReport;
use crate::spread::Spread;
use oktant_shared::parts::Parts;
use serde::Serialize;

/// Everything that a run measured.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// Version of oktant.
    pub version: &'static str,
    /// Width and height of the pictures, pixels.
    pub size: [u32; 2],
    /// Measurements of each time.
    pub repeats: u32,
    /// Where rays were traced.
    pub devices: Vec<String>,
    /// Tests of rays and triangles up to which brute force takes part, of a set.
    pub brute_budget: u64,
    /// The thesis's pictures; none where they were not asked for.
    pub thesis: Option<ThesisReport>,
    /// All parts, mesh by mesh.
    pub meshes: Vec<SubjectReport>,
}

/// What was measured on a mesh.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SubjectReport {
    /// Its name.
    pub name: String,
    /// Its triangles.
    pub triangles: usize,
    /// The sets of rays.
    pub sets: Vec<TruthReport>,
    /// The combinations of parts that could be measured.
    pub combinations: Vec<CombinationReport>,
}

/// What is known of a set of rays.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TruthReport {
    /// R1 to R4.
    pub set: &'static str,
    /// Rays.
    pub rays: usize,
    /// How many of them hit something, by the oracle.
    pub hits: usize,
}

/// Names of parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct PartNames {
    /// The way through the scene.
    pub traversal: &'static str,
    /// The box test.
    #[serde(rename = "box")]
    pub box_test: &'static str,
    /// The triangle test.
    pub triangle: &'static str,
}

impl PartNames {
    /// Of a combination.
    pub fn of(parts: Parts) -> Self {
        PartNames {
            traversal: parts.traversal.description().name,
            box_test: parts.box_test.description().name,
            triangle: parts.triangle.description().name,
        }
    }
}

/// What was measured of a combination of parts.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CombinationReport {
    /// The parts.
    pub parts: PartNames,
    /// How the tree was built; none of structures that are built in one way only.
    pub build: Option<&'static str>,
    /// From vertices and indices to what can be traced, milliseconds.
    pub build_milliseconds: Spread,
    /// Bytes of the structure and of the triangles that it reads, by the mesh's triangles.
    pub bytes_per_triangle: f64,
    /// Set by set.
    pub sets: Vec<SetReport>,
}

/// What was measured of a combination on a set of rays.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SetReport {
    /// R1 to R4.
    pub set: &'static str,
    /// What all rays read together.
    pub counts: Counts,
    /// What a ray reads.
    pub nodes_per_ray: f64,
    /// What a ray tests.
    pub triangle_tests_per_ray: f64,
    /// Device by device, as far as they can do it.
    pub devices: Vec<SpeedReport>,
}

/// How fast, and how well, a device traced a set.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SpeedReport {
    /// Its name.
    pub device: String,
    /// What the oracle says of its hits.
    pub judgement: Judgement,
    /// Millions of rays a second.
    pub mrays_per_second: Spread,
    /// For all rays.
    pub milliseconds: Spread,
}
