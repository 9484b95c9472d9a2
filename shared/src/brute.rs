//! No structure at all.

mod workgroup;

pub use workgroup::{TILE, Tile, Together, Workgroup};

use crate::box_test::KayKajiya;
use crate::buffer::load;
use crate::entered::Entered;
use crate::scene::Scene;
use crate::walk::{self, Along, Range};

/// All triangles in turn, with the triangle test `T`: what every structure has to beat, and to agree with.
///
/// A ray that misses the cube around everything is spared them, and one from afar is traced from shortly before it, as in
/// the structures.
///
/// On the GPU, the rays of a workgroup that are cast as an array read the triangles together (see [`Workgroup`]).
///
/// The only node's first word is the number of triangles.
pub type Brute<T> = Along<Walk, KayKajiya, T>;

/// The only leaf.
pub struct Walk {
    /// False once it was left.
    inside: bool,
}

impl walk::Walk for Walk {
    type Leaf = Range;

    #[inline(always)]
    fn new(_: &Scene<'_>, entered: &Entered) -> Self {
        Walk { inside: entered.inside }
    }

    #[inline(always)]
    fn goes_on(&self) -> bool {
        self.inside
    }

    #[inline(always)]
    fn leaf(&mut self, scene: &Scene<'_>, _: f32) -> Range {
        Range {
            next: 0,
            end: load(scene.nodes, 0).x,
        }
    }

    #[inline(always)]
    fn leave(&mut self, _: f32) {
        self.inside = false;
    }
}
