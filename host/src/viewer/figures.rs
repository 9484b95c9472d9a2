//! What is measured while the window runs.

use super::fluidity::Fluidity;
use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// Frames are counted over this time.
const WINDOW: Duration = Duration::from_secs(1);

/// So many of the last frames are remembered.
pub const HISTORY: usize = 200;

/// What a frame took, milliseconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameTime {
    /// Since the frame before; none after a rest.
    pub frame: Option<f64>,
    /// The last pass before it.
    pub kernel: Option<f64>,
}

/// Times of frames and of the kernel.
#[derive(Clone, Debug, Default)]
pub struct Figures {
    /// New pictures shown since the window opened.
    pub frames: u64,
    /// How often the window was drawn, with a new picture or without.
    pub drawn: u64,
    /// Time from the start of the program's run to the first picture of the mesh.
    pub first_picture: Option<Duration>,
    /// Milliseconds of the last pass: by the GPU's clock, or the wall's for the CPU.
    pub kernel: Option<f64>,
    /// Closest-hit rays and shadow rays for each camera ray, in the last finished picture.
    pub kinds: Option<[f64; 2]>,
    /// Samples of each pixel that have been taken.
    pub samples: u32,
    /// The last [`HISTORY`] frames, the newest last.
    pub history: VecDeque<FrameTime>,
    /// From what was asked for to the frame that showed it, milliseconds, the last [`HISTORY`] times.
    pub responses: VecDeque<f64>,
    rays: u64,
    recent: VecDeque<Instant>,
}

impl Figures {
    /// A new picture is shown.
    pub fn frame(&mut self, now: Instant) {
        self.frames += 1;
        self.forget(now);
        let since = |last: &Instant| now.saturating_duration_since(*last).as_secs_f64() * 1e3;
        if self.history.len() == HISTORY {
            self.history.pop_front();
        }
        self.history.push_back(FrameTime {
            frame: self.recent.back().map(since),
            kernel: self.kernel,
        });
        self.recent.push_back(now);
    }

    /// What was asked for then is shown for the first time.
    pub fn response(&mut self, asked: Instant, now: Instant) {
        if self.responses.len() == HISTORY {
            self.responses.pop_front();
        }
        let waited = now.saturating_duration_since(asked);
        self.responses.push_back(waited.as_secs_f64() * 1e3);
    }

    /// Times between the last [`HISTORY`] frames, rests left out.
    pub fn frame_times(&self) -> Option<Fluidity> {
        Fluidity::of(self.history.iter().filter_map(|time| time.frame))
    }

    /// Times from the last inputs to their frames.
    pub fn response_times(&self) -> Option<Fluidity> {
        Fluidity::of(self.responses.iter().copied())
    }

    /// A pass is done: so many camera rays in so many milliseconds.
    pub fn pass(&mut self, samples: u32, rays: u64, milliseconds: f64) {
        self.samples = samples;
        self.rays = rays;
        self.kernel = Some(milliseconds);
    }

    /// New pictures a second, none while nothing moves.
    pub fn frames_a_second(&self, now: Instant) -> Option<f64> {
        let recent = |time: &&Instant| now.saturating_duration_since(**time) < WINDOW;
        let mut times = self.recent.iter().filter(recent);
        let first = times.next()?;
        let intervals = times.count();
        let span = self.recent.back()?.saturating_duration_since(*first);
        (intervals > 0 && !span.is_zero()).then(|| intervals as f64 / span.as_secs_f64())
    }

    /// Millions of camera rays a second in the last pass.
    pub fn megarays_a_second(&self) -> Option<f64> {
        let milliseconds = self.kernel.filter(|milliseconds| *milliseconds > 0.0)?;
        Some(self.rays as f64 / milliseconds / 1e3)
    }

    /// Millions of closest-hit rays and of shadow rays a second in the last pass, if it was like the last finished picture.
    pub fn megarays_by_kind(&self) -> Option<[f64; 2]> {
        let camera = self.megarays_a_second()?;
        self.kinds.map(|kinds| kinds.map(|of_one| of_one * camera))
    }

    /// When the frames a second change if no other frame comes.
    pub fn expiry(&self) -> Option<Instant> {
        self.recent.back().map(|last| *last + WINDOW)
    }

    /// Forgets frames that no longer count.
    pub fn forget(&mut self, now: Instant) {
        while self
            .recent
            .front()
            .is_some_and(|time| now.saturating_duration_since(*time) >= WINDOW)
        {
            self.recent.pop_front();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_counted_over_the_last_second() {
        let start = Instant::now();
        let at = |milliseconds| start + Duration::from_millis(milliseconds);
        let mut figures = Figures::default();
        assert_eq!(figures.frames_a_second(start), None);
        for i in 0..200 {
            figures.frame(at(i * 20));
        }
        let rate = figures.frames_a_second(at(3980)).unwrap();
        assert!((rate - 50.0).abs() < 1e-6, "{rate}");
        assert_eq!(figures.frames_a_second(at(4990)), None, "nothing moves any more");
        assert_eq!(figures.expiry(), Some(at(4980)));
        figures.forget(at(4980));
        assert_eq!(figures.expiry(), None);
        assert_eq!(figures.frames, 200);
    }

    #[test]
    fn the_last_frames_are_remembered() {
        let start = Instant::now();
        let at = |milliseconds| start + Duration::from_millis(milliseconds);
        let mut figures = Figures::default();
        figures.frame(at(0));
        figures.pass(1, 100, 3.0);
        figures.frame(at(20));
        figures.frame(at(5000));
        let times: Vec<_> = figures.history.iter().map(|time| (time.frame, time.kernel)).collect();
        assert_eq!(times, [(None, None), (Some(20.0), Some(3.0)), (None, Some(3.0))]);
        for i in 0..2 * HISTORY as u64 {
            figures.frame(at(6000 + i));
        }
        assert_eq!(figures.history.len(), HISTORY);
        let times = figures.frame_times().unwrap();
        assert_eq!((times.median, times.count), (1.0, HISTORY));
    }

    #[test]
    fn answers_are_counted_from_what_was_asked() {
        let start = Instant::now();
        let mut figures = Figures::default();
        assert_eq!(figures.response_times(), None);
        for i in 0..2 * HISTORY as u64 {
            figures.response(start, start + Duration::from_millis(i));
        }
        let times = figures.response_times().unwrap();
        assert_eq!((times.greatest, times.count), (399.0, HISTORY));
    }

    #[test]
    fn rays_a_second() {
        let mut figures = Figures::default();
        assert_eq!(figures.megarays_a_second(), None);
        figures.pass(1, 1_000_000, 4.0);
        assert_eq!(figures.megarays_a_second(), Some(250.0));
        assert_eq!(figures.megarays_by_kind(), None);
        figures.kinds = Some([1.5, 2.0]);
        assert_eq!(figures.megarays_by_kind(), Some([375.0, 500.0]));
    }
}
