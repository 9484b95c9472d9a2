//! What a dispatch renders.

use super::{TILE, TILE_HEIGHT};
use oktant_shared::adaptive::{LIST_GROUP, pixels_of_group};
use oktant_shared::frame::Frame;
use oktant_shared::pixels::ROW;
use oktant_shared::stereo::EyeView;

/// All entry points that look at pixels have workgroups of one size.
const _: () = assert!(LIST_GROUP == TILE * TILE_HEIGHT);

/// A pass over pixels, or a part of it.
pub(super) struct Pass {
    /// What is the same for all of them.
    pub frame: Frame,
    /// Rows of the picture, or pixels of the list.
    extent: u32,
}

impl Pass {
    /// Over the whole picture, or the whole list.
    pub fn whole(frame: &Frame) -> Self {
        let size = frame.size();
        let extent = if frame.is_listed == 0 {
            size.y
        } else {
            size.x * size.y - frame.first_listed
        };
        Pass { frame: *frame, extent }
    }

    /// Over the whole picture, in bands that have at most so many camera rays each, or a row of workgroups where those of one
    /// sample are more; a band takes at most `most` samples of a pixel.
    pub fn bands(frame: &Frame, rays: u64, most: u32) -> Vec<Self> {
        let (width, height) = frame.size().into();
        // Of a sample of a row.
        let of_row = u64::from(width * EyeView::eyes(frame)).max(1);
        let samples = (rays / (of_row * u64::from(height)).max(1)).clamp(1, u64::from(most)) as u32;
        // Whole workgroups: a row of the next band must not be added twice.
        let rows = (rays / (of_row * u64::from(samples))) as u32 / TILE_HEIGHT * TILE_HEIGHT;
        let rows = rows.clamp(TILE_HEIGHT, height.next_multiple_of(TILE_HEIGHT));
        let mut bands = Vec::new();
        for first_sample in (0..frame.sample_count).step_by(samples as usize) {
            for first_row in (0..height).step_by(rows as usize) {
                bands.push(Pass {
                    frame: Frame {
                        first_sample: frame.first_sample + first_sample,
                        sample_count: samples.min(frame.sample_count - first_sample),
                        first_row,
                        ..*frame
                    },
                    extent: rows.min(height - first_row),
                });
            }
        }
        bands
    }

    /// Over a list, in parts that have at most so many camera rays each, or a workgroup's where that has more.
    pub fn parts(frame: &Frame, rays: u64) -> Vec<Self> {
        let size = frame.size();
        let all = size.x * size.y;
        let of_group = pixels_of_group(frame);
        let rays_of_group = frame.sample_count * EyeView::eyes(frame) * of_group;
        let groups = (rays / u64::from(rays_of_group)).clamp(1, u64::from(all)) as u32;
        // Whole workgroups and whole rows of them: a pixel of the next part must not be added twice.
        let groups = if groups > ROW { groups / ROW * ROW } else { groups };
        (0..all)
            .step_by((groups * of_group) as usize)
            .map(|first_listed| Pass {
                frame: Frame { first_listed, ..*frame },
                extent: (groups * of_group).min(all - first_listed),
            })
            .collect()
    }

    /// Workgroups along each axis. Those of a list are as many as for a list of all pixels, most of which find nothing to do: that
    /// takes less than to ask first how many are needed.
    pub fn workgroups(&self) -> [u32; 2] {
        if self.frame.is_listed == 0 {
            [self.frame.size().x.div_ceil(TILE), self.extent.div_ceil(TILE_HEIGHT)]
        } else {
            in_rows(self.extent.div_ceil(pixels_of_group(&self.frame)))
        }
    }
}

/// So many workgroups in rows of [`ROW`]; the last row is a whole one if there are several.
pub(super) fn in_rows(workgroups: u32) -> [u32; 2] {
    [workgroups.min(ROW), workgroups.div_ceil(ROW)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable;
    use oktant_shared::stereo::{ANAGLYPH, MONO};

    /// Oracle: each place of the list once. Workgroups take what the kernel takes.
    #[test]
    fn parts_cover_the_list_once() {
        for (width, height) in [(1, 1), (100, 30), (333, 77), (1280, 968), (4000, 3001)] {
            for (sample_count, stereo) in [(1, MONO), (3, MONO), (4, ANAGLYPH), (16, MONO), (64, ANAGLYPH)] {
                for samples in [1, 1000, 1 << 21, 5_000_000, 1 << 24, 200_000_000] {
                    let mut frame = Frame {
                        is_listed: 1,
                        sample_count,
                        stereo,
                        ..Frame::zeroed()
                    };
                    (frame.camera.width, frame.camera.height) = (width, height);
                    let all = width * height;
                    if samples == 1 && all > 10_000 {
                        continue;
                    }
                    let of_group = pixels_of_group(&frame);
                    let mut next = 0;
                    for part in Pass::parts(&frame, samples) {
                        assert_eq!(
                            part.frame.first_listed, next,
                            "{width} x {height}, {sample_count}, {samples}"
                        );
                        let [across, down] = part.workgroups();
                        assert!(across <= ROW, "a device takes no more");
                        // Rows that are not whole leave places out.
                        assert!(across == ROW || down == 1);
                        let end = next + across * down * of_group;
                        let is_last = next + part.extent == all;
                        assert!(
                            is_last || end == next + part.extent,
                            "{end}: the next part's are taken, too"
                        );
                        assert!(end >= next + part.extent, "{end}: some are left out");
                        next += part.extent;
                    }
                    assert_eq!(next, all);
                }
            }
        }
    }

    fn large(is_listed: u32, stereo: u32) -> Frame {
        let mut frame = Frame {
            is_listed,
            sample_count: 16,
            stereo,
            ..Frame::zeroed()
        };
        (frame.camera.width, frame.camera.height) = (1280, 968);
        frame
    }

    #[test]
    fn a_part_has_no_more_rays_than_it_may() {
        for (stereo, eyes, wanted) in [(MONO, 1, 10), (ANAGLYPH, 2, 19)] {
            let parts = Pass::parts(&large(1, stereo), 1 << 21);
            assert_eq!(parts.len(), wanted);
            let rays = |part: &Pass| part.extent * part.frame.sample_count * eyes;
            assert!(parts.iter().all(|part| rays(part) <= 1 << 21), "{eyes} eyes");
        }
    }

    /// Oracle: each sample of each row once.
    #[test]
    fn a_band_has_no_more_rays_than_it_may() {
        for (stereo, eyes) in [(MONO, 1), (ANAGLYPH, 2)] {
            // All samples at once, several, and one of a part of the rows.
            for (most, budget) in [(16, 1 << 28), (16, 1 << 24), (1, 1 << 24), (16, 1 << 20)] {
                let bands = Pass::bands(&large(0, stereo), budget, most);
                let mut next = (0, 0);
                for band in &bands {
                    let Frame {
                        first_sample,
                        sample_count,
                        first_row,
                        ..
                    } = band.frame;
                    assert_eq!((first_sample, first_row), next, "{eyes} eyes, {budget}");
                    let rays = u64::from(1280 * band.extent * sample_count * eyes);
                    assert!(rays <= budget && sample_count <= most, "{eyes} eyes, {budget}: {rays}");
                    let end = first_row + band.extent;
                    next = if end < 968 {
                        (first_sample, end)
                    } else {
                        (first_sample + sample_count, 0)
                    };
                }
                assert_eq!(next, (16, 0), "{eyes} eyes, {budget}");
            }
        }
    }
}
