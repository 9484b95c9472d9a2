//! The host of oktant: files, structures, back ends, viewer.
//!
//! A mesh or a scene file becomes a [`Model`](model::Model), that a [`Scene`](scene::Scene) of arrays, and a
//! [`View`](view::View) of it a frame, which a [`Backend`](backend::Backend) renders: the CPU, or a GPU. What happens to a
//! ray is in [`oktant_shared`], for both.
//!
//! # Render a picture
//!
//! ```
//! use oktant::backend::Backend;
//! use oktant::backend::cpu::Cpu;
//! use oktant::mesh_source::MeshSource;
//! use oktant::output::PictureFile;
//! use oktant::progress::silent;
//! use oktant::scene::Scene;
//! use oktant::structure::StructureOptions;
//! use oktant::view::View;
//! use std::sync::Arc;
//!
//! # let folder = tempfile::tempdir()?;
//! let mesh = MeshSource::Bunny.load(&silent)?;
//! let scene = Arc::new(Scene::new(&mesh, &StructureOptions::default(), &silent)?);
//! let mut view = View::default();
//! view.camera.azimuth = 30.0;
//! let frame = view.frame(&scene, 160, 121);
//! let picture = Cpu::new(scene).render(&frame, &silent)?;
//! PictureFile::create(&folder.path().join("bunny.png"))?.save(&picture, &view.tone)?;
//! # assert!(folder.path().join("bunny.png").exists());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`GpuBackend`](backend::gpu::GpuBackend) takes the place of [`Cpu`](backend::cpu::Cpu), and
//! [`Source::load`](source::Source::load) reads a scene file with its materials, lights and view.
//!
//! # Trace a ray, and ask who is right
//!
//! The [oracle](oracle::Oracle) decides in double precision, with none of the code that traced the ray.
//!
//! ```
//! use glam::Vec3;
//! use oktant::backend::cpu::Cpu;
//! use oktant::backend::{Backend, Query};
//! use oktant::mesh_source::MeshSource;
//! use oktant::oracle::{Oracle, OracleRay};
//! use oktant::progress::silent;
//! use oktant::scene::Scene;
//! use oktant::structure::StructureOptions;
//! use oktant_shared::ray::Ray;
//! use std::sync::Arc;
//!
//! let mesh = MeshSource::Bunny.load(&silent)?;
//! let options = StructureOptions::default();
//! let scene = Arc::new(Scene::new(&mesh, &options, &silent)?);
//! let ray = Ray::new(Vec3::new(-0.02, 0.1, 1.0), Vec3::NEG_Z);
//!
//! let hits = Cpu::new(scene).cast(options.parts, Query::Closest, &[ray])?;
//! let right = Oracle::new(&mesh).closest(&OracleRay::new(ray.origin, ray.direction, ray.t_min, ray.t_max));
//!
//! let right = right.expect("the bunny is in the way");
//! assert_eq!(hits[0].triangle, right.triangle);
//! assert!((f64::from(hits[0].t) - right.t).abs() < 1e-6 * right.t);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Write a triangle test, and run it on the GPU
//!
//! Any type that implements [`TriangleTest`](oktant_shared::triangle_test::TriangleTest) goes through a structure in the place
//! of the [watertight test](oktant_shared::triangle_test::Watertight): `prepare` is called once for each ray, `crossing` for
//! each triangle that it may meet. This one is Moller and Trumbore's with its division put off; it is compared with the
//! standard test, which no ray can slip through, on a grid of rays through the bunny:
//!
//! ```
//! use glam::Vec3;
//! use oktant::mesh_source::MeshSource;
//! use oktant::progress::silent;
//! use oktant::scene::Scene;
//! use oktant::structure::StructureOptions;
//! use oktant_shared::octants::Octants;
//! use oktant_shared::ray::{PreparedRay, Ray};
//! use oktant_shared::traversal::{Standard, Traversal};
//! use oktant_shared::triangle::Triangle;
//! use oktant_shared::triangle_test::{Crossing, TriangleTest};
//!
//! /// T. Moller and B. Trumbore, "Fast, minimum storage ray/triangle intersection", JGT 2(1), 1997: the form that divides last.
//! ///
//! /// Barycentric coordinates are compared while they are still multiplied by the determinant, so that a triangle that is
//! /// passed costs no division. Deviations: both sides count, and the determinant is compared with zero, not with an epsilon.
//! /// Not watertight.
//! #[derive(Clone, Copy, Debug)]
//! pub struct Scaled {
//!     origin: Vec3,
//!     direction: Vec3,
//! }
//!
//! impl TriangleTest for Scaled {
//!     #[inline]
//!     fn prepare(ray: &PreparedRay) -> Self {
//!         Scaled {
//!             origin: ray.origin,
//!             direction: ray.direction,
//!         }
//!     }
//!
//!     #[inline]
//!     fn crossing(&self, triangle: &Triangle) -> Crossing {
//!         let edge_ab = triangle.b - triangle.a;
//!         let edge_ac = triangle.c - triangle.a;
//!         let p = self.direction.cross(edge_ac);
//!         let signed = p.dot(edge_ab);
//!         // Seen from behind, everything has the other sign.
//!         let sign = if signed < 0.0 { -1.0 } else { 1.0 };
//!         let determinant = signed * sign;
//!         let to_origin = (self.origin - triangle.a) * sign;
//!         let u = p.dot(to_origin);
//!         let q = to_origin.cross(edge_ab);
//!         let v = q.dot(self.direction);
//!         // False for NaN, and where the reciprocal would overflow.
//!         let crosses = (determinant > f32::MIN_POSITIVE) & (u >= 0.0) & (v >= 0.0) & (u + v <= determinant);
//!         if !crosses {
//!             return Crossing::NONE;
//!         }
//!         let reciprocal = 1.0 / determinant;
//!         Crossing {
//!             crosses,
//!             t: q.dot(edge_ac) * reciprocal,
//!             u: u * reciprocal,
//!             v: v * reciprocal,
//!         }
//!     }
//! }
//!
//! let mesh = MeshSource::Bunny.load(&silent)?;
//! let scene = Scene::new(&mesh, &StructureOptions::default(), &silent)?;
//! let mut hits = 0;
//! for i in 0..10_000 {
//!     let [right, up] = [i % 100, i / 100].map(|step| 0.0015 * step as f32);
//!     let ray = Ray::new(Vec3::new(right - 0.09, up + 0.03, 1.0), Vec3::NEG_Z);
//!     let standard = Standard::closest_hit(&scene.view(), &ray);
//!     assert_eq!(Octants::<Scaled>::closest_hit(&scene.view(), &ray).triangle, standard.triangle);
//!     hits += u32::from(standard.is_hit());
//! }
//! assert!(hits > 5_000);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Kernels are compiled beforehand, so a part that is to run on the GPU is put into `oktant_shared` and its list of parts.
//! `docs/examples/part.patch` does that with the very test above, under the name `scaled`. These lines compile a kernel with it
//! and have it render the bunny; where rustup has no toolchain `rust-gpu`, `--features rustup` behind the second one fetches it.
//!
//! ```text
//! git apply docs/examples/part.patch
//! cargo run --release -p oktant-kernel-builder
//! cargo run --release -- kernels
//! cargo run --release -- render bunny -o bunny.png --triangle scaled --backend gpu
//! ```
//!
//! CI does the same, and compares the picture with the standard test's. `CONTRIBUTING.md` says under "Write a part" what the
//! patch changes, and how a test of your own gets a name; under that it is also in the tests and in the measurements.

mod accident;
pub mod adaptive;
pub mod aov;
pub mod array_file;
pub mod asset;
pub mod backend;
pub mod balls;
pub mod bench;
pub mod binary_mesh;
pub mod build_error;
pub mod camera_path;
pub mod chart;
pub mod compare;
pub mod costs;
pub mod effort;
mod excerpt;
pub mod gathering;
pub mod generated;
pub mod gltf;
pub mod grid;
mod hittable;
pub mod insight;
pub mod media;
pub mod mesh;
pub mod mesh_format;
pub mod mesh_source;
pub mod model;
pub mod names;
mod nearest;
pub mod obj;
pub mod octree;
pub mod oracle;
pub mod output;
pub mod picture;
pub mod ply;
mod polygon;
pub mod preferences;
pub mod profile;
pub mod progress;
pub mod projection;
pub mod ray_sets;
pub mod rays;
pub mod sampling;
pub mod scene;
pub mod scene_file;
pub mod seen;
pub mod settings_file;
pub mod shapes;
mod shift;
pub mod slots;
pub mod source;
pub mod spread;
pub mod stability;
pub mod standpoint;
pub mod stereo;
pub mod stl;
pub mod structure;
mod texels;
pub mod toml_file;
pub mod tone;
pub mod trace;
pub mod transform;
pub mod tree;
pub mod tune;
pub mod view;
pub mod view_file;
pub mod viewer;
mod whole_file;
pub mod wires;
