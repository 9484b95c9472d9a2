//! How long something takes.

use std::time::{Duration, Instant};

/// Beyond this, once is enough.
const LONG: Duration = Duration::from_millis(100);

/// What comes of some work, and the shortest time that it took of three, or the only one where that is long.
pub fn quickest<T>(mut work: impl FnMut() -> T) -> (T, Duration) {
    let mut timed = || {
        let start = Instant::now();
        let result = work();
        (result, start.elapsed())
    };
    let (mut result, mut least) = timed();
    for _ in 0..2 {
        if least > LONG {
            break;
        }
        let (again, time) = timed();
        (result, least) = (again, least.min(time));
    }
    (result, least)
}
