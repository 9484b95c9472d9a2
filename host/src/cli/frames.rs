//! `oktant render --frames`.

use super::Failure;
use super::arguments::{FrameRange, RenderArguments};
use super::engine::Engine;
use super::interruption;
use super::prepared::Prepared;
use super::progress_bar::ProgressBar;
use super::render::{counted, print_kernel, told};
use super::rendering_report::{Figures, FrameReport, RenderingReport};
use super::sequence::{Album, Sequence};
use oktant::camera_path::CameraPath;
use oktant::output::Written;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

/// Renders the frames of an animation into their files and says what was done.
pub fn run(arguments: &RenderArguments, range: &FrameRange) -> Result<(), Failure> {
    let RenderArguments {
        mesh,
        files,
        frames,
        look,
        ..
    } = arguments;
    look.check(&mesh.source()?)?;
    let sequence = Sequence::new(files, frames, look, range)?;
    files.check_standard_output(arguments.json)?;
    let path = frames.camera_path()?;
    let engine = arguments.engine.options()?;
    // First of all, so that nobody waits for pictures that cannot be stored.
    sequence.check(*range.wanted.start(), look.asks_for_pair())?;
    let variant = arguments.variant.map(|variant| variant.0);
    let mut prepared = Prepared::load(mesh, arguments.size, look, variant)?;
    let mut engine = prepared.engine(mesh, look, &engine)?;
    let kept = if frames.overwrite {
        Vec::new()
    } else {
        sequence.there(range, prepared.is_pair())
    };
    if !kept.is_empty() {
        eprintln!(
            "There already, and kept: {} of {}; --overwrite renders them anew.",
            kept.len(),
            counted(range.len() as usize, "frame"),
        );
    }
    let roll = Roll {
        prepared: &prepared,
        path: &path,
        range,
        arguments,
    };
    let next = roll.allow_interruption(&sequence);
    let mut album = sequence.open(prepared.is_pair())?;
    let taken = roll.take(&mut engine, &mut album, &kept, &next)?;
    let written = album.finish()?;
    let (reports, figures): (Vec<_>, Vec<_>) = taken.into_iter().unzip();
    let together = Figures::together(&figures);
    if !figures.is_empty() {
        roll.tell(&engine, &written, figures.len(), &together);
    }
    if arguments.json {
        return RenderingReport::of_frames(&prepared, &engine, &written, kept, reports, &together).print();
    }
    print_kernel(&together, files)
}

/// Frames that are to be taken.
struct Roll<'a> {
    prepared: &'a Prepared,
    path: &'a CameraPath,
    range: &'a FrameRange,
    arguments: &'a RenderArguments,
}

impl Roll<'_> {
    /// Takes all frames but those that are kept, in their order; says in `next` which follows those that are complete.
    fn take(
        &self,
        engine: &mut Engine,
        album: &mut Album,
        kept: &[u32],
        next: &AtomicU32,
    ) -> Result<Vec<(FrameReport, Figures)>, Failure> {
        let wanted: Vec<u32> = self
            .range
            .wanted
            .clone()
            .filter(|frame| kept.binary_search(frame).is_err())
            .collect();
        let bar = ProgressBar::new();
        let mut taken = Vec::with_capacity(wanted.len());
        for (done, frame) in wanted.iter().enumerate() {
            let view = self.path.view(&self.prepared.view, *frame, self.range.count);
            let of_all = |fraction| (done as f32 + fraction) / wanted.len() as f32;
            let rendered = self
                .prepared
                .render(engine, &view, &self.arguments.files.aov.0, &|_, fraction| {
                    bar.show(format!("frame {frame}"), of_all(fraction));
                })?;
            let mut figures = Figures::new(&rendered);
            figures.time(engine, &rendered.frame, self.arguments.repeat)?;
            let written = album.add(*frame, rendered.picture, rendered.seen, &view.tone)?;
            next.store(frame + 1, Ordering::Relaxed);
            taken.push((FrameReport::new(*frame, &written, &figures), figures));
        }
        Ok(taken)
    }

    /// Whoever interrupts is told what is there, and how to go on. Returns where the frame is to be kept that follows those
    /// that are complete.
    fn allow_interruption(&self, sequence: &Sequence) -> Arc<AtomicU32> {
        let next = Arc::new(AtomicU32::new(*self.range.wanted.start()));
        let (known, sequence, range) = (next.clone(), sequence.clone(), self.range.clone());
        let (is_pair, overwrite) = (self.prepared.is_pair(), self.arguments.frames.overwrite);
        interruption::tell(move || match &sequence {
            Sequence::Animation(_) => {
                "Nothing is written before all frames are there; the same command begins anew.".into()
            }
            Sequence::Numbered(_) if overwrite => format!(
                "Frames before {next} are new; go on with --frames {next}..{}/{}.",
                range.wanted.end(),
                range.count,
                next = known.load(Ordering::Relaxed),
            ),
            Sequence::Numbered(_) => format!(
                "Complete: {} of {}; the same command goes on with the others.",
                sequence.there(&range, is_pair).len(),
                counted(range.len() as usize, "frame"),
            ),
        });
        next
    }

    /// Says what was rendered.
    fn tell(&self, engine: &Engine, written: &[Written], count: usize, figures: &Figures) {
        eprintln!(
            "{}: {} of {} x {} pixels, {} each, {}, {}, {:.3} s",
            ends(written),
            counted(count, "frame"),
            self.prepared.size.width,
            self.prepared.size.height,
            self.prepared.samples(figures.mean_samples),
            counted(self.prepared.triangles, "triangle"),
            engine.name(),
            figures.seconds,
        );
        if !self.prepared.scene.is_plain() {
            eprintln!("{}", told(&figures.effort, figures.seconds));
        }
    }
}

/// The first picture and the last, or all where they are few.
fn ends(written: &[Written]) -> String {
    let pictures: Vec<_> = written.iter().filter(|file| file.description.is_none()).collect();
    match pictures.as_slice() {
        [first, .., last] => format!("{} to {}", first.path.display(), last.path.display()),
        [only] => only.path.display().to_string(),
        [] => String::new(),
    }
}
