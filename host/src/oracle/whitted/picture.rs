//! Whole pictures in f64.

use super::{FirstHit, Sitting};
use crate::picture::Picture;
use crate::progress::Progress;
use crate::seen::Seen;
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

impl Sitting<'_> {
    /// All pixels, on all of rayon's threads; `None` if `cancel` was raised meanwhile.
    pub fn render(&self, cancel: &AtomicBool, progress: Progress<'_>) -> Option<Picture> {
        let [width, height] = self.size();
        let mut picture = Picture::unwritten(width, height);
        let done = AtomicU32::new(0);
        let sums = picture.sums.par_chunks_mut(width as usize);
        let rows = sums.zip(picture.work.par_chunks_mut(width as usize)).enumerate();
        rows.for_each(|(y, (sums, work))| {
            let pixels = sums.par_iter_mut().zip(work).enumerate();
            pixels.for_each(|(x, (sum, work))| {
                if !cancel.load(Ordering::Relaxed) {
                    (*sum, *work) = self.pixel([x as u32, y as u32]);
                }
            });
            let finished = done.fetch_add(1, Ordering::Relaxed) + 1;
            progress("rendering", finished as f32 / height as f32);
        });
        (!cancel.load(Ordering::Relaxed)).then_some(picture)
    }

    /// What is seen first through the middle of each pixel.
    pub fn seen(&self) -> Seen {
        let [width, height] = self.size();
        let pixels = (0..width as usize * height as usize).into_par_iter();
        let (hits, normals) = pixels
            .map(|index| {
                let pixel = [index as u32 % width, index as u32 / width];
                let FirstHit { hit, normal, .. } = self.first_hit(pixel);
                (hit, normal.as_vec3())
            })
            .unzip();
        Seen { width, hits, normals }
    }
}
