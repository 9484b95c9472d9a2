//! One hash over everything that determines the compiled module.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::fs;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};
use toml::{Table, Value};

use crate::Error;
use crate::module::hex;

/// SHA-256, in hexadecimal digits, of what the module compiled from the crate in `crate_dir` depends on.
///
/// That is, for the crate and every crate it reaches through `path` dependencies: `Cargo.toml` and all files under
/// `src`; from the workspace's `Cargo.toml`: the edition and the entries of `[workspace.dependencies]` that those crates
/// inherit; from `Cargo.lock`: name, version and checksum of every package that they reach. A change of the host or of
/// its dependencies therefore leaves the hash as it is. Line endings count as LF and files are named by package, so the
/// hash is the same in any directory and on any system. Hidden files (editors put them there) do not count.
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
        let package = string_at(&manifest, &["package", "name"]).ok_or_else(|| Error::Malformed {
            path: manifest_path.clone(),
            reason: "it names no package".into(),
        })?;
        if !seen.insert(package.to_owned()) {
            continue;
        }
        let mut outer = BTreeSet::new();
        for (key, dependency) in dependencies(&manifest) {
            let inherited = dependency.get("workspace").and_then(Value::as_bool) == Some(true);
            let (entry, base) = if inherited {
                let entry = workspace.dependency(key)?;
                inputs.insert(format!("workspace.dependencies.{key}"), entry.to_string().into_bytes());
                (entry, workspace.root.as_path())
            } else {
                (dependency, dir.as_path())
            };
            match entry.get("path").and_then(Value::as_str) {
                Some(path) => queue.push_back(base.join(path)),
                None => {
                    outer.insert(entry.get("package").and_then(Value::as_str).unwrap_or(key).to_owned());
                }
            }
        }
        locked.extend(workspace.locked_dependencies(package, &outer)?);
        inputs.insert(format!("{package}/Cargo.toml"), text);
        for (path, content) in files_under(&dir.join("src"))? {
            inputs.insert(format!("{package}/src/{path}"), content);
        }
    }
    inputs.extend(workspace.locked_closure(locked)?);
    if let Some(edition) = string_at(&workspace.manifest, &["workspace", "package", "edition"]) {
        inputs.insert("workspace.package.edition".into(), edition.into());
    }
    Ok(inputs)
}

/// The `Cargo.toml` and the `Cargo.lock` that apply to a crate.
struct Workspace {
    root: PathBuf,
    manifest: Table,
    packages: Vec<Value>,
}

impl Workspace {
    /// The nearest folder at or above `crate_dir` with a `Cargo.lock`.
    fn around(crate_dir: &Path) -> Result<Self, Error> {
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

    fn dependency(&self, key: &str) -> Result<&Value, Error> {
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
    fn locked_dependencies(&self, package: &str, names: &BTreeSet<String>) -> Result<Vec<&str>, Error> {
        let entry = self.locked(package)?;
        Ok(references(entry)
            .filter(|reference| names.contains(reference.split(' ').next().unwrap_or_default()))
            .collect())
    }

    /// Everything reached from `queue`, as one line a package.
    fn locked_closure<'a>(&'a self, mut queue: VecDeque<&'a str>) -> Result<BTreeMap<String, Vec<u8>>, Error> {
        let mut closure = BTreeMap::new();
        while let Some(reference) = queue.pop_front() {
            let entry = self.locked(reference)?;
            let field = |name| entry.get(name).and_then(Value::as_str).unwrap_or_default();
            let key = format!("Cargo.lock {} {} {}", field("name"), field("version"), field("source"));
            if closure.insert(key, field("checksum").into()).is_none() {
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

fn references(entry: &Value) -> impl Iterator<Item = &str> {
    entry
        .get("dependencies")
        .and_then(Value::as_array)
        .into_iter()
        .flatten()
        .filter_map(Value::as_str)
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

fn string_at<'a>(table: &'a Table, path: &[&str]) -> Option<&'a str> {
    let (first, rest) = path.split_first()?;
    rest.iter()
        .try_fold(table.get(*first)?, |value, key| value.get(key))?
        .as_str()
}

/// All files under `dir` by their path below it, written with `/`.
fn files_under(dir: &Path) -> Result<BTreeMap<String, Vec<u8>>, Error> {
    let unreadable = |source| Error::Read {
        path: dir.to_path_buf(),
        source,
    };
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(dir).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if name.starts_with('.') {
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

fn read_lf(path: &Path) -> Result<Vec<u8>, Error> {
    let mut bytes = fs::read(path).map_err(|source| Error::Read {
        path: path.to_path_buf(),
        source,
    })?;
    let mut next = bytes.iter().skip(1).copied().collect::<Vec<_>>().into_iter();
    bytes.retain(|byte| {
        let following = next.next();
        *byte != b'\r' || following != Some(b'\n')
    });
    Ok(bytes)
}

fn parse_toml(path: &Path, text: &[u8]) -> Result<Table, Error> {
    let malformed = |reason: String| Error::Malformed {
        path: path.to_path_buf(),
        reason,
    };
    str::from_utf8(text)
        .map_err(|error| malformed(error.to_string()))?
        .parse()
        .map_err(|error: toml::de::Error| malformed(error.message().to_owned()))
}
