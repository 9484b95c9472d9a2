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

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::sync::atomic::{AtomicIsize, Ordering};
use std::sync::{LazyLock, Mutex, PoisonError};
use std::time::{Duration, Instant};

use oktant::mesh::Mesh;
use oktant::ply;
use oktant::progress::silent;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// The system's allocator, which counts what the threads of [`POOL`] allocate: nothing that other tests do meanwhile.
struct Counting;

static LIVE: AtomicIsize = AtomicIsize::new(0);
static PEAK: AtomicIsize = AtomicIsize::new(0);

thread_local! {
    static IS_COUNTED: Cell<bool> = const { Cell::new(false) };
}

// SAFETY: every call is passed on unchanged; counting allocates nothing.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if IS_COUNTED.get() {
            let size = layout.size() as isize;
            let live = LIVE.fetch_add(size, Ordering::Relaxed) + size;
            PEAK.fetch_max(live, Ordering::Relaxed);
        }
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        if IS_COUNTED.get() {
            LIVE.fetch_sub(layout.size() as isize, Ordering::Relaxed);
        }
        // SAFETY: the caller keeps the contract of `dealloc`.
        unsafe { System.dealloc(memory, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// The threads that load, one file at a time, though tests run in parallel.
static POOL: LazyLock<Mutex<ThreadPool>> = LazyLock::new(|| {
    let pool = ThreadPoolBuilder::new().num_threads(2);
    let pool = pool.start_handler(|_| IS_COUNTED.set(true));
    Mutex::new(pool.build().unwrap())
});

/// What every file in the world must stay below, if it is small.
const SMALL_FILE: Cost = Cost {
    time: Duration::from_secs(1),
    bytes: 256 << 20,
};

#[derive(Clone, Copy)]
struct Cost {
    time: Duration,
    /// Allocated at once.
    bytes: usize,
}

/// Loads a file, which must not cost more than allowed, and checks what holds for every mesh or every error.
fn load_within(file: &[u8], limit: Cost) -> Result<Mesh, String> {
    let pool = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    let before = LIVE.load(Ordering::Relaxed);
    PEAK.store(before, Ordering::Relaxed);
    let start = Instant::now();
    let result = pool.install(|| ply::parse(file, "some.ply", &silent));
    let time = start.elapsed();
    let bytes = PEAK.load(Ordering::Relaxed) - before;
    drop(pool);
    assert!(time <= limit.time, "took {time:?}");
    assert!(bytes <= limit.bytes as isize, "allocated {bytes} bytes");
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
    load_within(file, SMALL_FILE)
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
