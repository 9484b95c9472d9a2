//! Meshes of simple shapes, made by code: y is up, the front looks to +z, triangles face outwards.

mod checkerboard;
mod cuboid;
mod grid;
mod lathe;
mod quad;
mod sphere;
mod stadium;

pub use checkerboard::checkerboard;
pub use cuboid::cuboid;
pub use lathe::{Lathe, lathe};
pub use quad::quad;
pub use sphere::{sphere, sphere_triangles};
pub use stadium::stadium;
