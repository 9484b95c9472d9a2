//! Meshes that structures grow on without end, or lose triangles of.

use super::LabError;
use super::cases::{About, Row};
use super::exhibits::structures::cells_of;
use super::meshes::of_corners;
use super::report::{MethodReport, Role, RowReport};
use super::tally::{Counts, Failure};
use super::touches;
use crate::mesh::Mesh;
use crate::mesh_source::MeshSource;
use crate::octree::has_area;
use crate::ply;
use crate::progress::silent;
use crate::scene::Scene;
use crate::structure::StructureOptions;
use glam::{DVec3, Vec3};
use oktant_shared::parts::{Parts, TraversalKind};
use std::fmt::Write;
use std::time::{Duration, Instant};

/// References beyond so many a triangle are too many.
const MOST_REFERENCES: usize = 16;

/// A build of a mesh of this size takes no longer.
const LONGEST: Duration = Duration::from_secs(1);

/// What the rows are about.
pub const FAMILY: &str = "builds";

/// All of them.
pub const BUILD_ROWS: &[Row] = &[
    Row {
        id: "build-fan",
        mesh: None,
        run: |_| {
            let about = About {
                id: "build-fan",
                family: FAMILY,
                title: "a corner that no cell separates",
                input: "64 triangles round (0.1, 0.2, 0.3). Excess: references beyond 16 a triangle, and 1 where the build \
                        takes more than a second",
                remedy: "a cell is split only where that pays, and within a budget",
                fails: &["octree to depth 20"],
            };
            grown(&about, &fan(), &[("octree to depth 20", 20)])
        },
    },
    Row {
        id: "build-coincident",
        mesh: None,
        run: |_| {
            let about = About {
                id: "build-coincident",
                family: FAMILY,
                title: "triangles in the same place",
                input: "1,000 times (0.1, 0.2, 0.3) (0.8, 0.3, 0.4) (0.3, 0.9, 0.6). Excess: as before",
                remedy: "of triangles with the same corners the first is kept",
                fails: &["octree to depth 6", "octree to depth 8"],
            };
            let mesh = of_corners(&[[[0.1, 0.2, 0.3], [0.8, 0.3, 0.4], [0.3, 0.9, 0.6]]; 1000]);
            grown(&about, &mesh, &[("octree to depth 6", 6), ("octree to depth 8", 8)])
        },
    },
    Row {
        id: "build-plane",
        mesh: None,
        run: |_| {
            let about = About {
                id: "build-plane",
                family: FAMILY,
                title: "a mesh in the plane between two cells",
                input: "the square from -1 to 1 at z = 0, cut in 32 x 32. Excess: as before",
                remedy: "the root's edge is an odd number of units, so its planes are seldom those of meshes",
                fails: &["octree to depth 6"],
            };
            grown(&about, &board(32), &[("octree to depth 6", 6)])
        },
    },
    Row {
        id: "build-utm",
        mesh: None,
        run: |_| utm(),
    },
    Row {
        id: "build-nan",
        mesh: None,
        run: |_| nan(),
    },
    Row {
        id: "build-rounding",
        mesh: None,
        run: |plan| Ok(touches::rounding(plan.rays)),
    },
];

/// What structures take for a mesh, and an octree that is split until a depth.
fn grown(about: &About, mesh: &Mesh, exhibits: &[(&str, u32)]) -> Result<RowReport, LabError> {
    let most = MOST_REFERENCES * mesh.triangles.len();
    let mut methods = Vec::new();
    for traversal in [
        TraversalKind::Octants,
        TraversalKind::Octree,
        TraversalKind::Bvh2,
        TraversalKind::Grid,
    ] {
        let parts = Parts {
            traversal,
            ..Parts::default()
        };
        let options = StructureOptions {
            parts,
            ..StructureOptions::default()
        };
        let timed = || -> Result<(Scene, Duration), LabError> {
            let start = Instant::now();
            let scene = Scene::new(mesh, &options, &silent)?;
            Ok((scene, start.elapsed()))
        };
        // Whoever else works on the machine may hold up one of them.
        let (scene, mut least) = timed()?;
        for _ in 0..2 {
            least = least.min(timed()?.1);
        }
        let role = if parts == Parts::default() {
            Role::Default
        } else {
            Role::Offered
        };
        let excess = scene.references.len().saturating_sub(most) + usize::from(least > LONGEST);
        methods.push(method(traversal.description().name, role, mesh.triangles.len(), excess));
    }
    for (name, depth) in exhibits {
        let references = cells_of(mesh, *depth, 1 << 26);
        let excess = references.saturating_sub(most);
        methods.push(method(name, Role::Exhibit, mesh.triangles.len(), excess));
    }
    Ok(about.report(methods))
}

fn method(name: &str, role: Role, triangles: usize, excess: usize) -> MethodReport {
    MethodReport {
        name: name.into(),
        role,
        device: "CPU".into(),
        counts: Counts {
            rays: triangles,
            excess,
            ..Counts::default()
        },
        time_ratio: None,
        failures: if excess > 0 {
            vec![Failure {
                kind: "excess",
                ..Failure::default()
            }]
        } else {
            Vec::new()
        },
    }
}

/// Triangles round a corner.
fn fan() -> Mesh {
    let hub = Vec3::new(0.1, 0.2, 0.3);
    let rim = |at: usize| {
        let (sin, cos) = (std::f32::consts::TAU * at as f32 / 64.0).sin_cos();
        (hub + Vec3::new(cos, sin, 0.3 * (3.0 * cos).sin())).to_array()
    };
    let triangle = |at: usize| [hub.to_array(), rim(at), rim((at + 1) % 64)];
    of_corners(&(0..64).map(triangle).collect::<Vec<_>>())
}

/// A square at z = 0.
fn board(squares: u32) -> Mesh {
    let along = |i: u32| 2.0 * i as f32 / squares as f32 - 1.0;
    let corner = |i, j| [along(i), along(j), 0.0];
    let square = |at: u32| {
        let (i, j) = (at % squares, at / squares);
        let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    of_corners(&(0..squares * squares).flat_map(square).collect::<Vec<_>>())
}

/// Triangles that lose their area far from the origin of coordinates.
fn utm() -> Result<RowReport, LabError> {
    let about = About {
        id: "build-utm",
        family: FAMILY,
        title: "coordinates of a map",
        input: "the Stanford bunny 4,500 km away, as a PLY file of doubles. Missed: triangles that lose their area; excess: as \
                before",
        remedy: "the middle is subtracted in f64 before coordinates become f32",
        fails: &["coordinates made f32"],
    };
    const AWAY: DVec3 = DVec3::new(4.5e6, 5e5, 4.5e6);
    let bunny = MeshSource::Bunny.load(&silent)?;
    let mut text = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\nelement face \
         {}\nproperty list uchar int vertex_indices\nend_header\n",
        bunny.positions.len(),
        bunny.triangles.len()
    );
    for position in &bunny.positions {
        let [x, y, z] = (position.as_dvec3() + AWAY).to_array();
        let _ = writeln!(text, "{x} {y} {z}");
    }
    for [a, b, c] in &bunny.triangles {
        let _ = writeln!(text, "3 {a} {b} {c}");
    }
    let loaded =
        ply::parse(text.as_bytes(), "the bunny far away", &silent).map_err(crate::mesh_source::MeshError::from)?;
    let mut report = grown(&about, &loaded, &[])?;
    report.methods[0].counts.missed = flat(&loaded).saturating_sub(flat(&bunny));
    let rounded = Mesh {
        positions: bunny
            .positions
            .iter()
            .map(|position| (position.as_dvec3() + AWAY).as_vec3())
            .collect(),
        ..bunny.clone()
    };
    let mut exhibit = method("coordinates made f32", Role::Exhibit, bunny.triangles.len(), 0);
    exhibit.counts.missed = flat(&rounded).saturating_sub(flat(&bunny));
    exhibit.failures.push(Failure {
        kind: "missed",
        ..Failure::default()
    });
    report.methods.push(exhibit);
    Ok(report)
}

/// Triangles without area.
fn flat(mesh: &Mesh) -> usize {
    let has_no_area = |triangle: &&[u32; 3]| !has_area(&triangle.map(|vertex| mesh.positions[vertex as usize]));
    mesh.triangles.iter().filter(has_no_area).count()
}

/// A vertex that is no place.
fn nan() -> Result<RowReport, LabError> {
    let about = About {
        id: "build-nan",
        family: FAMILY,
        title: "vertices that are not numbers",
        input: "64 triangles round a corner, all corners of 8 of them NaN. Excess: references beyond 16 a triangle, where the mesh is not refused",
        remedy: "readers refuse such files, and so does the build",
        fails: &["octree to depth 6, NaN let in"],
    };
    let mut mesh = fan();
    mesh.positions[..24].fill(Vec3::NAN);
    let most = MOST_REFERENCES * mesh.triangles.len();
    let built = Scene::new(&mesh, &StructureOptions::default(), &silent);
    let is_let_in = usize::from(built.is_ok());
    let references = cells_of(&mesh, 6, 1 << 26);
    Ok(about.report(vec![
        method("refused", Role::Default, mesh.triangles.len(), is_let_in),
        method(
            "octree to depth 6, NaN let in",
            Role::Exhibit,
            mesh.triangles.len(),
            references.saturating_sub(most),
        ),
    ]))
}
