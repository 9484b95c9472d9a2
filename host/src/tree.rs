//! Bounding volume hierarchies: a binary tree of tight boxes, and trees of up to eight children made of it, whose
//! children lie in the slots of octants. Each triangle is in them once.

mod binary;
mod bins;
mod cells;
mod collapse;
mod emission;
mod flatten;
mod items;
mod metrics;
mod morton;
mod octants;
mod pages;
mod place;
mod preset;
mod radix;
mod reinsertion;
mod sah;
mod slots;
mod split;
mod wide;

pub use binary::{BinaryNode, BinaryTree, MAX_BINARY_DEPTH};
pub use cells::CellTree;
pub use collapse::CollapseOptions;
pub use emission::WideArrays;
pub use metrics::{BinaryFigures, WideFigures};
pub use morton::MortonOrder;
pub use pages::zeroed;
pub use slots::Placing;
pub use wide::{MAX_LEAF, WIDTH, WideChild, WideNode, WideTree};

/// What a build spends its time on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum BuildPreset {
    /// The shortest build: sorted Morton codes, octant by octant.
    Fast,
    /// The best tree that a fraction of a second a million triangles allows.
    #[default]
    Balanced,
    /// The best tree known, in seconds.
    Quality,
}

impl BuildPreset {
    /// All of them, the quickest build first.
    pub const ALL: [BuildPreset; 3] = [BuildPreset::Fast, BuildPreset::Balanced, BuildPreset::Quality];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            BuildPreset::Fast => "fast",
            BuildPreset::Balanced => "balanced",
            BuildPreset::Quality => "quality",
        }
    }
}

/// A broken rule of a tree, in words; a bug of whoever made it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("The tree is not valid: {0}. This is a bug; please report it with the mesh.")]
pub struct InvalidTree(pub String);

/// Checks that each of so many triangles has one slot or was left out.
fn each_once(order: &[u32], left_out: u32, triangles: usize) -> Result<(), InvalidTree> {
    if order.len() + left_out as usize != triangles {
        return Err(InvalidTree(format!("it has {} slots", order.len())));
    }
    let mut seen = vec![false; triangles];
    for &id in order {
        match seen.get_mut(id as usize) {
            Some(seen) if !*seen => *seen = true,
            _ => {
                return Err(InvalidTree(format!("triangle {id} is in it twice or not in the mesh")));
            }
        }
    }
    Ok(())
}
