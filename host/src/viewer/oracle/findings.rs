//! In what pixels disagree with the oracle.

/// In what a pixel and the oracle's disagree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Disagreement {
    /// Another triangle or plane is seen first.
    Id,
    /// The same one, at another depth.
    Depth,
    /// The first light is hidden by something, or not.
    Shadow,
    /// The colour.
    Color,
}

impl Disagreement {
    /// All, what is shown before what.
    pub const ALL: [Disagreement; 4] = [
        Disagreement::Id,
        Disagreement::Depth,
        Disagreement::Shadow,
        Disagreement::Color,
    ];

    /// In a few words.
    pub fn meaning(self) -> &'static str {
        match self {
            Disagreement::Id => "see another triangle",
            Disagreement::Depth => "see it elsewhere, by 1e-5 of its depth",
            Disagreement::Shadow => "have another shadow of the first light",
            Disagreement::Color => "have another colour, by 1 of 255",
        }
    }

    /// What it is called in the step `print`.
    pub fn name(self) -> &'static str {
        match self {
            Disagreement::Id => "id",
            Disagreement::Depth => "t",
            Disagreement::Shadow => "shadow",
            Disagreement::Color => "color",
        }
    }

    /// Red, green and blue of the pixels.
    pub fn color(self) -> [u8; 3] {
        match self {
            Disagreement::Id => [255, 64, 64],
            Disagreement::Depth => [255, 170, 40],
            Disagreement::Shadow => [80, 170, 255],
            Disagreement::Color => [90, 230, 110],
        }
    }

    pub(super) fn bit(self) -> u8 {
        1 << self as u8
    }
}

/// A pixel that is not compared yet.
pub(super) const PENDING: u8 = u8::MAX;

/// What was found so far.
#[derive(Clone, Debug, PartialEq)]
pub struct Findings {
    /// Width and height of the picture.
    pub size: [u32; 2],
    /// For each pixel in what it disagrees, a bit each; all bits where it is not compared yet.
    pub pixels: Vec<u8>,
}

impl Findings {
    /// Nothing is compared yet.
    pub fn new(size: [u32; 2]) -> Self {
        Findings {
            size,
            pixels: vec![PENDING; size[0] as usize * size[1] as usize],
        }
    }

    /// How many pixels are compared.
    pub fn compared(&self) -> usize {
        self.pixels.iter().filter(|pixel| **pixel != PENDING).count()
    }

    /// Whether all are.
    pub fn is_complete(&self) -> bool {
        !self.pixels.contains(&PENDING)
    }

    /// How many of them disagree in something.
    pub fn count(&self, kind: Disagreement) -> usize {
        let disagrees = |pixel: &&u8| **pixel != PENDING && **pixel & kind.bit() != 0;
        self.pixels.iter().filter(disagrees).count()
    }
}
