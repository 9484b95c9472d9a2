//! The committed kernel: it belongs to its sources, its manifest describes it, and naga understands it.

#![cfg(test)]

use std::fs;
use std::path::{Path, PathBuf};

use naga::ShaderStage;
use naga::front::spv;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use oktant_kernel_builder::{EntryPoint, Error, MANIFEST_FILE, Manifest, entry_points, sha256, source_hash};
use tempfile::TempDir;

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The crates that are compiled to SPIR-V, and where.
const CRATES: [[&str; 2]; 4] = [
    ["kernel", "kernel/compiled"],
    ["kernel/lists", "kernel/compiled/lists"],
    ["kernel/parts", "kernel/compiled/parts"],
    ["kernel/probes", "kernel/compiled/probes"],
];

fn committed(folder: &str) -> (Manifest, Vec<u8>) {
    let dir = workspace().join(folder);
    let manifest = Manifest::read(&dir.join(MANIFEST_FILE)).unwrap_or_else(|error| panic!("{error}"));
    let module = fs::read(dir.join(&manifest.file)).unwrap();
    (manifest, module)
}

#[test]
fn module_belongs_to_its_sources() {
    for [kernel, folder] in CRATES {
        let (manifest, _) = committed(folder);
        manifest
            .check_sources(&workspace().join(kernel))
            .unwrap_or_else(|error| panic!("{kernel}: {error}"));
    }
}

#[test]
fn manifest_describes_the_module() {
    for [kernel, folder] in CRATES {
        let (manifest, module) = committed(folder);
        assert_eq!(manifest.sha256, sha256(&module));
        manifest
            .check_module(&module)
            .unwrap_or_else(|error| panic!("{kernel}: {error}"));
        assert_eq!(manifest.bindings, oktant_shared::bindings::BINDINGS);
    }
}

#[test]
fn manifest_notices_another_module() {
    let (manifest, module) = committed("kernel/compiled");
    for at in [0, module.len() / 2, module.len() - 1] {
        let mut other = module.clone();
        other[at] ^= 1;
        let error = manifest.check_module(&other).unwrap_err();
        assert!(matches!(error, Error::Stale(_)), "byte {at}: {error}");
    }
    let mut renamed = manifest.clone();
    renamed.entry_points[0].name.push('x');
    let error = renamed.check_module(&module).unwrap_err();
    assert!(matches!(error, Error::Stale(_)), "{error}");
}

#[test]
fn naga_accepts_the_modules() {
    CRATES.into_iter().for_each(|[_, folder]| naga_accepts(folder));
}

fn naga_accepts(folder: &str) {
    let (manifest, module) = committed(folder);
    // As wgpu sets them where the device has no optional feature.
    let options = spv::Options {
        adjust_coordinate_space: false,
        strict_capabilities: true,
        block_ctx_dump_prefix: None,
    };
    let parsed = spv::parse_u8_slice(&module, &options).unwrap();
    Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&parsed)
        .unwrap_or_else(|error| panic!("{}", error.emit_to_string("")));
    let mut found: Vec<EntryPoint> = parsed
        .entry_points
        .iter()
        .map(|entry| {
            let (model, workgroup) = match entry.stage {
                ShaderStage::Compute => ("GLCompute", Some(entry.workgroup_size)),
                ShaderStage::Vertex => ("Vertex", None),
                ShaderStage::Fragment => ("Fragment", None),
                other => panic!("{}: the host launches no {other:?}", entry.name),
            };
            EntryPoint {
                name: entry.name.clone(),
                model: model.into(),
                workgroup,
            }
        })
        .collect();
    found.sort();
    assert_eq!(found, manifest.entry_points);
}

#[test]
fn modules_name_no_folder_of_the_machine_that_compiled_them() {
    for [kernel, folder] in CRATES {
        let (_, module) = committed(folder);
        for part in ["/src/", "/home/", "/root/", ".cargo"] {
            let found = module.windows(part.len()).any(|bytes| bytes == part.as_bytes());
            assert!(!found, "the module of {kernel} contains {part:?}");
        }
    }
}

/// A driver reads a module before it makes a pipeline.
#[test]
fn modules_are_below_a_megabyte() {
    for [kernel, folder] in CRATES {
        let (_, module) = committed(folder);
        assert!(module.len() < 1_000_000, "{kernel}: {} bytes", module.len());
    }
}

#[test]
fn what_is_no_module_is_told_so() {
    for bytes in [b"".as_slice(), b"#version 450", &[3, 2, 35, 7]] {
        let error = entry_points(bytes).unwrap_err();
        assert!(matches!(error, Error::Module(_)), "{error}");
    }
}

#[test]
fn a_missing_manifest_is_told_with_the_command_that_writes_it() {
    let dir = TempDir::new().unwrap();
    let error = Manifest::read(&dir.path().join(MANIFEST_FILE)).unwrap_err();
    assert!(matches!(error, Error::Stale(_)));
    let sentence = error.to_string();
    assert!(
        sentence.contains("cargo run --release -p oktant-kernel-builder"),
        "{sentence}"
    );
}

#[test]
fn writing_leaves_the_two_files_and_nothing_else() {
    let (manifest, module) = committed("kernel/compiled");
    let dir = TempDir::new().unwrap();
    let out = dir.path().join("new/folder");
    // The second time finds both files there.
    for _ in 0..2 {
        manifest.write(&module, &out).unwrap();
        assert_eq!(Manifest::read(&out.join(MANIFEST_FILE)).unwrap(), manifest);
        assert_eq!(fs::read(out.join(&manifest.file)).unwrap(), module);
        assert_eq!(fs::read_dir(&out).unwrap().count(), 2);
    }
}

/// A copy of everything that the hash of the sources reads, in another folder.
struct Copy(TempDir);

impl Copy {
    fn new() -> Self {
        let copy = Copy(TempDir::new().unwrap());
        for file in ["Cargo.toml", "Cargo.lock"] {
            fs::copy(workspace().join(file), copy.path(file)).unwrap();
        }
        for package in ["kernel", "shared"] {
            let manifest = format!("{package}/Cargo.toml");
            copy_tree(&workspace().join(package).join("src"), &copy.path(package).join("src"));
            fs::copy(workspace().join(&manifest), copy.path(&manifest)).unwrap();
        }
        copy
    }

    fn path(&self, relative: &str) -> PathBuf {
        self.0.path().join(relative)
    }

    fn hash(&self) -> Result<String, Error> {
        source_hash(&self.path("kernel"))
    }

    /// Every file that counts in full, by its path.
    fn files(&self) -> Vec<PathBuf> {
        let mut found = vec![self.path("kernel/Cargo.toml"), self.path("shared/Cargo.toml")];
        let mut folders = vec![self.path("kernel/src"), self.path("shared/src")];
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() {
                    folders.push(path);
                } else if !path.ends_with("tests.rs") {
                    found.push(path);
                }
            }
        }
        found
    }

    fn edit(&self, file: &str, from: &str, to: &str) {
        let path = self.path(file);
        let text = fs::read_to_string(&path).unwrap();
        assert!(text.contains(from), "{file} has no {from:?}");
        fs::write(path, text.replacen(from, to, 1)).unwrap();
    }
}

fn copy_tree(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() {
            copy_tree(&path, &target);
        } else {
            fs::copy(&path, target).unwrap();
        }
    }
}

#[test]
fn hash_is_the_same_in_another_folder_and_with_other_line_endings() {
    let copy = Copy::new();
    let original = source_hash(&workspace().join("kernel")).unwrap();
    assert_eq!(copy.hash().unwrap(), original);
    let mut files = copy.files();
    files.extend([copy.path("Cargo.toml"), copy.path("Cargo.lock")]);
    for path in files {
        let text = fs::read_to_string(&path).unwrap();
        fs::write(&path, text.replace('\n', "\r\n")).unwrap();
    }
    assert_eq!(copy.hash().unwrap(), original);
    for ignored in [".lib.rs.swp", "tests.rs"] {
        fs::write(copy.path("shared/src").join(ignored), "x").unwrap();
        assert_eq!(copy.hash().unwrap(), original, "{ignored}");
    }
}

#[test]
fn hash_changes_with_any_byte_of_the_sources() {
    let copy = Copy::new();
    let original = copy.hash().unwrap();
    for path in copy.files() {
        let bytes = fs::read(&path).unwrap();
        for at in (0..bytes.len()).step_by(bytes.len().div_ceil(8)) {
            let mut other = bytes.clone();
            other[at] ^= 1;
            fs::write(&path, other).unwrap();
            // A Cargo.toml may no longer be one, which is noticed as well.
            assert_ne!(
                copy.hash().ok().as_ref(),
                Some(&original),
                "byte {at} of {}",
                path.display()
            );
        }
        fs::write(&path, bytes).unwrap();
    }
    assert_eq!(copy.hash().unwrap(), original);
}

#[test]
fn hash_changes_with_the_set_of_files() {
    let copy = Copy::new();
    let original = copy.hash().unwrap();
    let added = copy.path("shared/src/deeper/added.rs");
    fs::create_dir(added.parent().unwrap()).unwrap();
    fs::write(&added, "").unwrap();
    let with_file = copy.hash().unwrap();
    assert_ne!(with_file, original);
    fs::rename(&added, added.with_file_name("renamed.rs")).unwrap();
    let with_renamed = copy.hash().unwrap();
    assert_ne!(with_renamed, original);
    assert_ne!(with_renamed, with_file);
}

#[test]
fn hash_follows_the_dependencies_of_the_kernel_and_no_others() {
    let changed = |file: &str, from: &str, to: &str| {
        let copy = Copy::new();
        let original = copy.hash().unwrap();
        copy.edit(file, from, to);
        copy.hash().unwrap() != original
    };
    let locked = |name: &str| {
        let lock = fs::read_to_string(workspace().join("Cargo.lock")).unwrap();
        let start = lock.find(&format!("name = \"{name}\"\n")).unwrap();
        let end = start + lock[start..].find("checksum = \"").unwrap() + 14;
        lock[start..end].to_owned()
    };
    for name in ["glam", "bytemuck", "spirv-std", "num-traits", "libm"] {
        let entry = locked(name);
        assert!(changed("Cargo.lock", &entry, &format!("{entry}0")), "{name}");
    }
    for name in ["wgpu", "clap", "rayon", "serde"] {
        let entry = locked(name);
        assert!(!changed("Cargo.lock", &entry, &format!("{entry}0")), "{name}");
    }
    assert!(changed("Cargo.toml", "edition = \"2024\"", "edition = \"2021\""));
    assert!(changed("Cargo.toml", "glam = {", "glam = { optional = false,"));
    assert!(!changed("Cargo.toml", "rayon = \"", "rayon = \"1."));
    let lints = "[workspace.lints.rust]";
    let profile = format!("[profile.release]\ncodegen-units = 4\n\n{lints}");
    assert!(!changed("Cargo.toml", lints, &profile), "how the host is compiled");
}
