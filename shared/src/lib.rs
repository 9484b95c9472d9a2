//! Octree, triangle, traversal and shading of oktant.
//!
//! One source: rust-gpu compiles it to SPIR-V for the GPU kernel, rustc compiles it natively for the CPU back end and
//! its tests.
#![no_std]

pub mod ray;
