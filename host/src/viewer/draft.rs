//! How coarse a picture may be so that it is there in time.

use super::pace::Pace;
use crate::sampling::Samples;
use crate::scene::Scene;
use crate::stereo::StereoMode;
use crate::view::View;
use oktant_shared::frame::Frame;
use oktant_shared::light::Light;
use std::time::Duration;

/// What part of a draft's time may go into more samples than one: so many times as often are pictures shown then.
const SPARE: u32 = 4;
/// A pixel of the coarsest draft covers a square with this edge, pixels of the window.
const COARSEST: u32 = 4;
/// Reflections and refractions that a draft follows where the coarsest one would not be there in time with all of them:
/// a ray comes through a pane of glass and sees what is behind it.
const SHALLOW: u32 = 2;

/// How a picture is simplified.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Draft {
    /// Edge of the square of the window's pixels that one of its pixels covers.
    pub edge: u32,
    /// Whether rays are followed less far, and the first light asked in its middle alone.
    pub is_shallow: bool,
    /// Samples of each of its pixels.
    pub samples: Samples,
}

impl Draft {
    /// One sample for each of the window's pixels, nothing else is simplified.
    pub const FINE: Draft = Draft {
        edge: 1,
        is_shallow: false,
        samples: Samples::One,
    };

    /// Whether it shows less than one sample of all pixels would.
    pub fn is_coarse(&self) -> bool {
        self.edge > 1 || self.is_shallow
    }

    /// The frame of a picture of that size, simplified.
    pub fn frame(&self, view: &View, scene: &Scene, size: [u32; 2]) -> Frame {
        let [width, height] = self.size(size);
        let mut frame = self.simplified(view).frame(scene, width, height);
        if self.is_shallow {
            // Softer shadows take most rays of a scene that has them.
            frame.light.samples_per_side = 1;
        }
        frame
    }

    fn simplified(&self, view: &View) -> View {
        let mut view = View {
            samples: self.samples,
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
    /// With all reflections and refractions, and all samples of the first light.
    full: Pace,
    /// With few of them, and one sample of the first light.
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

    /// The best draft that is there within a time: as fine as it can be, then with as many samples as are wanted, or as are
    /// there in a quarter of the time. The light is the scene's first.
    pub fn draft(&self, view: &View, light: &Light, size: [u32; 2], target: Duration) -> Draft {
        let rays_per_sample = view.stereo.map_or(1, |stereo| stereo.mode.rays_per_sample());
        let time = |pace: &Pace, draft: &Draft| {
            let [width, height] = draft.size(size).map(u64::from);
            pace.time(width * height * u64::from(rays_per_sample * draft.samples.count()))
        };
        let in_time = |pace: &Pace, is_shallow| {
            let drafts = (1..=COARSEST).map(|edge| Draft {
                edge,
                is_shallow,
                ..Draft::FINE
            });
            drafts.into_iter().find(|draft| time(pace, draft) <= target)
        };
        let coarsest = Draft {
            edge: COARSEST,
            is_shallow: view.depth > SHALLOW || light.sample_count() > 1,
            ..Draft::FINE
        };
        let smooth = || {
            let drafts = Samples::ALL.map(|samples| Draft { samples, ..Draft::FINE });
            let mut finer = drafts.into_iter().skip(1).rev();
            finer.find(|draft| draft.samples <= view.samples && time(&self.full, draft) <= target / SPARE)
        };
        smooth()
            .or_else(|| in_time(&self.full, false))
            .or_else(|| in_time(&self.shallow, true).filter(|_| coarsest.is_shallow))
            .unwrap_or(coarsest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::progress::silent;
    use crate::stereo::Stereo;
    use crate::structure::StructureOptions;
    use glam::Vec3;
    use oktant_shared::light;

    const SIZE: [u32; 2] = [1280, 968];
    const FLUID: Duration = Duration::from_millis(60);
    const POINT: Light = Light {
        position: Vec3::Y,
        kind: light::POINT,
        color: Vec3::ONE,
        falloff_radius: 0.0,
        edge_u: Vec3::ZERO,
        samples_per_side: 1,
        edge_v: Vec3::ZERO,
        range: 0.0,
    };

    #[test]
    fn slower_is_coarser_and_at_last_shallow() {
        let view = View::default();
        let mut last = Draft::FINE;
        for nanoseconds in [1, 40, 100, 200, 400, 700, 750] {
            let mut paces = Paces::guessed(true);
            paces.measured(false, 1_000_000, f64::from(nanoseconds));
            let draft = paces.draft(&view, &POINT, SIZE, FLUID);
            assert!(draft.edge >= last.edge && !draft.is_shallow, "{nanoseconds} ns a ray");
            let [width, height] = draft.size(SIZE);
            assert!(width * height * nanoseconds <= 60_000_000, "{nanoseconds} ns a ray");
            last = draft;
        }
        assert_eq!(last.edge, COARSEST);
        let mut paces = Paces::guessed(true);
        paces.measured(false, 1_000_000, 9000.0);
        assert!(paces.draft(&view, &POINT, SIZE, FLUID).is_shallow);
        paces.measured(true, 1_000_000, 400.0);
        let draft = paces.draft(&view, &POINT, SIZE, FLUID);
        assert!(draft.is_shallow && draft.edge < COARSEST, "{draft:?}");
        assert_eq!(draft.simplified(&view).depth, SHALLOW);
        let level = View { depth: 1, ..view };
        let draft = paces.draft(&level, &POINT, SIZE, FLUID);
        assert!(!draft.is_shallow, "there is nothing to leave out");
        assert_eq!(draft.simplified(&level).depth, 1);
    }

    #[test]
    fn light_of_many_samples_is_left_out_before_the_time_is_exceeded() {
        let area = Light {
            kind: light::AREA,
            edge_u: Vec3::X,
            edge_v: Vec3::Z,
            samples_per_side: 3,
            ..POINT
        };
        let view = View {
            depth: 0,
            ..View::default()
        };
        let mut paces = Paces::guessed(false);
        paces.measured(false, 1_000_000, 3000.0);
        paces.measured(true, 1_000_000, 300.0);
        assert!(!paces.draft(&view, &POINT, SIZE, FLUID).is_shallow);
        let draft = paces.draft(&view, &area, SIZE, FLUID);
        assert!(draft.is_shallow && draft.edge < COARSEST, "{draft:?}");
        let mesh = Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            triangles: vec![[0, 1, 2]],
            ..Mesh::default()
        };
        let mut scene = Scene::new(&mesh, &StructureOptions::default(), &silent).unwrap();
        scene.light = area;
        for (draft, samples) in [(Draft::FINE, 9), (draft, 1)] {
            assert_eq!(draft.frame(&view, &scene, SIZE).light.sample_count(), samples);
        }
    }

    #[test]
    fn drafts_follow_the_time_that_they_may_take() {
        let view = View {
            samples: Samples::Sixteen,
            ..View::default()
        };
        let mut paces = Paces::guessed(true);
        // A sample at all pixels takes 12.4 ms.
        paces.measured(false, 1_000_000, 10.0);
        let draft = |milliseconds| {
            let draft = paces.draft(&view, &POINT, SIZE, Duration::from_millis(milliseconds));
            (draft.edge, draft.samples)
        };
        assert_eq!(draft(1), (4, Samples::One));
        assert_eq!(draft(4), (2, Samples::One));
        assert_eq!(draft(13), (1, Samples::One));
        assert_eq!(draft(190), (1, Samples::One));
        assert_eq!(draft(200), (1, Samples::Four));
        assert_eq!(draft(800), (1, Samples::Sixteen));
        for (milliseconds, is_coarse) in [(4, true), (13, false), (200, false)] {
            let draft = paces.draft(&view, &POINT, SIZE, Duration::from_millis(milliseconds));
            assert_eq!(
                draft.is_coarse(),
                is_coarse,
                "{milliseconds}: what comes next is no worse"
            );
        }
        assert_eq!(draft(60_000), (1, Samples::Sixteen), "no more than are wanted");
        for is_shallow in [false, true] {
            paces.measured(is_shallow, 1_000_000, 1e6);
        }
        assert_eq!(
            paces.draft(&view, &POINT, SIZE, FLUID).edge,
            COARSEST,
            "never below the floor"
        );
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
            paces.draft(&view, &POINT, SIZE, FLUID).edge
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
            let draft = Draft { edge, ..Draft::FINE };
            assert_eq!(draft.simplified(&view).stereo.is_some(), keeps);
            assert_eq!(draft.size([1281, 3]), [1281_u32.div_ceil(edge), 3_u32.div_ceil(edge)]);
        }
    }
}
