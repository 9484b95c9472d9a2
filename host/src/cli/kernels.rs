//! `oktant kernels`.

use super::Failure;
use super::arguments::KernelsArguments;
use oktant::backend::gpu::compiled_kernel;
use oktant_shared::parts::{BoxKind, Description, Parts, TraversalKind, TriangleKind};
use serde::Serialize;

/// Everything there is to say.
#[derive(Serialize)]
struct Listing {
    traversals: Vec<Part>,
    triangle_tests: Vec<Part>,
    box_tests: Vec<Part>,
    combinations: Vec<Combination>,
}

/// A part that can be exchanged.
#[derive(Serialize)]
struct Part {
    name: &'static str,
    paper: &'static str,
    cost: &'static str,
    watertight: bool,
}

impl From<Description> for Part {
    fn from(of: Description) -> Self {
        Part {
            name: of.name,
            paper: of.paper,
            cost: of.cost,
            watertight: of.is_watertight,
        }
    }
}

/// Parts that are offered together.
#[derive(Serialize)]
struct Combination {
    traversal: &'static str,
    triangle: &'static str,
    /// None where the traversal does not leave it open.
    #[serde(rename = "box")]
    box_test: Option<&'static str>,
    is_default: bool,
    backends: Vec<&'static str>,
    /// The kernel's entry point for closest hits.
    closest: &'static str,
    /// The kernel's entry point for any hits.
    any: &'static str,
}

impl Listing {
    fn new() -> Self {
        let modules = compiled_kernel();
        let entries: Vec<_> = modules
            .iter()
            .flat_map(|module| &module.manifest.entry_points)
            .collect();
        let is_compiled = |name: &str| entries.iter().any(|entry| entry.name == name);
        let combinations = Parts::OFFERED.iter().filter_map(|parts| {
            let (closest, any) = parts.entry_points()?;
            // Every combination is compiled into the program; the kernel's entry points come from its file.
            let mut backends = vec!["cpu"];
            if is_compiled(closest) && is_compiled(any) {
                backends.push("gpu");
            }
            Some(Combination {
                traversal: parts.traversal.description().name,
                triangle: parts.triangle.description().name,
                box_test: parts
                    .traversal
                    .takes_box_test()
                    .then(|| parts.box_test.description().name),
                is_default: *parts == Parts::default(),
                backends,
                closest,
                any,
            })
        });
        Listing {
            traversals: TraversalKind::ALL
                .iter()
                .map(|kind| kind.description().into())
                .collect(),
            triangle_tests: TriangleKind::ALL.iter().map(|kind| kind.description().into()).collect(),
            box_tests: BoxKind::ALL.iter().map(|kind| kind.description().into()).collect(),
            combinations: combinations.collect(),
        }
    }

    fn text(&self) -> String {
        let parts = [
            ("--traversal", &self.traversals),
            ("--triangle", &self.triangle_tests),
            ("--box", &self.box_tests),
        ];
        let mut text = String::new();
        for (option, parts) in parts {
            let heading = [option, "watertight", "paper", "cost of a node, triangle or box"].map(String::from);
            let rows = parts.iter().map(|part| {
                let watertight = if part.watertight { "yes" } else { "no" };
                [part.name, watertight, part.paper, part.cost].map(String::from)
            });
            text += &aligned(&std::iter::once(heading).chain(rows).collect::<Vec<_>>());
            text.push('\n');
        }
        let heading = ["offered together", "", "", "back ends", "entry points"].map(String::from);
        let rows = self.combinations.iter().map(|of| {
            [
                format!("{}{}", of.traversal, if of.is_default { " (default)" } else { "" }),
                of.triangle.into(),
                of.box_test.unwrap_or("-").into(),
                of.backends.join(", "),
                format!("{} {}", of.closest, of.any),
            ]
        });
        text += &aligned(&std::iter::once(heading).chain(rows).collect::<Vec<_>>());
        text
    }
}

/// Rows with columns as wide as what is in them.
pub fn aligned<const N: usize>(rows: &[[String; N]]) -> String {
    let widths: [usize; N] =
        std::array::from_fn(|column| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0));
    let line = |row: &[String; N]| {
        let cells = row.iter().zip(widths).map(|(cell, width)| format!("{cell:<width$}"));
        format!("{}\n", cells.collect::<Vec<_>>().join("  ").trim_end())
    };
    rows.iter().map(line).collect()
}

pub fn run(arguments: &KernelsArguments) -> Result<(), Failure> {
    let listing = Listing::new();
    let text = if arguments.json {
        format!("{}\n", serde_json::to_string_pretty(&listing)?)
    } else {
        listing.text()
    };
    super::print(&text)
}
