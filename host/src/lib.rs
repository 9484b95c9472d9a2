//! The host of oktant: files, octree, back ends, viewer.

pub mod mesh;
pub mod ply;
pub mod progress;
