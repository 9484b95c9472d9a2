//! A window that is given a large mesh goes on answering.

use super::SIZE;
use super::window::{Session, run, value_in};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

/// Squares along each side of the mesh: 3.5 million triangles.
const SIDE: u32 = 1323;
/// Milliseconds within which everything is to be answered.
const ANSWERED: f64 = 50.0;

/// Writes a binary PLY file with hills of two triangles a square.
fn write_hills(path: &Path) {
    let corners = SIDE + 1;
    let mut file = BufWriter::new(File::create(path).expect("the folder can be written"));
    let mut write = |bytes: &[u8]| file.write_all(bytes).expect("the disk has room");
    let header = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n\
        element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        corners * corners,
        2 * SIDE * SIDE
    );
    write(header.as_bytes());
    for j in 0..corners {
        for i in 0..corners {
            let [x, z] = [i, j].map(|step| step as f32 / SIDE as f32);
            for coordinate in [x, 0.05 * ((20.0 * x).sin() + (30.0 * z).cos()), z] {
                write(&coordinate.to_le_bytes());
            }
        }
    }
    for j in 0..SIDE {
        for i in 0..SIDE {
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

#[test]
#[ignore = "needs a display"]
fn events_are_answered_while_a_large_mesh_is_loaded() {
    let session = Session::new();
    write_hills(&session.folder().join("hills.ply"));
    let drags = "drag left 20 5\n".repeat(6);
    let script = format!(
        "wait settled
        print
        open hills.ply
        {drags}
        expect triangles 69451
        print
        wait settled
        expect triangles {}
        print",
        2 * SIDE * SIDE
    );
    let report = run(&session, &["--backend", "cpu", "--size", SIZE], &script);
    let printed: Vec<&str> = report.standard_output.split("backend ").skip(1).collect();
    for (what, text) in ["while it is read and built", "until it is shown"]
        .iter()
        .zip(&printed[1..])
    {
        let answered: f64 = value_in(text, "answered-within-milliseconds")
            .parse()
            .expect("a number");
        println!("{what}: answered within {answered:.1} ms");
        assert!(answered < ANSWERED, "{what}: {answered} ms");
    }
    let frames: u64 = value_in(printed[1], "frames").parse().expect("a number");
    let before: u64 = value_in(printed[0], "frames").parse().expect("a number");
    assert!(
        frames > before + 3,
        "what was shown goes on turning: {before} frames, then {frames}"
    );
}
