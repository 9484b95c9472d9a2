//! The rays that the camera itself sends through pixels.

use crate::picture::Picture;
use oktant_shared::adaptive::samples_at;
use oktant_shared::frame::Frame;
use oktant_shared::render::looks;
use oktant_shared::sampling::Batch;

/// Counts them while a picture is rendered. The finished picture does not tell: adaptive sampling gives samples up for more,
/// and their rays are counted, too.
pub struct CameraRays<'a> {
    frame: &'a Frame,
    /// Of each pixel so far.
    pub counts: Vec<f32>,
    /// All closest-hit rays of each pixel so far.
    closest: Vec<f32>,
}

impl<'a> CameraRays<'a> {
    /// Before the first pass of the frame.
    pub fn new(frame: &'a Frame) -> Self {
        let pixels = (frame.size().x as usize) * frame.size().y as usize;
        CameraRays {
            frame,
            counts: vec![0.0; pixels],
            closest: vec![0.0; pixels],
        }
    }

    /// Adds those of a pass, after which the picture is this. A pixel whose rays are as many as before was not traced in it:
    /// each look through a pixel begins with a closest-hit ray.
    pub fn count(&mut self, picture: &Picture) {
        for (index, work) in picture.work.iter().enumerate() {
            if work.x == self.closest[index] {
                continue;
            }
            let batch = match picture.marks.get(index) {
                Some(mark) => samples_at(mark.level()),
                None => Batch::of_frame(self.frame),
            };
            self.counts[index] += looks(self.frame, &batch) as f32;
            self.closest[index] = work.x;
        }
    }
}
