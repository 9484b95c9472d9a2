//! What reading a file costs: time, and memory that is allocated at once.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::sync::atomic::{AtomicIsize, Ordering};
use std::sync::{LazyLock, Mutex, PoisonError};
use std::time::{Duration, Instant};

use rayon::{ThreadPool, ThreadPoolBuilder};

/// The system's allocator, which counts what the threads of [`Cost::of`] allocate: nothing that other tests do meanwhile. A
/// test that measures makes it the global one.
pub struct Counting;

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

/// The threads that are measured, one task at a time, though tests run in parallel.
static POOL: LazyLock<Mutex<ThreadPool>> = LazyLock::new(|| {
    let pool = ThreadPoolBuilder::new().num_threads(2);
    let pool = pool.start_handler(|_| IS_COUNTED.set(true));
    Mutex::new(pool.build().expect("two threads can be started"))
});

/// Time, and memory allocated at once.
#[derive(Clone, Copy, Debug)]
pub struct Cost {
    /// From start to end.
    pub time: Duration,
    /// Bytes.
    pub bytes: usize,
}

impl Cost {
    /// What every file in the world must stay below, if it is small.
    pub const SMALL_FILE: Cost = Cost {
        time: Duration::from_secs(1),
        bytes: 256 << 20,
    };

    /// What a task gives, and what it costs.
    pub fn of<T: Send>(task: impl FnOnce() -> T + Send) -> (T, Cost) {
        let pool = POOL.lock().unwrap_or_else(PoisonError::into_inner);
        let before = LIVE.load(Ordering::Relaxed);
        PEAK.store(before, Ordering::Relaxed);
        let start = Instant::now();
        let result = pool.install(task);
        let time = start.elapsed();
        let bytes = PEAK.load(Ordering::Relaxed) - before;
        (
            result,
            Cost {
                time,
                bytes: bytes.max(0) as usize,
            },
        )
    }

    /// What a task gives, which must not cost more than this.
    ///
    /// # Panics
    /// Where it does.
    pub fn within<T: Send>(self, task: impl FnOnce() -> T + Send) -> T {
        let (result, cost) = Cost::of(task);
        assert!(cost.time <= self.time, "took {:?}", cost.time);
        assert!(cost.bytes <= self.bytes, "allocated {} bytes", cost.bytes);
        result
    }
}
