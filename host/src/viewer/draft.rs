//! How coarse a picture may be so that it is there in time.

use super::pace::Pace;
use crate::sampling::Samples;
use crate::stereo::StereoMode;
use crate::view::View;
use std::time::Duration;

/// A picture that takes no longer than this keeps up with a hand that drags.
const FLUID: Duration = Duration::from_millis(60);
/// A pixel of the coarsest draft covers a square with this edge, pixels of the window.
const COARSEST: u32 = 8;
/// Reflections and refractions that a draft follows where the coarsest one would not be there in time with all of them:
/// a ray comes through a pane of glass and sees what is behind it.
const SHALLOW: u32 = 2;

/// How a picture is simplified.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Draft {
    /// Edge of the square of the window's pixels that one of its pixels covers.
    pub edge: u32,
    /// Whether rays are followed less far.
    pub is_shallow: bool,
}

impl Draft {
    /// One sample for each of the window's pixels, nothing else is simplified.
    pub const FINE: Draft = Draft {
        edge: 1,
        is_shallow: false,
    };

    /// The view with one sample a pixel, simplified.
    pub fn simplified(&self, view: &View) -> View {
        let mut view = View {
            samples: Samples::One,
            adaptive: false,
            ..*view
        };
        if self.is_shallow {
            view.depth = view.depth.min(SHALLOW);
        }
        // Enlarged rows would reach the wrong eyes.
        if self.edge > 1 {
            view.stereo.take_if(|stereo| stereo.mode == StereoMode::Rows);
        }
        view
    }

    /// Size of the draft of a picture.
    pub fn size(&self, size: [u32; 2]) -> [u32; 2] {
        size.map(|side| side.div_ceil(self.edge))
    }
}

/// How fast a back end renders the scene, and what drafts follow from that.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paces {
    /// With all reflections and refractions.
    full: Pace,
    /// With few of them.
    shallow: Pace,
}

impl Paces {
    /// Nothing is measured yet.
    pub fn guessed(is_plain: bool) -> Self {
        Paces {
            full: Pace::guessed(is_plain),
            shallow: Pace::guessed(is_plain),
        }
    }

    /// Takes note of how long so many camera rays took.
    pub fn measured(&mut self, is_shallow: bool, rays: u64, milliseconds: f64) {
        let pace = if is_shallow { &mut self.shallow } else { &mut self.full };
        pace.measured(rays, milliseconds);
    }

    /// The best draft that is there in time.
    pub fn draft(&self, view: &View, size: [u32; 2]) -> Draft {
        let rays_per_pixel = view.stereo.map_or(1, |stereo| stereo.mode.rays_per_sample());
        let in_time = |pace: &Pace, is_shallow| {
            (1..=COARSEST).map(|edge| Draft { edge, is_shallow }).find(|draft| {
                let [width, height] = draft.size(size).map(u64::from);
                pace.time(width * height * u64::from(rays_per_pixel)) <= FLUID
            })
        };
        let coarsest = Draft {
            edge: COARSEST,
            is_shallow: view.depth > SHALLOW,
        };
        in_time(&self.full, false)
            .or_else(|| in_time(&self.shallow, true).filter(|_| coarsest.is_shallow))
            .unwrap_or(coarsest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stereo::Stereo;

    const SIZE: [u32; 2] = [1280, 968];

    #[test]
    fn slower_is_coarser_and_at_last_shallow() {
        let view = View::default();
        let mut last = Draft::FINE;
        for nanoseconds in [1, 40, 100, 200, 400, 1000, 3000] {
            let mut paces = Paces::guessed(true);
            paces.measured(false, 1_000_000, f64::from(nanoseconds));
            let draft = paces.draft(&view, SIZE);
            assert!(draft.edge >= last.edge && !draft.is_shallow, "{nanoseconds} ns a ray");
            let [width, height] = draft.size(SIZE);
            assert!(width * height * nanoseconds <= 60_000_000, "{nanoseconds} ns a ray");
            last = draft;
        }
        assert_eq!(last.edge, COARSEST);
        let mut paces = Paces::guessed(true);
        paces.measured(false, 1_000_000, 9000.0);
        assert!(paces.draft(&view, SIZE).is_shallow);
        paces.measured(true, 1_000_000, 800.0);
        let draft = paces.draft(&view, SIZE);
        assert!(draft.is_shallow && draft.edge < COARSEST, "{draft:?}");
        assert_eq!(draft.simplified(&view).depth, SHALLOW);
        let level = View { depth: 1, ..view };
        let draft = paces.draft(&level, SIZE);
        assert!(!draft.is_shallow, "there is nothing to leave out");
        assert_eq!(draft.simplified(&level).depth, 1);
    }

    #[test]
    fn two_eyes_need_twice_the_time() {
        let mut paces = Paces::guessed(true);
        // Just in time for one.
        paces.measured(false, 1280 * 968, 59.0);
        let edge = |mode| {
            let view = View {
                stereo: Some(Stereo::new(mode)),
                ..View::default()
            };
            paces.draft(&view, SIZE).edge
        };
        assert_eq!([StereoMode::Rows, StereoMode::SideBySide].map(edge), [1, 1]);
        assert_eq!([StereoMode::Sequential, StereoMode::Anaglyph].map(edge), [2, 2]);
    }

    #[test]
    fn rows_reach_their_eyes_or_there_is_one_eye() {
        let view = View {
            stereo: Some(Stereo::new(StereoMode::Rows)),
            ..View::default()
        };
        for (edge, keeps) in [(1, true), (2, false)] {
            let draft = Draft {
                edge,
                is_shallow: false,
            };
            assert_eq!(draft.simplified(&view).stereo.is_some(), keeps);
            assert_eq!(draft.size([1281, 3]), [1281_u32.div_ceil(edge), 3_u32.div_ceil(edge)]);
        }
    }
}
