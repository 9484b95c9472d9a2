//! What surrounds a crate: the workspace's `Cargo.toml` and its `Cargo.lock`.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::fs;
use std::path::{Path, PathBuf};

use toml::{Table, Value};

use crate::Error;

/// The version of rust-gpu that the crate in `crate_dir` is written for: that of its spirv-std.
///
/// # Errors
/// [`Error::Read`] or [`Error::Malformed`] where `Cargo.lock` does not tell.
pub fn rust_gpu_version(crate_dir: &Path) -> Result<String, Error> {
    let workspace = Workspace::around(crate_dir)?;
    let entry = workspace.locked("spirv-std")?;
    Ok(field(entry, "version").to_owned())
}

/// The `Cargo.toml` and the `Cargo.lock` that apply to a crate.
pub(crate) struct Workspace {
    pub(crate) root: PathBuf,
    pub(crate) manifest: Table,
    packages: Vec<Value>,
}

impl Workspace {
    /// The nearest folder at or above `crate_dir` with a `Cargo.lock`.
    pub(crate) fn around(crate_dir: &Path) -> Result<Self, Error> {
        let absolute = fs::canonicalize(crate_dir).map_err(|source| Error::Read {
            path: crate_dir.to_path_buf(),
            source,
        })?;
        let root = absolute
            .ancestors()
            .find(|dir| dir.join("Cargo.lock").is_file())
            .ok_or_else(|| Error::Malformed {
                path: crate_dir.join("Cargo.toml"),
                reason: "neither its folder nor one above has a Cargo.lock, which `cargo generate-lockfile` makes"
                    .into(),
            })?
            .to_path_buf();
        let lock_path = root.join("Cargo.lock");
        let mut lock = parse_toml(&lock_path, &read_lf(&lock_path)?)?;
        let Some(Value::Array(packages)) = lock.remove("package") else {
            return Err(Error::Malformed {
                path: lock_path,
                reason: "it lists no packages".into(),
            });
        };
        let manifest_path = root.join("Cargo.toml");
        let manifest = parse_toml(&manifest_path, &read_lf(&manifest_path)?)?;
        Ok(Workspace {
            root,
            manifest,
            packages,
        })
    }

    /// The entry of `[workspace.dependencies]` that a crate inherits as `key`.
    pub(crate) fn dependency(&self, key: &str) -> Result<&Value, Error> {
        self.manifest
            .get("workspace")
            .and_then(|workspace| workspace.get("dependencies")?.get(key))
            .ok_or_else(|| Error::Malformed {
                path: self.root.join("Cargo.toml"),
                reason: format!("[workspace.dependencies] has no {key}"),
            })
    }

    /// What the lock file makes of those dependencies of the local crate `package` that are named in `names`.
    ///
    /// The lock file mixes development dependencies in, which do not reach the module.
    pub(crate) fn locked_dependencies(&self, package: &str, names: &BTreeSet<String>) -> Result<Vec<&str>, Error> {
        let entry = self.locked(package)?;
        Ok(references(entry)
            .filter(|reference| names.contains(reference.split(' ').next().unwrap_or_default()))
            .collect())
    }

    /// Name and checksum of everything reached from `queue`, which is filled by [`Workspace::locked_dependencies`].
    pub(crate) fn locked_closure<'a>(
        &'a self,
        mut queue: VecDeque<&'a str>,
    ) -> Result<BTreeMap<String, Vec<u8>>, Error> {
        let mut closure = BTreeMap::new();
        while let Some(reference) = queue.pop_front() {
            let entry = self.locked(reference)?;
            let [name, version, source, checksum] =
                ["name", "version", "source", "checksum"].map(|name| field(entry, name));
            let key = format!("Cargo.lock {name} {version} {source}");
            if closure.insert(key, checksum.into()).is_none() {
                queue.extend(references(entry));
            }
        }
        Ok(closure)
    }

    /// The lock file's entry for a reference: `name`, `name version` or `name version (source)`, as short as is unique.
    fn locked(&self, reference: &str) -> Result<&Value, Error> {
        let mut parts = reference.splitn(3, ' ');
        let (name, version, source) = (parts.next(), parts.next(), parts.next());
        let source = source.map(|text| text.trim_start_matches('(').trim_end_matches(')'));
        let matches = |entry: &&Value, field: &str, wanted: Option<&str>| {
            wanted.is_none() || entry.get(field).and_then(Value::as_str) == wanted
        };
        self.packages
            .iter()
            .find(|entry| {
                matches(entry, "name", name) && matches(entry, "version", version) && matches(entry, "source", source)
            })
            .ok_or_else(|| Error::Malformed {
                path: self.root.join("Cargo.lock"),
                reason: format!("it has no package {reference}; `cargo metadata` brings it up to date"),
            })
    }
}

fn field<'a>(entry: &'a Value, name: &str) -> &'a str {
    entry.get(name).and_then(Value::as_str).unwrap_or_default()
}

/// The packages that a package in the lock file depends on.
fn references(entry: &Value) -> impl Iterator<Item = &str> {
    entry
        .get("dependencies")
        .and_then(Value::as_array)
        .into_iter()
        .flatten()
        .filter_map(Value::as_str)
}

/// What stands under nested keys, if there is anything.
pub(crate) fn value_at<'a>(table: &'a Table, path: &[&str]) -> Option<&'a Value> {
    let (first, rest) = path.split_first()?;
    rest.iter().try_fold(table.get(*first)?, |value, key| value.get(key))
}

/// A file with its line endings turned into LF.
pub(crate) fn read_lf(path: &Path) -> Result<Vec<u8>, Error> {
    let bytes = fs::read(path).map_err(|source| Error::Read {
        path: path.to_path_buf(),
        source,
    })?;
    let before_lf = |at: usize| bytes.get(at + 1) == Some(&b'\n');
    Ok(bytes
        .iter()
        .enumerate()
        .filter(|(at, byte)| **byte != b'\r' || !before_lf(*at))
        .map(|(_, byte)| *byte)
        .collect())
}

pub(crate) fn parse_toml(path: &Path, text: &[u8]) -> Result<Table, Error> {
    let malformed = |reason: String| Error::Malformed {
        path: path.to_path_buf(),
        reason,
    };
    str::from_utf8(text)
        .map_err(|error| malformed(error.to_string()))?
        .parse()
        .map_err(|error: toml::de::Error| malformed(error.message().to_owned()))
}
