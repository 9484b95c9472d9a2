//! What the work of rays costs on a device, in a file.

use crate::costs::Costs;
use serde::Deserialize;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// The version of the files that are read and written.
const VERSION: u32 = 1;
/// No profile is longer, bytes.
const LONGEST: u64 = 1 << 16;

/// What a step and a triangle test cost on a device, nanoseconds of its time for each ray.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Profile {
    version: u32,
    /// The device, for people.
    pub device: String,
    /// Of the tree of boxes in the slots of octants.
    pub octants: Costs,
    /// Of the octree of Revelles.
    pub octree: Costs,
}

/// The part of a profile that is the same in all versions.
#[derive(Deserialize)]
struct Versioned {
    version: u32,
}

/// Why a file is no profile.
#[derive(Debug, thiserror::Error)]
pub enum ProfileError {
    /// It cannot be read.
    #[error("{} cannot be read ({source}); give a file that `oktant tune` wrote.", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// It is no TOML file, or lacks something, or has something else.
    #[error("{path} is no profile ({reason}); write it anew with `oktant tune -o {path}`.")]
    Malformed {
        /// The file.
        path: String,
        /// What is wrong.
        reason: String,
    },
}

impl Profile {
    /// What was measured on a device.
    pub fn new(device: String, octants: Costs, octree: Costs) -> Self {
        Profile {
            version: VERSION,
            device,
            octants,
            octree,
        }
    }

    /// Reads a file.
    ///
    /// # Errors
    /// [`ProfileError`].
    pub fn read(path: &Path) -> Result<Self, ProfileError> {
        let mut text = String::new();
        File::open(path)
            .and_then(|file| file.take(LONGEST).read_to_string(&mut text))
            .map_err(|source| ProfileError::Io {
                path: path.into(),
                source,
            })?;
        Self::parse(&text).map_err(|reason| ProfileError::Malformed {
            path: path.display().to_string(),
            reason,
        })
    }

    /// Reads a text; what is wrong with it else.
    fn parse(text: &str) -> Result<Self, String> {
        let told = |error: toml::de::Error| {
            let line = error
                .span()
                .map(|span| text[..span.start.min(text.len())].matches('\n').count() + 1);
            let message = error.message().lines().collect::<Vec<_>>().join(" ");
            line.map_or(message.clone(), |line| format!("line {line}: {message}"))
        };
        let Versioned { version } = toml::from_str(text).map_err(told)?;
        if version != VERSION {
            return Err(format!("its version is {version}, and this program reads {VERSION}"));
        }
        let profile: Profile = toml::from_str(text).map_err(told)?;
        for (name, costs) in [("octants", profile.octants), ("octree", profile.octree)] {
            for (part, cost) in [("node", costs.node), ("triangle", costs.triangle)] {
                if !(cost > 0.0 && cost <= 1e9) {
                    return Err(format!(
                        "{part} of {name} is {cost} instead of a number of nanoseconds above 0"
                    ));
                }
            }
        }
        Ok(profile)
    }

    /// The text of its file.
    pub fn text(&self) -> String {
        let device = toml::Value::String(self.device.clone());
        let table = |name: &str, costs: &Costs| {
            format!(
                "\n[{name}]\nnode = {:.4}\ntriangle = {:.4}\n",
                costs.node, costs.triangle
            )
        };
        format!(
            "# What a step of a traversal and a test of a triangle cost a ray, nanoseconds, as `oktant tune` measured it.\n\
             version = {}\ndevice = {device}\n{}{}",
            self.version,
            table("octants", &self.octants),
            table("octree", &self.octree),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn profile() -> Profile {
        let costs = |node, triangle| Costs { node, triangle };
        Profile::new("a \"device\"\n\\".into(), costs(12.5, 6.25), costs(1.0, 0.5))
    }

    #[test]
    fn what_is_written_is_read() {
        assert_eq!(Profile::parse(&profile().text()), Ok(profile()));
    }

    #[test]
    fn what_is_wrong_is_said() {
        let text = profile().text();
        for (from, to, said) in [
            (
                "version = 1",
                "version = 2",
                "its version is 2, and this program reads 1",
            ),
            ("version = 1", "", "missing field `version`"),
            ("node = 12.5000", "node = 0", "node of octants is 0 instead of a number"),
            ("node = 12.5000", "node = nan", "node of octants is NaN"),
            // The device's name takes three lines.
            ("node = 12.5000", "node = \"x\"", "line 8: invalid type: string"),
            ("triangle = 0.5000", "triangle = 1e300", "triangle of octree is inf"),
            ("triangle = 0.5000", "", "missing field `triangle`"),
            ("[octree]", "[bvh2]", "unknown field `bvh2`"),
            ("device =", "device", "line 3:"),
        ] {
            let broken = text.replacen(from, to, 1);
            assert_ne!(broken, text, "{from}");
            let reason = Profile::parse(&broken).unwrap_err();
            assert!(reason.contains(said), "{to}: {reason}");
            assert!(!reason.contains('\n'), "{reason}");
        }
        assert!(Profile::parse("").is_err());
    }
}
