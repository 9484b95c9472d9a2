//! A hand that does anything.

use super::files::FIRST;
use fastrand::Rng;
use oktant::progress::silent;
use oktant::source::Source;
use oktant_shared::parts::TraversalKind;
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// Writes a script of random steps, the same ones for the same seed.
pub struct Hand {
    pub(super) random: Rng,
    /// Where scenes are.
    folder: PathBuf,
    /// The steps, one a line.
    pub script: String,
    /// How many of them are inputs.
    pub inputs: usize,
    /// How many rounds were played since the hand is warm.
    pub(super) rounds: usize,
    /// What is looked at.
    source: Source,
    /// How many lights it has now.
    pub(super) lights: usize,
    /// How many materials.
    pub(super) materials: usize,
    /// What rays are traced through now.
    pub(super) traversal: TraversalKind,
}

impl Hand {
    /// A hand with nothing done but that the first scene was opened; scenes are in the folder.
    pub fn new(seed: u64, folder: &Path) -> Self {
        Hand {
            random: Rng::with_seed(seed),
            folder: folder.into(),
            script: String::new(),
            inputs: 0,
            rounds: 0,
            source: Source::from_path(folder.join(FIRST)),
            lights: 0,
            materials: 0,
            traversal: TraversalKind::default(),
        }
    }

    /// Adds an input.
    pub(super) fn does(&mut self, step: impl Display) {
        self.waits(step);
        self.inputs += 1;
    }

    /// Adds a step that is none.
    pub fn waits(&mut self, step: impl Display) {
        self.script += &format!("{step}\n");
    }

    /// Waits until all that was asked for is there.
    pub(super) fn settles(&mut self) {
        // The oracle's picture takes longer than a step may.
        self.waits("oracle off");
        self.waits("wait settled");
    }

    pub(super) fn one<'a>(&mut self, all: &[&'a str]) -> &'a str {
        all[self.random.usize(0..all.len())]
    }

    /// A number with three digits.
    pub(super) fn number(&mut self, low: f32, high: f32) -> String {
        format!("{:.3}", low + (high - low) * self.random.f32())
    }

    /// Three of them.
    pub(super) fn three(&mut self, low: f32, high: f32) -> String {
        [(); 3].map(|()| self.number(low, high)).join(",")
    }

    /// Opens a file in place of what is shown.
    pub(super) fn opens(&mut self, name: &str) {
        self.does(format!("open \"{name}\""));
        self.source = Source::from_path(self.folder.join(name));
        self.counts();
    }

    /// Opens a mesh beside what is shown, which is refused where that is a scene file.
    pub(super) fn adds(&mut self, name: &str) {
        self.does(format!("add mesh \"{name}\""));
        if let Ok(source) = self.source.with(vec![self.folder.join(name)]) {
            self.source = source;
            self.counts();
        }
    }

    /// Opens again what was opened last.
    pub(super) fn opens_again(&mut self) {
        self.does("recent 1");
        self.counts();
    }

    /// Lights and materials are as the files have them.
    fn counts(&mut self) {
        let model = self.source.load(&silent).expect("it can be opened").model;
        (self.lights, self.materials) = (model.lights.len(), model.materials.len());
    }
}
