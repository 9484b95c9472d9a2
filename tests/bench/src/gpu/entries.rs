//! Who takes part on a GPU.

use super::arrays::Arrays;
use crate::contestant::Failure;
use obvhs::BvhBuildParams;
use oktant::mesh::Mesh;
use oktant::tree::BuildPreset;
use oktant_shared::parts::TraversalKind;

/// A structure, and the kernels that go through it.
pub struct Structure {
    /// Builds it on all threads.
    pub build: fn(Mesh) -> Result<Arrays, Failure>,
    /// The contestants.
    pub entries: Vec<GpuEntry>,
}

/// A kernel that takes part.
pub struct GpuEntry {
    /// What tables call it.
    pub name: &'static str,
    /// Whether it is ours, and must not miss.
    pub is_ours: bool,
    /// The kernel in Rust that it does the same as.
    pub twin_of: Option<&'static str>,
    /// What runs.
    pub kernel: Kernel,
}

/// Entry points for closest and any hits.
#[derive(Clone, Copy)]
pub enum Kernel {
    /// Of oktant's kernel.
    Oktant([&'static str; 2]),
    /// Modules of their own, SPIR-V, whose entry point is `main`.
    Modules([&'static [u8]; 2]),
}

const OCTANTS: &str = "oktant octants";
const QUALITY: &str = "oktant octants quality";
const BVH2: &str = "oktant bvh2 williams";

macro_rules! modules {
    ($name:literal) => {
        Kernel::Modules([
            include_bytes!(concat!("../../shaders/compiled/closest_", $name, ".spv")),
            include_bytes!(concat!("../../shaders/compiled/any_", $name, ".spv")),
        ])
    };
}

macro_rules! oktant {
    ($parts:literal) => {
        Kernel::Oktant([concat!("closest_", $parts), concat!("any_", $parts)])
    };
}

/// A kernel of oktant's that misses nothing.
fn ours(name: &'static str, kernel: Kernel) -> GpuEntry {
    GpuEntry {
        name,
        is_ours: true,
        twin_of: None,
        kernel,
    }
}

/// The same by hand.
fn twin(name: &'static str, of: &'static str, kernel: Kernel) -> GpuEntry {
    GpuEntry {
        twin_of: Some(of),
        ..ours(name, kernel)
    }
}

fn peer(name: &'static str, kernel: Kernel) -> GpuEntry {
    GpuEntry {
        is_ours: false,
        ..ours(name, kernel)
    }
}

/// All of them, oktant's default first.
pub fn structures() -> Vec<Structure> {
    vec![
        Structure {
            build: |mesh| Arrays::oktant(OCTANTS, mesh, TraversalKind::Octants, BuildPreset::Balanced),
            entries: vec![
                ours(OCTANTS, oktant!("octants_watertight")),
                twin("octants by hand", OCTANTS, modules!("octants_watertight")),
            ],
        },
        Structure {
            build: |mesh| Arrays::oktant(QUALITY, mesh, TraversalKind::Octants, BuildPreset::Quality),
            entries: vec![ours(QUALITY, oktant!("octants_watertight"))],
        },
        Structure {
            build: |mesh| Arrays::oktant(BVH2, mesh, TraversalKind::Bvh2, BuildPreset::Balanced),
            entries: vec![
                ours("oktant bvh2 kay-kajiya", oktant!("bvh2_watertight_kay_kajiya")),
                ours(BVH2, oktant!("bvh2_watertight_williams")),
                twin("bvh2 by hand", BVH2, modules!("bvh2_watertight")),
                peer("bvh2 by hand, moller-trumbore", modules!("bvh2_moller_trumbore")),
            ],
        },
        Structure {
            build: |mesh| Arrays::cwbvh("obvhs cwbvh medium", &mesh, BvhBuildParams::medium_build()),
            entries: vec![peer("obvhs cwbvh medium", modules!("cwbvh_watertight"))],
        },
        Structure {
            build: |mesh| Arrays::cwbvh("obvhs cwbvh very slow", &mesh, BvhBuildParams::very_slow_build()),
            entries: vec![
                peer("obvhs cwbvh very slow", modules!("cwbvh_watertight")),
                peer(
                    "obvhs cwbvh very slow, moller-trumbore",
                    modules!("cwbvh_moller_trumbore"),
                ),
            ],
        },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::for_naga::for_naga;
    use oktant::backend::gpu::compiled_kernel;

    #[test]
    fn entry_points_are_there_and_names_are_different() {
        let modules = compiled_kernel();
        let points = || modules.iter().flat_map(|module| &module.manifest.entry_points);
        let mut names = Vec::new();
        for entry in structures().into_iter().flat_map(|structure| structure.entries) {
            assert!(!names.contains(&entry.name), "{}", entry.name);
            assert!(entry.twin_of.is_none_or(|twin| names.contains(&twin)), "{}", entry.name);
            names.push(entry.name);
            match entry.kernel {
                Kernel::Oktant(wanted) => {
                    for name in wanted {
                        assert!(points().any(|point| point.name == name), "{name}");
                    }
                }
                Kernel::Modules(modules) => assert_ne!(modules[0], modules[1]),
            }
        }
    }

    /// Where a driver does not take SPIR-V, naga translates it.
    #[test]
    fn naga_understands_the_modules() {
        for entry in structures().into_iter().flat_map(|structure| structure.entries) {
            let Kernel::Modules(modules) = entry.kernel else {
                continue;
            };
            for spirv in modules {
                let words = for_naga(&wgpu::util::make_spirv_raw(spirv)).unwrap();
                let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
                let module = naga::front::spv::parse_u8_slice(&bytes, &naga::front::spv::Options::default()).unwrap();
                let is_read = |variable: &naga::GlobalVariable| {
                    let access = naga::StorageAccess::LOAD;
                    variable.space == naga::AddressSpace::Storage { access }
                };
                let read = module.global_variables.iter().filter(|(_, variable)| is_read(variable));
                assert_eq!(read.count(), 4, "nodes, triangles, ids and rays of {}", entry.name);
                let flags = naga::valid::ValidationFlags::all();
                let mut validator = naga::valid::Validator::new(flags, naga::valid::Capabilities::all());
                validator.validate(&module).unwrap();
                assert_eq!(module.entry_points[0].workgroup_size, [64, 1, 1], "{}", entry.name);
            }
        }
    }
}
