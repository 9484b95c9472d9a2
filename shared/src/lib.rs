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
//!
//! # Trace a ray
//!
//! A structure is an array of nodes; the crate `oktant` builds those of meshes. The simplest is [`brute::Brute`]'s: one node,
//! which says how many triangles there are.
//!
//! ```
//! use glam::{UVec4, Vec3};
//! use oktant_shared::brute::Brute;
//! use oktant_shared::octree::Root;
//! use oktant_shared::ray::Ray;
//! use oktant_shared::scene::Scene;
//! use oktant_shared::traversal::Traversal;
//! use oktant_shared::triangle::Triangle;
//! use oktant_shared::triangle_test::Watertight;
//!
//! let triangles = [Triangle { a: Vec3::ZERO, vertex_a: 0, b: Vec3::X, vertex_b: 1, c: Vec3::Y, vertex_c: 2 }];
//! let scene = Scene {
//!     root: Root { low: Vec3::splat(-1.0), cell: 3.0, high: Vec3::splat(2.0), depth: 0 },
//!     nodes: &[UVec4::new(1, 0, 0, 0)],
//!     references: &[0],
//!     triangles: bytemuck::cast_slice(&triangles),
//!     ids: &[0],
//!     parts: 0,
//! };
//! let hit = Brute::<Watertight>::closest_hit(&scene, &Ray::new(Vec3::new(0.25, 0.5, 2.0), Vec3::NEG_Z));
//! assert_eq!((hit.t, hit.u, hit.v), (2.0, 0.25, 0.5));
//!
//! let miss = Brute::<Watertight>::closest_hit(&scene, &Ray::new(Vec3::new(0.75, 0.5, 2.0), Vec3::NEG_Z));
//! assert!(!miss.is_hit());
//! ```
//!
//! A type of your own that implements [`triangle_test::TriangleTest`] stands in the place of `Watertight`. How to write one,
//! compare it with the standard one and run it on the GPU is on the
//! [first page of `oktant`](../oktant/index.html#write-a-triangle-test-and-run-it-on-the-gpu).
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
pub mod pixels;
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
