//! What was rendered, for programs: `oktant render --json`.

use super::Failure;
use super::engine::Engine;
use super::prepared::{Prepared, Rendered};
use oktant::effort::Effort;
use oktant::output::Written;
use oktant::spread::Spread;
use oktant_shared::frame::Frame;
use serde::Serialize;

/// Everything that there is to say of a picture, or of many.
#[derive(Debug, Serialize)]
pub struct RenderingReport {
    /// Version of oktant.
    version: &'static str,
    /// All files that were written.
    files: Vec<String>,
    /// Width and height, pixels.
    size: [u32; 2],
    /// Samples of a pixel, at most.
    samples: u32,
    /// Whether each pixel has only as many as it needs.
    adaptive: bool,
    triangles: usize,
    backend: String,
    /// Of all frames together, where there are many: sums of times and rays, means of means, the greatest of all bounds.
    #[serde(flatten)]
    figures: FiguresReport,
    /// Numbers of the frames that were there already, where frames were asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    kept: Option<Vec<u32>>,
    /// Each frame that was rendered, where frames were asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    frames: Option<Vec<FrameReport>>,
}

/// A frame of an animation.
#[derive(Debug, Serialize)]
pub struct FrameReport {
    /// From 1.
    frame: u32,
    /// Its own files; none where one file holds all frames.
    files: Vec<String>,
    #[serde(flatten)]
    figures: FiguresReport,
}

/// What pictures took.
#[derive(Clone, Debug, Default)]
pub struct Figures {
    /// Rendering, by the clock on the wall.
    pub seconds: f64,
    /// Samples of a pixel.
    pub mean_samples: f64,
    pub effort: Effort,
    /// Times of the kernel, milliseconds.
    times: Vec<f64>,
}

/// What pictures took, as programs read it.
#[derive(Debug, Serialize)]
struct FiguresReport {
    seconds: f64,
    mean_samples: f64,
    /// None where they were not asked for with --repeat.
    kernel_milliseconds: Option<Spread>,
    rays: Rays,
    cut: Cut,
}

/// Rays that were traced.
#[derive(Debug, Serialize)]
struct Rays {
    closest: u64,
    shadow: u64,
}

/// Bounds of what is missing for rays that were not.
#[derive(Debug, Serialize)]
struct Cut {
    /// Parts of the brightest light.
    greatest: f64,
    mean: f64,
    /// Steps of 8 bits of the output.
    greatest_steps: f64,
    mean_steps: f64,
}

impl Figures {
    /// Of a picture, the kernel not yet timed.
    pub fn new(rendered: &Rendered) -> Self {
        Figures {
            seconds: rendered.seconds,
            mean_samples: rendered.mean_samples,
            effort: rendered.effort,
            times: Vec::new(),
        }
    }

    /// Times the kernel, where that is to be done more than once.
    ///
    /// # Errors
    /// Of the back end.
    pub fn time(&mut self, engine: &mut Engine, frame: &Frame, repeat: u32) -> Result<(), Failure> {
        if repeat > 1 {
            self.times = engine.time_render(frame, repeat)?;
        }
        Ok(())
    }

    /// Of some pictures of the same size, together.
    pub fn together(all: &[Figures]) -> Self {
        let efforts: Vec<Effort> = all.iter().map(|figures| figures.effort).collect();
        Figures {
            seconds: all.iter().map(|figures| figures.seconds).sum(),
            mean_samples: all.iter().map(|figures| figures.mean_samples).sum::<f64>() / all.len().max(1) as f64,
            effort: Effort::together(&efforts),
            times: all.iter().flat_map(|figures| figures.times.iter().copied()).collect(),
        }
    }

    fn spread(&self) -> Option<Spread> {
        Spread::new(self.times.clone())
    }

    /// The times of the kernel as a line, if they were measured.
    pub fn kernel_line(&self) -> Option<String> {
        let spread = self.spread()?;
        Some(format!(
            "kernel: median {:.3} ms, least {:.3}, greatest {:.3} of {}\n",
            spread.median,
            spread.least,
            spread.greatest,
            self.times.len()
        ))
    }
}

impl From<&Figures> for FiguresReport {
    fn from(figures: &Figures) -> Self {
        let effort = figures.effort;
        FiguresReport {
            seconds: figures.seconds,
            mean_samples: figures.mean_samples,
            kernel_milliseconds: figures.spread(),
            rays: Rays {
                closest: effort.closest as u64,
                shadow: effort.shadow as u64,
            },
            cut: Cut {
                greatest: effort.greatest_cut,
                mean: effort.mean_cut,
                greatest_steps: effort.greatest_steps,
                mean_steps: effort.mean_steps,
            },
        }
    }
}

impl FrameReport {
    /// Of a frame, with its own files if it has some.
    pub fn new(frame: u32, files: &[Written], figures: &Figures) -> Self {
        FrameReport {
            frame,
            files: names(files),
            figures: figures.into(),
        }
    }
}

impl RenderingReport {
    /// Of one picture.
    pub fn of_picture(prepared: &Prepared, engine: &Engine, written: &[Written], figures: &Figures) -> Self {
        RenderingReport {
            version: env!("CARGO_PKG_VERSION"),
            files: names(written),
            size: [prepared.size.width, prepared.size.height],
            samples: prepared.view.samples.count(),
            adaptive: prepared.view.adaptive,
            triangles: prepared.triangles,
            backend: engine.name(),
            figures: figures.into(),
            kept: None,
            frames: None,
        }
    }

    /// Of an animation.
    pub fn of_frames(
        prepared: &Prepared,
        engine: &Engine,
        written: &[Written],
        kept: Vec<u32>,
        frames: Vec<FrameReport>,
        figures: &Figures,
    ) -> Self {
        RenderingReport {
            kept: Some(kept),
            frames: Some(frames),
            ..Self::of_picture(prepared, engine, written, figures)
        }
    }

    /// Prints it on standard output.
    pub fn print(&self) -> Result<(), Failure> {
        super::print(&format!("{}\n", serde_json::to_string(self)?))
    }
}

fn names(written: &[Written]) -> Vec<String> {
    written.iter().map(|file| file.path.display().to_string()).collect()
}
