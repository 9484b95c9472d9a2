//! The passes that the samples of a picture are taken in.

use crate::adaptive;
use oktant_shared::frame::Frame;
use oktant_shared::sampling::R2;
use oktant_shared::stereo::EyeView;

/// The samples that any frame gets in the end, or at most.
pub fn wanted(frame: &Frame) -> u32 {
    frame.sample_count.max(frame.most_samples)
}

/// The passes of a frame that is sampled adaptively, those with several samples of a pixel in one; else one pass for each
/// sample, the first of them first, in an order in which a few are spread over the pixel already, so
/// that the picture can be shown while it is refined. After an even number of them their mean is the middle of the pixel,
/// so that the picture does not move; the sequence R2, whose order is good as it is, comes near to that.
pub fn passes(frame: &Frame, adaptively: u32) -> Vec<Frame> {
    if frame.most_samples != 0 {
        return adaptive::passes(frame, adaptively);
    }
    let pass = |i| Frame {
        first_sample: if frame.pattern == R2 {
            i
        } else {
            scattered(i, frame.sample_count)
        },
        sample_count: 1,
        ..*frame
    };
    (0..frame.sample_count).map(pass).collect()
}

/// As [`passes`], but each sample in its own order: summed up they are, to the last bit, what one pass for all makes.
pub fn ordered_passes(frame: &Frame, adaptively: u32) -> Vec<Frame> {
    if frame.most_samples != 0 {
        return adaptive::passes(frame, adaptively);
    }
    let pass = |first_sample| Frame {
        first_sample,
        sample_count: 1,
        ..*frame
    };
    (0..frame.sample_count).map(pass).collect()
}

/// The number of the sample that comes in place `i` of 1, 4, 16 or 64: samples of the first half far from each other,
/// each followed by the one that lies opposite.
fn scattered(i: u32, count: u32) -> u32 {
    let half = (count / 2).max(1);
    // Any odd step reaches all of a power of two; the golden section leaves no gaps for long.
    let step = (half as f32 * 0.618) as u32 | 1;
    let sample = i / 2 * step % half;
    if i.is_multiple_of(2) {
        sample
    } else {
        count - 1 - sample
    }
}

/// Camera rays of a frame.
pub fn rays(frame: &Frame) -> u64 {
    let size = frame.size();
    u64::from(size.x) * u64::from(size.y) * u64::from(frame.sample_count * EyeView::eyes(frame))
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable;
    use glam::{Vec2, vec2};
    use oktant_shared::sampling::{Batch, REGULAR, ROTATED, sample};
    use oktant_shared::stereo::{ANAGLYPH, STACKED};

    fn frame(pattern: u32, side: u32) -> Frame {
        Frame {
            pattern,
            samples: side * side,
            sample_count: side * side,
            samples_per_side: side,
            ..Frame::zeroed()
        }
    }

    #[test]
    fn every_sample_is_taken_once_and_the_first_one_overwrites() {
        for pattern in [REGULAR, ROTATED, R2] {
            for side in [1, 2, 4, 8] {
                let frame = frame(pattern, side);
                let mut numbers: Vec<u32> = passes(&frame, 64).iter().map(|pass| pass.first_sample).collect();
                assert_eq!(numbers[0], 0);
                numbers.sort_unstable();
                assert_eq!(numbers, (0..side * side).collect::<Vec<u32>>());
            }
        }
    }

    #[test]
    fn a_few_samples_are_spread_over_the_pixel() {
        for pattern in [REGULAR, ROTATED, R2] {
            for (side, few) in [(2, 2), (4, 2), (4, 4), (8, 4), (8, 6), (8, 16), (8, 32)] {
                let frame = frame(pattern, side);
                let places = passes(&frame, 64)
                    .into_iter()
                    .take(few)
                    .map(|pass| sample(&frame, &Batch::of_frame(&frame), pass.first_sample).place);
                let places: Vec<Vec2> = places.collect();
                let mean = places.iter().sum::<Vec2>() / few as f32;
                let reach = places.iter().map(|place| place.distance(mean)).fold(0.0, f32::max);
                assert!(reach > 0.2, "{few} of {side} x {side}, {pattern}: {places:?}");
                let tolerance = if pattern == R2 { 0.3 } else { 1e-6 };
                assert!(
                    mean.distance(vec2(0.5, 0.5)) < tolerance,
                    "{few} of {side} x {side}, {pattern}: {mean}"
                );
            }
        }
    }

    #[test]
    fn two_eyes_count() {
        let mut frame = frame(REGULAR, 2);
        (frame.camera.width, frame.camera.height) = (10, 5);
        assert_eq!(rays(&frame), 200);
        for stereo in [ANAGLYPH, STACKED] {
            frame.stereo = stereo;
            assert_eq!(rays(&frame), 400);
        }
    }
}
