//! Meshes made by code to measure tracers with, the same every time: sizes from a thousand to many million triangles.

mod bumpy_ball;
mod detail;
mod knot;
mod room;
mod soup;
mod split;

pub use bumpy_ball::bumpy_ball;
pub use detail::teapot_in_stadium;
pub use knot::knot;
pub use room::{Interior, room};
pub use soup::soup;
pub use split::split;

#[cfg(test)]
mod tests;
