//! One file for each library.

mod bvh;
#[cfg(feature = "embree")]
mod embree;
mod obvhs;
mod oktant;
mod parry;

use crate::contestant::Entry;
pub use obvhs::triangles as obvhs_triangles;

/// All of them, ours first.
pub fn entries() -> Vec<Entry> {
    let mut all = oktant::entries();
    all.extend(obvhs::entries());
    all.extend(parry::entries());
    all.extend(bvh::entries());
    #[cfg(feature = "embree")]
    all.extend(embree::entries());
    all
}
