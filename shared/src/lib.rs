//! Octree, triangle, traversal and shading of oktant.
//!
//! One source: rust-gpu compiles it to SPIR-V for the GPU kernel, rustc compiles it natively for the CPU back end and
//! its tests. Nothing here allocates, recurses or panics, and nothing here knows whether it runs on a GPU, except
//! [`arithmetic`] and [`buffer`], which name the few places where the two sides need different instructions, and
//! [`octants`], which natively has lane operations beside their scalar twins.
//!
//! The parts that can be exchanged are types behind a trait each: [`triangle_test::TriangleTest`],
//! [`box_test::BoxTest`] and [`traversal::Traversal`]. They are put together at compile time, for example
//! `Revelles<KayKajiya, Watertight>`; [`traversal::Standard`] names the combination that oktant uses.
#![no_std]
#![cfg_attr(target_arch = "spirv", feature(asm_experimental_arch))]

// Knows what the processor has.
#[cfg(target_arch = "x86_64")]
extern crate std;

pub mod aabb;
pub mod adaptive;
pub mod arithmetic;
pub mod bindings;
pub mod box_test;
pub mod brute;
pub mod buffer;
pub mod bvh2;
pub mod camera;
pub mod candidate;
pub mod cast;
pub mod color;
pub mod display;
pub mod entered;
pub mod environment;
pub mod frame;
pub mod general;
pub mod grid;
pub mod hit;
pub mod light;
pub mod material;
pub mod medium;
pub mod normal;
pub mod octahedral;
pub mod octants;
pub mod octree;
pub mod optics;
pub mod orbit;
pub mod parts;
pub mod plane;
pub mod present;
pub mod ray;
pub mod render;
pub mod revelles;
pub mod sampling;
pub mod scene;
pub mod secondary_origin;
pub mod shading;
pub mod shadow;
pub mod slabs;
pub mod stereo;
pub mod surface;
pub mod texture;
pub mod tone;
pub mod trace;
pub mod traversal;
pub mod triangle;
pub mod triangle_test;
pub mod variant;
pub mod walk;
pub mod whitted;
