//! The host of oktant: files, octree, back ends, viewer.

pub mod aov;
pub mod backend;
pub mod balls;
pub mod effort;
pub mod media;
pub mod mesh;
pub mod mesh_source;
pub mod model;
mod nearest;
pub mod octree;
pub mod oracle;
pub mod output;
pub mod picture;
pub mod ply;
pub mod progress;
pub mod sampling;
pub mod scene;
pub mod scene_file;
pub mod seen;
pub mod shapes;
pub mod source;
pub mod stereo;
pub mod tone;
pub mod transform;
pub mod view;
pub mod viewer;
