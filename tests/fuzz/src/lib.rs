//! Meshes and rays that are made of arbitrary bytes, and what must hold of every structure and traversal.

mod chaos;
mod everywhere;
mod grid;

use arbitrary::Arbitrary;
use chaos::Chaos;
use grid::Grid;

/// A mesh and rays.
#[derive(Arbitrary, Debug)]
pub enum Case {
    /// Coordinates are small whole numbers: all traversals agree with the oracle, edges and corners included.
    Grid(Grid),
    /// Coordinates are any f32: nothing panics, hangs or takes more than its share.
    Chaos(Chaos),
}

impl Case {
    /// Checks what must hold.
    ///
    /// # Panics
    /// Where it does not.
    pub fn check(&self) {
        match self {
            Case::Grid(grid) => grid.check(),
            Case::Chaos(chaos) => chaos.check(),
        }
    }
}
