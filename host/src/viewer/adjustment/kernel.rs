//! What renders and what rays are traced through, under the names of the command line.

use super::value::named;
use crate::backend::BackendChoice;
use crate::structure::StructureOptions;
use crate::tree::BuildPreset;
use crate::viewer::grammar::unknown;
use oktant_shared::parts::{BoxKind, Parts, TraversalKind, TriangleKind};

/// Something about the kernel with its new value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum KernelAdjustment {
    /// The way through the scene.
    Traversal(TraversalKind),
    /// The test of ray against triangle.
    Triangle(TriangleKind),
    /// The test of ray against box.
    Box(BoxKind),
    /// What the build of a tree of boxes spends its time on.
    Build(BuildPreset),
    /// What renders.
    Backend(BackendChoice),
}

/// What may render, by name.
const BACKENDS: [(&str, BackendChoice); 3] = [
    ("auto", BackendChoice::Auto),
    ("cpu", BackendChoice::Cpu),
    ("gpu", BackendChoice::Gpu),
];

impl KernelAdjustment {
    /// The names, as on the command line.
    pub const NAMES: [&str; 5] = ["traversal", "triangle", "box", "build", "backend"];

    /// What a name and a value mean.
    pub fn parse(name: &str, value: &str) -> Result<Self, String> {
        Ok(match name {
            "traversal" => Self::Traversal(named(value, "traversal", TraversalKind::ALL, |kind| kind.to_string())?),
            "triangle" => Self::Triangle(named(value, "triangle test", TriangleKind::ALL, |kind| {
                kind.to_string()
            })?),
            "box" => Self::Box(named(value, "box test", BoxKind::ALL, |kind| kind.to_string())?),
            "build" => Self::Build(named(value, "way to build", &BuildPreset::ALL, |preset| {
                preset.name().into()
            })?),
            "backend" => {
                let (_, choice) = named(value, "back end", &BACKENDS, |(name, _)| name.into())?;
                Self::Backend(choice)
            }
            _ => return Err(unknown(name, "setting of the kernel", &Self::NAMES)),
        })
    }

    /// Gives options the value: of the combinations that are offered with it, the one that changes least else. Says why
    /// there is none.
    pub fn apply(self, options: &mut StructureOptions) -> Result<(), String> {
        let parts = options.parts;
        let nearest = match self {
            Self::Traversal(kind) => least_changed(parts, |offered| offered.traversal == kind),
            Self::Triangle(kind) => least_changed(parts, |offered| {
                offered.traversal == parts.traversal && offered.triangle == kind
            }),
            Self::Box(kind) => least_changed(parts, |offered| {
                offered.traversal == parts.traversal && offered.box_test == kind
            }),
            Self::Build(preset) => {
                options.preset = preset;
                Some(parts)
            }
            Self::Backend(_) => Some(parts),
        };
        options.parts = nearest.ok_or_else(|| {
            let offered = Parts::OFFERED
                .iter()
                .filter(|offered| offered.traversal == parts.traversal);
            let tests: Vec<String> = offered
                .map(|offered| match offered.traversal.takes_box_test() {
                    true => format!("{} and {}", offered.triangle, offered.box_test),
                    false => offered.triangle.to_string(),
                })
                .collect();
            format!(
                "the traversal {} is offered with {}; give one of these",
                parts.traversal,
                tests.join(", ")
            )
        })?;
        Ok(())
    }
}

/// Of the combinations that are offered and fit, the one that has most in common with another.
fn least_changed(parts: Parts, fits: impl Fn(&Parts) -> bool) -> Option<Parts> {
    let common =
        |offered: &Parts| u32::from(offered.triangle == parts.triangle) + u32::from(offered.box_test == parts.box_test);
    // Of equals the first counts: the list begins with what is usual.
    Parts::OFFERED.iter().copied().filter(fits).rev().max_by_key(common)
}

/// The tests of triangles that are offered with a traversal.
pub fn triangle_tests(traversal: TraversalKind) -> Vec<TriangleKind> {
    offered(traversal, |parts| parts.triangle)
}

/// The tests of boxes that are offered with a traversal.
pub fn box_tests(traversal: TraversalKind) -> Vec<BoxKind> {
    offered(traversal, |parts| parts.box_test)
}

fn offered<T: PartialEq>(traversal: TraversalKind, part: impl Fn(&Parts) -> T) -> Vec<T> {
    let mut found = Vec::new();
    for parts in Parts::OFFERED.iter().filter(|parts| parts.traversal == traversal) {
        let part = part(parts);
        if !found.contains(&part) {
            found.push(part);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(options: &mut StructureOptions, name: &str, value: &str) -> Result<(), String> {
        KernelAdjustment::parse(name, value).and_then(|adjustment| adjustment.apply(options))
    }

    #[test]
    fn what_is_set_is_offered() {
        let mut options = StructureOptions::default();
        assert_eq!(set(&mut options, "triangle", "plucker"), Ok(()));
        assert_eq!(set(&mut options, "traversal", "octree"), Ok(()));
        assert_eq!(
            options.parts.triangle,
            TriangleKind::Watertight,
            "the octree has no plucker"
        );
        // Two parts at a time: one alone is not offered.
        assert_eq!(set(&mut options, "triangle", "moller-trumbore"), Ok(()));
        assert_eq!(options.parts.box_test, BoxKind::Williams);
        assert!(options.parts.is_offered());
        let before = options;
        let error = set(&mut options, "triangle", "plucker").unwrap_err();
        assert_eq!(
            error,
            "the traversal octree is offered with watertight and kay-kajiya, moller-trumbore and williams; \
             give one of these"
        );
        assert_eq!(options, before, "what is refused changes nothing");
        assert_eq!(set(&mut options, "build", "fast"), Ok(()));
        assert_eq!(options.preset, BuildPreset::Fast);
        assert!(set(&mut options, "traversal", "bvh").unwrap_err().contains("\"bvh2\""));
        assert!(set(&mut options, "backend", "tpu").is_err());
    }

    #[test]
    fn every_combination_can_be_reached() {
        for wanted in Parts::OFFERED {
            let mut options = StructureOptions::default();
            for (name, value) in [
                ("traversal", wanted.traversal.to_string()),
                ("triangle", wanted.triangle.to_string()),
                ("box", wanted.box_test.to_string()),
            ] {
                assert_eq!(set(&mut options, name, &value), Ok(()), "{wanted}");
                assert!(options.parts.is_offered());
            }
            assert_eq!(options.parts, *wanted);
        }
    }

    #[test]
    fn lists_hold_what_is_offered_once() {
        assert_eq!(box_tests(TraversalKind::Bvh2), [BoxKind::KayKajiya, BoxKind::Williams]);
        assert_eq!(triangle_tests(TraversalKind::Bvh2), [TriangleKind::Watertight]);
        assert_eq!(triangle_tests(TraversalKind::Octants).len(), 4);
    }
}
