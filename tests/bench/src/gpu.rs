//! The race on a GPU: oktant's kernels, and others in the same bindings on the same device.

mod arrays;
mod caster;
mod clock;
mod entries;
mod for_naga;
mod race;

pub use entries::GpuEntry;
pub use race::race;
