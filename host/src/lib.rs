//! The host of oktant: files, octree, back ends, viewer.

pub mod backend;
pub mod balls;
pub mod mesh;
pub mod octree;
pub mod picture;
pub mod progress;
pub mod scene;
pub mod view;
