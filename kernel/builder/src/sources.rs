//! One hash over everything that determines the compiled module.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::fs;
use std::path::Path;

use sha2::{Digest, Sha256};
use toml::{Table, Value};

use crate::Error;
use crate::module::hex;
use crate::workspace::{Workspace, parse_toml, read_lf, value_at};

/// SHA-256, in hexadecimal digits, of what the module compiled from the crate in `crate_dir` depends on.
///
/// That is, for the crate and every crate it reaches through `path` dependencies: `Cargo.toml` and all files under
/// `src`; from the workspace's `Cargo.toml`: the edition, the profile's exceptions for single packages and the entries
/// of `[workspace.dependencies]` that those crates inherit; from `Cargo.lock`: name, version and checksum of every
/// package that they reach. A change of the host or of its dependencies therefore leaves the hash as it is. Line endings
/// count as LF and files are named by package, so the hash is the same in any directory and on any system. Hidden files
/// (editors put them there) and files named `tests.rs` (rust-gpu never sees them) do not count.
///
/// # Errors
/// [`Error::Read`] for a file that is missing or unreadable, [`Error::Malformed`] for a `Cargo.toml` or `Cargo.lock`
/// that does not describe the crate.
pub fn source_hash(crate_dir: &Path) -> Result<String, Error> {
    let mut hasher = Sha256::new();
    for (name, content) in inputs(crate_dir)? {
        hasher.update(name.as_bytes());
        hasher.update([0]);
        hasher.update((content.len() as u64).to_le_bytes());
        hasher.update(content);
    }
    Ok(hex(&hasher.finalize()))
}

/// Every input by a name that does not depend on where the workspace lies.
fn inputs(crate_dir: &Path) -> Result<BTreeMap<String, Vec<u8>>, Error> {
    let workspace = Workspace::around(crate_dir)?;
    let mut inputs = BTreeMap::new();
    let mut locked = VecDeque::new();
    let mut seen = BTreeSet::new();
    let mut queue = VecDeque::from([crate_dir.to_path_buf()]);
    while let Some(dir) = queue.pop_front() {
        let manifest_path = dir.join("Cargo.toml");
        let text = read_lf(&manifest_path)?;
        let manifest = parse_toml(&manifest_path, &text)?;
        let package = value_at(&manifest, &["package", "name"])
            .and_then(Value::as_str)
            .ok_or_else(|| Error::Malformed {
                path: manifest_path.clone(),
                reason: "it names no package".into(),
            })?;
        if !seen.insert(package.to_owned()) {
            continue;
        }
        let mut packages = BTreeSet::new();
        for (key, own) in dependencies(&manifest) {
            let (entry, base) = if own.get("workspace").is_some() {
                let entry = workspace.dependency(key)?;
                inputs.insert(format!("workspace.dependencies.{key}"), in_order(entry));
                (entry, &workspace.root)
            } else {
                (own, &dir)
            };
            let text = |name| entry.get(name).and_then(Value::as_str);
            match text("path") {
                Some(path) => queue.push_back(base.join(path)),
                None => {
                    packages.insert(text("package").unwrap_or(key).to_owned());
                }
            }
        }
        locked.extend(workspace.locked_dependencies(package, &packages)?);
        inputs.insert(format!("{package}/Cargo.toml"), text);
        for (path, content) in files_under(&dir.join("src"))? {
            inputs.insert(format!("{package}/src/{path}"), content);
        }
    }
    inputs.extend(workspace.locked_closure(locked)?);
    for keys in [["workspace", "package", "edition"], ["profile", "release", "package"]] {
        if let Some(value) = value_at(&workspace.manifest, &keys) {
            inputs.insert(keys.join("."), value.to_string().into());
        }
    }
    Ok(inputs)
}

/// Normal and build dependencies, for any target.
fn dependencies(manifest: &Table) -> impl Iterator<Item = (&String, &Value)> {
    let targets = manifest.get("target").and_then(Value::as_table).into_iter().flatten();
    let tables = targets.filter_map(|(_, target)| target.as_table()).chain([manifest]);
    tables
        .flat_map(|table| [table.get("dependencies"), table.get("build-dependencies")])
        .flatten()
        .filter_map(Value::as_table)
        .flatten()
}

/// A dependency as text that does not depend on the order in which its keys are written.
fn in_order(entry: &Value) -> Vec<u8> {
    let sorted: BTreeMap<_, _> = entry.as_table().into_iter().flatten().collect();
    match entry.as_str() {
        Some(version) => version.into(),
        None => format!("{sorted:?}").into(),
    }
}

/// All files under `dir` that count, by their path below it, written with `/`.
fn files_under(dir: &Path) -> Result<BTreeMap<String, Vec<u8>>, Error> {
    let unreadable = |source| Error::Read {
        path: dir.to_path_buf(),
        source,
    };
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(dir).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if name.starts_with('.') || name == "tests.rs" {
            continue;
        }
        if path.is_dir() {
            for (below, content) in files_under(&path)? {
                files.insert(format!("{name}/{below}"), content);
            }
        } else {
            files.insert(name, read_lf(&path)?);
        }
    }
    Ok(files)
}
