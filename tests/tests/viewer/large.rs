//! A window that is given a large mesh goes on answering.
//!
//! `OKTANT_LIMIT=50` asks for all events to be answered within so many milliseconds, which only means something where nothing
//! else runs. Without it, that what was shown goes on moving until the mesh is there is all that must hold.

use super::SIZE;
use super::window::{Session, value_in};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;
use std::time::Duration;

/// Together with what a slow computer needs to load and build.
const PATIENCE: Duration = Duration::from_secs(240);

/// Writes a binary PLY file with hills of two triangles a square, so many squares along each side.
fn write_hills(path: &Path, side: u32) {
    let corners = side + 1;
    let mut file = BufWriter::new(File::create(path).expect("the folder can be written"));
    let mut write = |bytes: &[u8]| file.write_all(bytes).expect("the disk has room");
    let header = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n\
        element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        corners * corners,
        2 * side * side
    );
    write(header.as_bytes());
    for j in 0..corners {
        for i in 0..corners {
            let [x, z] = [i, j].map(|step| step as f32 / side as f32);
            for coordinate in [x, 0.05 * ((20.0 * x).sin() + (30.0 * z).cos()), z] {
                write(&coordinate.to_le_bytes());
            }
        }
    }
    for j in 0..side {
        for i in 0..side {
            let first = j * corners + i;
            for triangle in [[0, corners, 1], [1, corners, corners + 1]] {
                write(&[3]);
                for corner in triangle {
                    write(&(first + corner).to_le_bytes());
                }
            }
        }
    }
}

fn events_are_answered_while_hills_are_loaded(side: u32) {
    let limit = std::env::var("OKTANT_LIMIT").ok();
    let limit: Option<f64> = limit.map(|limit| limit.parse().expect("OKTANT_LIMIT is a number of milliseconds"));
    let session = Session::new();
    write_hills(&session.folder().join("hills.ply"), side);
    let drags = "drag left 20 5\nprint\n".repeat(30);
    let triangles = 2 * side * side;
    let script = format!(
        "wait settled
        print
        open hills.ply
        {drags}wait settled
        expect triangles {triangles}
        print"
    );
    let report = session
        .start(&["--backend", "cpu", "--size", SIZE], &script)
        .finish_within(PATIENCE);
    let printed: Vec<&str> = report.standard_output.split("backend ").skip(1).collect();
    let is_loading = |text: &&&str| value_in(text, "triangles") == "69451";
    let loading = printed[1..].iter().take_while(is_loading).count();
    assert!(loading > 0, "it was there before anything was dragged: {report}");
    let (meanwhile, then) = printed[1..].split_at(loading);
    for (what, texts) in [("while it is read and built", meanwhile), ("until it is shown", then)] {
        let answered = |text: &&str| -> f64 {
            let value = value_in(text, "answered-within-milliseconds");
            value.parse().expect("a number")
        };
        let answered = texts.iter().map(answered).fold(0.0, f64::max);
        println!("{triangles} triangles, {what}: answered within {answered:.1} ms");
        if let Some(limit) = limit {
            assert!(answered < limit, "{what}: {answered} ms");
        }
    }
    let frames = |text| -> u64 { value_in(text, "frames").parse().expect("a number") };
    let [before, after] = [frames(printed[0]), frames(meanwhile[loading - 1])];
    assert!(
        after > before + 3,
        "what was shown goes on turning: {before} frames, then {after}"
    );
}

#[test]
#[ignore = "needs a display"]
fn events_are_answered_while_millions_of_triangles_are_loaded() {
    events_are_answered_while_hills_are_loaded(1323);
}

#[test]
#[ignore = "needs a display and 4 GB of memory"]
fn events_are_answered_while_ten_million_triangles_are_loaded() {
    events_are_answered_while_hills_are_loaded(2237);
}
