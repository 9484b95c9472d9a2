//! The passes in which pixels get as many samples as they need.

use oktant_shared::adaptive::ROUNDS;
use oktant_shared::frame::Frame;

/// The most pixels along the edge of a block that is interpolated.
pub const LARGEST_BLOCK: u32 = 8;

/// The passes of a frame that is sampled adaptively ([`Frame::most_samples`] is not 0), each with at most `per_pass` samples
/// of a pixel. Taken one after the other they make the picture; each leaves one that can be shown, once all pixels are known.
///
/// A pass over a list that begins with the first sample makes the list first: see [`makes_list`].
pub fn passes(frame: &Frame, per_pass: u32) -> Vec<Frame> {
    let whole = Frame {
        samples: 1,
        samples_per_side: 1,
        first_sample: 0,
        sample_count: 1,
        is_listed: 0,
        first_listed: 0,
        ..*frame
    };
    let mut passes = Vec::new();
    if frame.block > 1 {
        // The corners of the blocks, then the middles between them, then between those.
        let mut block = 2 * frame.block;
        while block > 1 {
            passes.push(Frame {
                is_listed: 1,
                block,
                ..whole
            });
            block /= 2;
        }
    } else {
        passes.push(whole);
    }
    if frame.most_samples > 1 {
        for round in 1..=ROUNDS {
            for first_sample in (0..frame.most_samples).step_by(per_pass.max(1) as usize) {
                passes.push(Frame {
                    is_listed: round,
                    block: 1,
                    first_sample,
                    sample_count: per_pass.max(1).min(frame.most_samples - first_sample),
                    ..whole
                });
            }
        }
    }
    passes
}

/// Whether a pass begins with making the list of the pixels that it renders.
pub fn makes_list(pass: &Frame) -> bool {
    pass.is_listed != 0 && pass.first_sample == 0 && pass.first_listed == 0
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable;

    fn frame(most_samples: u32, block: u32) -> Frame {
        let mut frame = Frame {
            most_samples,
            block,
            ..Frame::zeroed()
        };
        (frame.camera.width, frame.camera.height) = (100, 30);
        frame
    }

    #[test]
    fn blocks_are_halved_until_they_are_pixels() {
        let blocks: Vec<u32> = passes(&frame(1, 8), 64).iter().map(|pass| pass.block).collect();
        assert_eq!(blocks, [16, 8, 4, 2]);
        assert!(passes(&frame(1, 8), 64).iter().all(makes_list));
        let plain = passes(&frame(1, 1), 64);
        assert_eq!(plain.len(), 1);
        assert_eq!(plain[0].is_listed, 0);
    }

    #[test]
    fn each_round_takes_all_samples_in_passes() {
        for per_pass in [1, 5, 16, 64] {
            let rounds = passes(&frame(16, 1), per_pass);
            let rounds = &rounds[1..];
            assert_eq!(
                rounds.iter().map(|pass| pass.sample_count).sum::<u32>(),
                16 * ROUNDS,
                "{per_pass}"
            );
            let numbers: Vec<u32> = rounds
                .iter()
                .filter(|pass| makes_list(pass))
                .map(|pass| pass.is_listed)
                .collect();
            assert_eq!(numbers, Vec::from_iter(1..=ROUNDS));
        }
    }
}
