//! The one way in which everyone's rays are shared among threads.

use std::sync::{Mutex, PoisonError};

/// Rays that a thread takes at a time.
const CHUNK: usize = 4096;

/// Calls `work` with the rays of each chunk and the place for what comes of them, on so many threads. With one, none is
/// started.
pub fn fill<R: Sync, T: Send>(rays: &[R], out: &mut [T], threads: usize, work: impl Fn(&[R], &mut [T]) + Sync) {
    let queue = Mutex::new(rays.chunks(CHUNK).zip(out.chunks_mut(CHUNK)));
    let run = || {
        loop {
            let next = queue.lock().unwrap_or_else(PoisonError::into_inner).next();
            let Some((rays, out)) = next else { break };
            work(rays, out);
        }
    };
    if threads <= 1 {
        run();
    } else {
        std::thread::scope(|scope| {
            for _ in 0..threads {
                scope.spawn(run);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_ray_once() {
        let rays: Vec<u32> = (0..10_001).collect();
        for threads in [1, 3] {
            let mut out = vec![0; rays.len()];
            fill(&rays, &mut out, threads, |rays, out| {
                for (ray, out) in rays.iter().zip(out) {
                    *out += ray + 1;
                }
            });
            assert!(out.iter().zip(&rays).all(|(out, ray)| *out == ray + 1), "{threads}");
        }
    }
}
