//! Tests of oktant across its crates, and what they share: meshes made by code, classes of rays, the exact reference.

pub mod compare;
pub mod cost;
pub mod data;
pub mod exact;
pub mod images;
pub mod meshes;
pub mod program;
pub mod ray_classes;
pub mod spirv;
pub mod stage;
pub mod subject;
pub mod tally;
