//! Comparing the picture that is shown with the oracle's, pixel by pixel.

mod checked;
mod findings;
mod veil;

pub use checked::Checked;
pub use findings::{Disagreement, Findings};
pub use veil::veiled;

use super::accident::caught;
use super::application::Application;
use super::caption::grouped;
use super::notice::{Image, Mailbox, Notice};
use super::overlay::{Line, Tone};
use super::task::Engine;
use crate::oracle::whitted::Reference;
use crate::scene::{Scene, Staging};
use crate::source::Source;
use crate::view::View;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError, Weak};
use std::thread;

/// The picture that is to be compared.
#[derive(Clone)]
pub struct Subject {
    pub source: Source,
    pub scene: Arc<Scene>,
    pub view: View,
    /// Width and height of the window's inside.
    pub size: [u32; 2],
    pub image: Image,
    pub engine: Engine,
}

/// A scene, and the same in f64.
type Known = (Weak<Scene>, Arc<Reference>);

/// What the window knows of the comparison.
#[derive(Default)]
pub struct Comparison {
    /// What is compared, or was last.
    subject: Option<Subject>,
    /// Its number.
    number: u64,
    cancel: Arc<AtomicBool>,
    findings: Option<Arc<Findings>>,
    /// Why there are none.
    failure: Option<String>,
    /// The scene in f64, as long as it is the same one.
    reference: Arc<Mutex<Option<Known>>>,
}

impl Comparison {
    /// Gives up what is compared, and forgets what came of it.
    pub fn stop(&mut self) {
        self.cancel.store(true, Ordering::Relaxed);
        self.subject = None;
        self.findings = None;
        self.failure = None;
    }

    /// Whether this is what is compared, or was last.
    fn is_of(&self, scene: &Arc<Scene>, view: &View, image: &Image) -> bool {
        self.subject.as_ref().is_some_and(|subject| {
            Arc::ptr_eq(&subject.scene, scene) && subject.view == *view && subject.image.is_same(image)
        })
    }

    /// Begins to compare, on a thread of its own.
    fn start(&mut self, subject: Subject, mailbox: &Mailbox) {
        self.stop();
        self.number += 1;
        self.cancel = Arc::default();
        self.subject = Some(subject.clone());
        let (number, cancel) = (self.number, self.cancel.clone());
        let (reference, mailbox) = (self.reference.clone(), mailbox.clone());
        thread::spawn(move || {
            let send = |result| mailbox.send(Notice::Compared { number, result });
            let work = || {
                let is_wanted = || !cancel.load(Ordering::Relaxed);
                let reference = reference_of(&subject, &reference, &is_wanted)?;
                let Some(reference) = reference else { return Ok(()) };
                let checked = Checked::new(&subject, &reference)?;
                checked.run(&cancel, &|findings| send(Ok(findings)));
                Ok(())
            };
            match caught(work) {
                Ok(Ok(())) => {}
                Ok(Err(sentence)) => send(Err(sentence)),
                Err(accident) => send(Err(format!(
                    "The oracle failed by a mistake in oktant ({accident}); please report it, with the scene's files."
                ))),
            }
        });
    }

    /// Whether all pixels are compared, or cannot be.
    fn is_done(&self) -> bool {
        self.failure.is_some() || self.findings.as_ref().is_some_and(|findings| findings.is_complete())
    }
}

/// The scene in f64: the one that is there, or read anew. None where it is not wanted any more.
fn reference_of(
    subject: &Subject,
    known: &Mutex<Option<Known>>,
    is_wanted: &dyn Fn() -> bool,
) -> Result<Option<Arc<Reference>>, String> {
    let mut known = known.lock().unwrap_or_else(PoisonError::into_inner);
    if !is_wanted() {
        return Ok(None);
    }
    if let Some((scene, reference)) = &*known
        && scene.as_ptr() == Arc::as_ptr(&subject.scene)
    {
        return Ok(Some(reference.clone()));
    }
    // One at a time.
    *known = None;
    let setting = subject.source.load(&crate::progress::silent);
    let setting = setting.map_err(|error| error.to_string())?;
    let mut model = setting.model;
    Staging::of(&subject.scene).put_on(&mut model);
    let reference = Reference::new(Arc::new(model)).map_err(|error| error.to_string())?;
    let reference = Arc::new(reference);
    *known = Some((Arc::downgrade(&subject.scene), reference.clone()));
    Ok(is_wanted().then_some(reference))
}

impl Application {
    /// Begins to compare the picture that is shown, if that is wanted and it is finished; stops what is out of date.
    pub(super) fn compare(&mut self) {
        let (Some(scene), Some(image)) = (&self.scene, &self.image) else {
            return;
        };
        let view = self.session.view;
        if self.session.oracle && self.comparison.is_of(scene, &view, image) {
            return;
        }
        if self.comparison.subject.is_some() {
            self.comparison.stop();
            self.redraw();
        }
        if !self.session.oracle || !self.schedule.has_final() || !self.session.is_visible() {
            return;
        }
        if let (Some(scene), Some(image)) = (&self.scene, &self.image) {
            let subject = Subject {
                source: self.source.clone(),
                scene: scene.clone(),
                view,
                size: self.session.size,
                image: image.clone(),
                engine: self.engine(),
            };
            self.comparison.start(subject, &self.mailbox);
        }
    }

    /// Takes what was found so far.
    pub(super) fn take_comparison(&mut self, number: u64, result: Result<Arc<Findings>, String>) {
        if self.comparison.subject.is_none() || number != self.comparison.number {
            return;
        }
        match result {
            Ok(findings) => self.comparison.findings = Some(findings),
            Err(sentence) => {
                self.comparison.failure = Some(sentence.clone());
                self.tell(sentence, true);
            }
        }
        self.redraw();
    }

    /// What was found of the picture that is shown, as far as it is.
    pub(super) fn findings(&self) -> Option<&Arc<Findings>> {
        self.comparison.findings.as_ref().filter(|_| self.session.oracle)
    }

    /// Whether nothing is to be compared any more.
    pub(super) fn is_compared(&self) -> bool {
        !self.session.oracle || self.comparison.is_done()
    }

    /// The panel that says what the colours mean.
    pub(super) fn oracle_legend(&self) -> Vec<Line> {
        let line = |text: String, tone| Line { text, tone };
        let Some(findings) = self.findings() else {
            let text = match &self.comparison {
                Comparison { failure: Some(_), .. } => "oracle: this picture could not be compared",
                Comparison { subject: Some(_), .. } => "oracle: begins to compare",
                _ => "oracle: waits for the finished picture",
            };
            return vec![line(text.into(), Tone::Strong)];
        };
        let compared = findings.compared();
        let percent = 100 * compared / findings.pixels.len().max(1);
        let mut lines = vec![line(
            format!(
                "oracle (double precision): {} pixels compared, {percent} %",
                grouped(compared)
            ),
            Tone::Strong,
        )];
        lines.extend(Disagreement::ALL.map(|kind| {
            let count = findings.count(kind);
            line(
                format!("{:>9}  {}", grouped(count), kind.meaning()),
                Tone::Colored(kind.color()),
            )
        }));
        lines
    }
}
