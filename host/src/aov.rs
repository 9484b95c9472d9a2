//! What else a pixel can tell beside its colour ("arbitrary output variables").

use clap::ValueEnum;

/// Something that is known of every pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
pub enum Aov {
    /// How far the first surface is along the line of sight, scene units.
    Depth,
    /// The first surface's unit normal that shades, on the side that is seen, in the scene's axes.
    Normal,
    /// Number of the triangle or plane.
    Id,
    /// Where on the triangle: weights of its corners.
    Barycentrics,
    /// Sum of the samples' weights: how many there are where all count alike.
    Samples,
    /// Closest-hit and shadow rays, and what was cut.
    Rays,
}

impl Aov {
    /// All of them.
    pub const ALL: [Aov; 6] = [
        Aov::Depth,
        Aov::Normal,
        Aov::Id,
        Aov::Barycentrics,
        Aov::Samples,
        Aov::Rays,
    ];

    /// As people call it: on the command line, in names of files and of layers.
    pub fn name(self) -> &'static str {
        match self {
            Aov::Depth => "depth",
            Aov::Normal => "normal",
            Aov::Id => "id",
            Aov::Barycentrics => "barycentrics",
            Aov::Samples => "samples",
            Aov::Rays => "rays",
        }
    }
}
