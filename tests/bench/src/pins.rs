//! How many rays everyone gets wrong, written down.

use crate::report::{ContestantReport, CourseReport};
use oktant::output::TextFile;
use std::collections::BTreeMap;
use std::error::Error;
use std::fs;
use std::io;
use std::path::Path;

/// What is written down, part of the program.
const WRITTEN: &str = include_str!("../wrong.toml");

/// What the file begins with.
const TITLE: &str = "\
# How many rays each contestant misses, of how many it hits what is not there, of how many its t is off by more than
# 10^-5, by input and set of rays; sets that are not listed are all right. Some libraries round otherwise where they are
# compiled for processors with fused multiply-add. Embree's are those of processors with AVX2.
# `oktant-bench-peers bunny balls --size 320x242 --repeat 0 --bless wrong.toml` writes it.
";

/// Some libraries round otherwise where they are compiled for processors with fused multiply-add.
const BUILD: &str = if cfg!(target_feature = "fma") {
    ", fused multiply-add"
} else {
    ""
};

/// Counts of missed, false and wrong `t` by set; without sets that are all right.
type Counts = BTreeMap<String, [usize; 3]>;

/// Counts by contestant, by input: mesh, size and what the program is compiled for.
#[derive(Debug, PartialEq)]
pub struct Pins(BTreeMap<String, BTreeMap<String, Counts>>);

impl Pins {
    /// Those that are part of the program.
    ///
    /// # Errors
    /// Where the file has been edited into something else.
    pub fn written() -> Result<Self, toml::de::Error> {
        toml::from_str(WRITTEN).map(Pins)
    }

    /// Everything in which what came of a mesh differs from what is written down, a sentence each; nothing of meshes and
    /// sizes that are not there.
    pub fn differences(&self, size: [u32; 2], told: &CourseReport) -> Vec<String> {
        let input = input(size, told);
        let Some(of_input) = self.0.get(&input) else {
            return Vec::new();
        };
        let difference = |one: &ContestantReport| match of_input.get(one.name) {
            None => Some(format!(
                "{}: nothing is written down of {input}; give --bless.",
                one.name
            )),
            Some(written) => {
                let counted = counts(one);
                (*written != counted).then(|| {
                    format!(
                        "{}: of {input} it was wrong about {written:?} (missed, false, t off), now about {counted:?}; find \
                         out why, or give --bless.",
                        one.name
                    )
                })
            }
        };
        told.contestants.iter().filter_map(difference).collect()
    }

    /// Writes down what came of some meshes in the place of what a file has of them; of who did not take part it stays.
    ///
    /// # Errors
    /// Where the file is no such file or cannot be written.
    pub fn bless(path: &Path, size: [u32; 2], told: &[CourseReport]) -> Result<(), Box<dyn Error>> {
        let mut pins = match fs::read_to_string(path) {
            Ok(text) => toml::from_str(&text).map(Pins)?,
            Err(error) if error.kind() == io::ErrorKind::NotFound => Pins(BTreeMap::new()),
            Err(error) => return Err(error.into()),
        };
        for course in told {
            let of_input = pins.0.entry(input(size, course)).or_default();
            of_input.extend(course.contestants.iter().map(|one| (one.name.to_owned(), counts(one))));
        }
        let text = format!("{TITLE}\n{}", toml::to_string(&pins.0)?);
        Ok(TextFile::create(path)?.save(&text)?)
    }
}

fn input([width, height]: [u32; 2], told: &CourseReport) -> String {
    format!("{} {width}x{height}{BUILD}", told.name)
}

fn counts(one: &ContestantReport) -> Counts {
    let sets = one.sets.iter().filter(|set| set.judgement.disagreeing() > 0);
    sets.map(|set| {
        let judged = &set.judgement;
        (set.set.to_owned(), [judged.missed, judged.phantom, judged.wrong_t])
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::SetReport;
    use oktant::bench::Judgement;

    /// A report of one who missed so many of 9 rays.
    fn told(name: &str, contestant: &'static str, missed: usize) -> CourseReport {
        CourseReport {
            name: name.to_owned(),
            triangles: 1,
            conditions: Vec::new(),
            contestants: vec![ContestantReport {
                name: contestant,
                is_ours: false,
                twin_of: None,
                build_milliseconds: Vec::new(),
                bytes_per_triangle: None,
                sets: vec![SetReport {
                    set: "R1",
                    rays: 9,
                    mrays_per_second: Vec::new(),
                    judgement: Judgement {
                        rays: 9,
                        missed,
                        ..Judgement::default()
                    },
                }],
            }],
        }
    }

    fn read(path: &Path) -> Pins {
        toml::from_str(&fs::read_to_string(path).unwrap()).map(Pins).unwrap()
    }

    #[test]
    fn a_changed_count_is_told_until_it_is_blessed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("wrong.toml");
        let size = [4, 3];
        Pins::bless(&path, size, &[told("a", "x", 1), told("b", "x", 0)]).unwrap();
        Pins::bless(&path, size, &[told("a", "y", 2)]).unwrap();
        let pins = read(&path);
        assert!(pins.differences(size, &told("a", "x", 1)).is_empty());
        assert!(pins.differences(size, &told("a", "y", 2)).is_empty());
        for missed in [0, 2] {
            assert_eq!(pins.differences(size, &told("a", "x", missed)).len(), 1);
        }
        assert_eq!(pins.differences(size, &told("a", "z", 0)).len(), 1);
        assert!(pins.differences([8, 6], &told("a", "x", 5)).is_empty());
        assert!(pins.differences(size, &told("c", "x", 5)).is_empty());
        Pins::bless(&path, size, &[told("a", "x", 2)]).unwrap();
        assert!(read(&path).differences(size, &told("a", "x", 2)).is_empty());
    }

    #[test]
    fn what_is_written_can_be_read() {
        let Pins(inputs) = Pins::written().unwrap();
        for input in ["bunny 320x242", "balls 320x242"] {
            for build in ["", ", fused multiply-add"] {
                assert!(
                    inputs[&format!("{input}{build}")].contains_key("oktant balanced"),
                    "{input}{build}"
                );
            }
        }
    }
}
