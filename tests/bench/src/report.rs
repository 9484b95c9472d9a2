//! What came of it.

use comfy_table::{CellAlignment, Table, presets};
use oktant::bench::Judgement;
use oktant::spread::Spread;
use serde::Serialize;

/// Everything.
#[derive(Serialize)]
pub struct Report {
    /// What it was measured on.
    pub machine: String,
    /// Of the source that was measured.
    pub commit: String,
    /// What makes it again.
    pub command: String,
    /// Width and height of the pictures whose rays were traced.
    pub size: [u32; 2],
    /// Measurements of each time.
    pub repeats: usize,
    /// Mesh by mesh.
    pub meshes: Vec<CourseReport>,
}

/// What came of a mesh.
#[derive(Serialize)]
pub struct CourseReport {
    /// Its name.
    pub name: String,
    /// Its triangles.
    pub triangles: usize,
    /// What times were taken on, in the order of the lists of times.
    pub conditions: Vec<String>,
    /// Everyone, oktant's default first.
    pub contestants: Vec<ContestantReport>,
}

/// What a contestant did.
#[derive(Serialize)]
pub struct ContestantReport {
    /// Its name.
    pub name: &'static str,
    /// Whether it is oktant.
    pub is_ours: bool,
    /// Of a kernel by hand, the one in Rust that does the same.
    pub twin_of: Option<&'static str>,
    /// From vertices and indices to what can be traced, by condition.
    pub build_milliseconds: Vec<Option<Spread>>,
    /// Bytes that tracing reads, by triangles.
    pub bytes_per_triangle: Option<f64>,
    /// Set by set.
    pub sets: Vec<SetReport>,
}

/// What it did with a set.
#[derive(Serialize)]
pub struct SetReport {
    /// R1 to R4.
    pub set: &'static str,
    /// Its rays.
    pub rays: usize,
    /// By condition.
    pub mrays_per_second: Vec<Option<Spread>>,
    /// What the oracle says.
    pub judgement: Judgement,
}

impl ContestantReport {
    /// Rays that were missed or hit nothing that is there; and those whose `t` is off.
    pub fn wrong(&self) -> (usize, usize) {
        (
            self.judged(|one| one.missed + one.phantom),
            self.judged(|one| one.wrong_t),
        )
    }

    /// How many of both the rounding of f32 can be blamed for.
    pub fn excused(&self) -> usize {
        self.judged(|one| one.excused)
    }

    fn judged(&self, count: fn(&Judgement) -> usize) -> usize {
        self.sets.iter().map(|set| count(&set.judgement)).sum()
    }

    /// Rays of all sets.
    pub fn rays(&self) -> usize {
        self.sets.iter().map(|set| set.rays).sum()
    }
}

impl CourseReport {
    /// Speeds and errors, then how many times as fast the first is as each of the others, and kernels in Rust as their twins.
    pub fn tables(&self) -> String {
        let mut text = format!("{}, {} triangles\n", self.name, self.triangles);
        for (place, condition) in self.conditions.iter().enumerate() {
            text += &format!("\nMrays/s, {condition}\n{}\n", self.speeds(place));
            let has_times = |one: &&ContestantReport| one.sets.iter().any(|set| set.mrays_per_second[place].is_some());
            let Some(first) = self.contestants.first().filter(has_times) else {
                continue;
            };
            text += &format!("\n{} by the others, {condition}\n{}\n", first.name, self.ratios(place));
            if self.twins().next().is_some() {
                text += &format!(
                    "\nin Rust by their twins by hand, {condition}\n{}\n",
                    self.twin_ratios(place)
                );
            }
        }
        text
    }

    fn sets(&self) -> impl Iterator<Item = String> + '_ {
        let first = self.contestants.first();
        first
            .into_iter()
            .flat_map(|first| first.sets.iter().map(|set| set.set.to_owned()))
    }

    fn speeds(&self, condition: usize) -> Table {
        let names = ["contestant", "build ms", "bytes/tri"].map(String::from).into_iter();
        let wrong = ["missed or false", "t off", "excused", "of rays"].map(String::from);
        let mut table = new_table(names.chain(self.sets()).chain(wrong).collect());
        for one in &self.contestants {
            let mut row = vec![one.name.to_owned()];
            row.push(one.build_milliseconds[condition].map_or("-".to_owned(), |time| format!("{:.1}", time.median)));
            row.push(
                one.bytes_per_triangle
                    .map_or("-".to_owned(), |bytes| format!("{bytes:.1}")),
            );
            row.extend(one.sets.iter().map(|set| {
                set.mrays_per_second[condition].map_or("-".to_owned(), |speed| format!("{:.2}", speed.median))
            }));
            let (surfaces, distances) = one.wrong();
            row.extend([surfaces, distances, one.excused(), one.rays()].map(|count| count.to_string()));
            table.add_row(row);
        }
        table
    }

    fn ratios(&self, condition: usize) -> Table {
        let mut table = self.ratio_table("faster than");
        if let Some((first, others)) = self.contestants.split_first() {
            table.add_rows(others.iter().map(|other| ratio_row(first, other, condition)));
        }
        table
    }

    fn twin_ratios(&self, condition: usize) -> Table {
        let mut table = self.ratio_table("twin");
        table.add_rows(self.twins().map(|(one, twin)| ratio_row(one, twin, condition)));
        table
    }

    /// Kernels in Rust, each with its twin.
    fn twins(&self) -> impl Iterator<Item = (&ContestantReport, &ContestantReport)> {
        self.contestants.iter().filter_map(|twin| {
            let one = self.contestants.iter().find(|one| Some(one.name) == twin.twin_of)?;
            Some((one, twin))
        })
    }

    fn ratio_table(&self, title: &str) -> Table {
        new_table([title.to_owned()].into_iter().chain(self.sets()).collect())
    }
}

/// How many times as fast `one` is as `other`, set by set.
fn ratio_row(one: &ContestantReport, other: &ContestantReport, condition: usize) -> Vec<String> {
    let ratio = |(one, other): (&SetReport, &SetReport)| {
        let both = one.mrays_per_second[condition].zip(other.mrays_per_second[condition]);
        both.map_or("-".to_owned(), |(one, other)| {
            format!("{:.2}", one.median / other.median)
        })
    };
    [other.name.to_owned()]
        .into_iter()
        .chain(one.sets.iter().zip(&other.sets).map(ratio))
        .collect()
}

fn new_table(header: Vec<String>) -> Table {
    let mut table = Table::new();
    table.load_style(presets::ASCII_MARKDOWN);
    table.set_header(header);
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}
