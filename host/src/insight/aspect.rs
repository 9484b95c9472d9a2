//! What can be told of pixels.

use super::palette::Palette;
use clap::ValueEnum;
use oktant_shared::parts::TraversalKind;
use std::fmt;

/// Something that pixels tell of what they see, or of the work that they took.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Aspect {
    /// The unit normals that shade, as colours.
    Normals,
    /// Triangles and planes, each in a colour of its own.
    Ids,
    /// How far the first surface is along the line of sight.
    Depth,
    /// Where on its triangle the ray hits.
    Barycentrics,
    /// Nodes that the camera ray visits; of the octree leaves, of the grid cells.
    Steps,
    /// Triangles that the camera ray is tested against.
    Tests,
    /// The level of the leaf in which the hit was found.
    LeafDepth,
    /// The triangles of that leaf.
    LeafFill,
    /// The leaves that refer to the triangle that is hit.
    References,
    /// Shadow rays of all samples.
    ShadowRays,
    /// Closest-hit rays of all samples that reflections and refractions ask for: all but the camera's own.
    RecursionRays,
    /// Closest-hit and shadow rays of all samples.
    Rays,
}

/// Why an aspect cannot be told.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{aspect} means nothing with {traversal}, {reason}; show something else, or take another traversal.")]
pub struct Meaningless {
    aspect: Aspect,
    traversal: TraversalKind,
    reason: &'static str,
}

impl Aspect {
    /// All of them, in the order in which the window goes through them: first what costs time, last what is seen.
    pub const ALL: [Aspect; 12] = [
        Aspect::Steps,
        Aspect::Tests,
        Aspect::LeafDepth,
        Aspect::LeafFill,
        Aspect::References,
        Aspect::ShadowRays,
        Aspect::RecursionRays,
        Aspect::Rays,
        Aspect::Normals,
        Aspect::Ids,
        Aspect::Depth,
        Aspect::Barycentrics,
    ];

    /// What people call it.
    pub fn name(self) -> &'static str {
        match self {
            Aspect::Normals => "normals",
            Aspect::Ids => "ids",
            Aspect::Depth => "depth",
            Aspect::Barycentrics => "barycentrics",
            Aspect::Steps => "steps",
            Aspect::Tests => "tests",
            Aspect::LeafDepth => "leaf-depth",
            Aspect::LeafFill => "leaf-fill",
            Aspect::References => "references",
            Aspect::ShadowRays => "shadow-rays",
            Aspect::RecursionRays => "recursion-rays",
            Aspect::Rays => "rays",
        }
    }

    /// What it tells, in a few words, with a traversal.
    pub fn meaning(self, traversal: TraversalKind) -> &'static str {
        match self {
            Aspect::Normals => "unit normals that shade: red, green, blue are (x, y, z) from -1 to 1",
            Aspect::Ids => "a colour for each triangle or plane",
            Aspect::Depth => "scene units along the line of sight",
            Aspect::Barycentrics => "weights of the triangle's corners: red, green, blue",
            Aspect::Steps => match traversal {
                TraversalKind::Octree => "leaves that the camera ray visits",
                TraversalKind::Grid => "cells that the camera ray visits",
                _ => "nodes that the camera ray visits",
            },
            Aspect::Tests => "triangles that the camera ray is tested against",
            Aspect::LeafDepth => "level of the leaf where the hit was found",
            Aspect::LeafFill => match traversal {
                TraversalKind::Grid => "triangles in the cell where the hit was found",
                _ => "triangles in the leaf where the hit was found",
            },
            Aspect::References => "leaves that refer to the triangle that is hit",
            Aspect::ShadowRays => "shadow rays of the pixel",
            Aspect::RecursionRays => "rays of the pixel's reflections and refractions",
            Aspect::Rays => "closest-hit and shadow rays of the pixel",
        }
    }

    /// Whether pixels tell a number.
    pub fn is_number(self) -> bool {
        !matches!(self, Aspect::Normals | Aspect::Ids | Aspect::Barycentrics)
    }

    /// Whether it is told of all samples of a pixel, not of its middle.
    pub fn is_of_samples(self) -> bool {
        matches!(self, Aspect::ShadowRays | Aspect::RecursionRays | Aspect::Rays)
    }

    /// The colours of its numbers: one map for what costs time, one for what there is.
    pub fn palette(self) -> Palette {
        match self {
            Aspect::Steps | Aspect::Tests => Palette::Inferno,
            _ if self.is_of_samples() => Palette::Inferno,
            _ => Palette::Viridis,
        }
    }

    /// Makes sure that it means something with a traversal.
    ///
    /// # Errors
    /// [`Meaningless`] where it does not.
    pub fn check(self, traversal: TraversalKind) -> Result<(), Meaningless> {
        let reason = match (self, traversal) {
            (Aspect::Steps, TraversalKind::Brute) => "which visits no nodes",
            (Aspect::LeafDepth | Aspect::LeafFill | Aspect::References, TraversalKind::Brute) => "which has no leaves",
            (Aspect::LeafDepth, TraversalKind::Grid) => "whose cells are all of one level",
            _ => return Ok(()),
        };
        Err(Meaningless {
            aspect: self,
            traversal,
            reason,
        })
    }
}

impl fmt::Display for Aspect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
