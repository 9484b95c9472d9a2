//! The PLY loader: every variant of the format gives the right triangles, every broken file one clear sentence.

#![expect(clippy::unwrap_used, reason = "a panic is how a test fails, in its helpers too")]

mod coordinates;
mod corpus;
mod encodings;
mod files;
mod header;
mod mutations;
mod normals;
mod polygons;
mod shift;
mod size;

use oktant::mesh::Mesh;
use oktant::ply;
use oktant::progress::silent;
use oktant_tests::cost::{Cost, Counting};

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Loads a file, which must not cost more than allowed, and checks what holds for every mesh or every error.
fn load_within(file: &[u8], limit: Cost) -> Result<Mesh, String> {
    let result = limit.within(|| ply::parse(file, "some.ply", &silent));
    match result {
        Ok(mesh) => {
            check_mesh(&mesh);
            Ok(mesh)
        }
        Err(error) => {
            let sentence = error.to_string();
            check_sentence(&sentence);
            Err(sentence)
        }
    }
}

fn load(file: &[u8]) -> Result<Mesh, String> {
    load_within(file, Cost::SMALL_FILE)
}

fn check_mesh(mesh: &Mesh) {
    let count = mesh.positions.len();
    assert!(!mesh.triangles.is_empty());
    assert!(mesh.positions.iter().all(|position| position.is_finite()));
    assert!(mesh.shift.is_finite());
    assert!(
        mesh.triangles
            .as_flattened()
            .iter()
            .all(|&corner| (corner as usize) < count)
    );
    assert!(mesh.colors.is_empty() || mesh.colors.len() == count);
    assert!(mesh.normals.is_empty() || mesh.normals.len() == count);
    assert!(mesh.coordinates.is_empty() || mesh.coordinates.len() == count);
    assert!(mesh.coordinates.iter().all(|coordinate| coordinate.is_finite()));
    for normal in &mesh.normals {
        let length = normal.length();
        assert!(length == 0.0 || (length - 1.0).abs() < 1e-5, "{normal}");
    }
}

fn check_sentence(sentence: &str) {
    assert!(sentence.starts_with("some.ply: "), "{sentence}");
    assert!(!sentence.contains(char::is_control), "{sentence:?}");
    assert!(sentence.len() < 400, "{sentence}");
    // What is wrong; what to do.
    assert!(sentence.contains("; ") || sentence.contains(", "), "{sentence}");
    assert!(!sentence.ends_with(['.', ' ', ';']), "{sentence}");
}

/// The error of a file that must not load, which must contain all these words.
#[track_caller]
fn assert_refused(file: &[u8], words: &[&str]) {
    match load(file) {
        Ok(mesh) => panic!("loaded {:?}", mesh.triangles),
        Err(sentence) => {
            for word in words {
                assert!(sentence.contains(word), "{word:?} is not in {sentence:?}");
            }
        }
    }
}

/// An ascii file with this header after the format line, and this body.
fn ascii(header: &str, body: &str) -> Vec<u8> {
    format!("ply\nformat ascii 1.0\n{header}end_header\n{body}").into_bytes()
}

/// A header for so many vertices of three floats and so many faces.
fn plain(vertices: usize, faces: usize) -> String {
    format!(
        "element vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {faces}\nproperty list uchar int vertex_indices\n"
    )
}

/// The usual three vertices, in ascii.
const CORNER: &str = "0 0 0\n1 0 0\n0 1 0\n";

/// Deterministic numbers (splitmix64: Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// 0 to `end`, exclusive.
    fn below(&mut self, end: usize) -> usize {
        (self.next() % end as u64) as usize
    }

    /// 0 to 1.
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }
}
