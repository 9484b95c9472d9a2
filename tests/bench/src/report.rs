//! What came of it.

use crate::race::THREADS;
use comfy_table::{CellAlignment, Table, presets};
use oktant::bench::Judgement;
use oktant::spread::Spread;
use serde::Serialize;

/// Everything.
#[derive(Serialize)]
pub struct Report {
    /// Width and height of the pictures whose rays were traced.
    pub size: [u32; 2],
    /// Measurements of each time.
    pub repeats: usize,
    /// Numbers of threads, in the order of the arrays of two.
    pub threads: [usize; 2],
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
    /// From vertices and indices to what can be traced, with one thread and with two.
    pub build_milliseconds: [Option<Spread>; 2],
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
    /// With one thread and with two.
    pub mrays_per_second: [Option<Spread>; 2],
    /// What the oracle says.
    pub judgement: Judgement,
}

impl ContestantReport {
    /// Rays that were missed or hit nothing that is there; and those whose `t` is off.
    pub fn wrong(&self) -> (usize, usize) {
        let of = |count: fn(&Judgement) -> usize| self.sets.iter().map(|set| count(&set.judgement)).sum();
        (of(|one| one.missed + one.phantom), of(|one| one.wrong_t))
    }

    /// Rays of all sets.
    pub fn rays(&self) -> usize {
        self.sets.iter().map(|set| set.rays).sum()
    }
}

impl CourseReport {
    /// Speeds and errors, then how many times as fast the first is as each of the others.
    pub fn tables(&self) -> String {
        let mut text = format!("{}, {} triangles\n", self.name, self.triangles);
        for (place, threads) in THREADS.into_iter().enumerate() {
            let noun = if threads == 1 { "thread" } else { "threads" };
            text += &format!("\nMrays/s, {threads} {noun}\n{}\n", self.speeds(place));
            if let Some(first) = self.contestants.first() {
                text += &format!(
                    "\n{} by the others, {threads} {noun}\n{}\n",
                    first.name,
                    self.ratios(place)
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

    fn speeds(&self, threads: usize) -> Table {
        let names = ["contestant", "build ms", "bytes/tri"].map(String::from).into_iter();
        let wrong = ["missed or false", "t off", "of rays"].map(String::from);
        let mut table = new_table(names.chain(self.sets()).chain(wrong).collect());
        for one in &self.contestants {
            let mut row = vec![one.name.to_owned()];
            row.push(one.build_milliseconds[threads].map_or("-".to_owned(), |time| format!("{:.1}", time.median)));
            row.push(
                one.bytes_per_triangle
                    .map_or("-".to_owned(), |bytes| format!("{bytes:.1}")),
            );
            row.extend(one.sets.iter().map(|set| {
                set.mrays_per_second[threads].map_or("-".to_owned(), |speed| format!("{:.2}", speed.median))
            }));
            let (surfaces, distances) = one.wrong();
            row.extend([surfaces, distances, one.rays()].map(|count| count.to_string()));
            table.add_row(row);
        }
        table
    }

    fn ratios(&self, threads: usize) -> Table {
        let mut table = new_table(["faster than".to_owned()].into_iter().chain(self.sets()).collect());
        let Some((first, others)) = self.contestants.split_first() else {
            return table;
        };
        for other in others {
            let mut row = vec![other.name.to_owned()];
            for (ours, theirs) in first.sets.iter().zip(&other.sets) {
                let both = ours.mrays_per_second[threads].zip(theirs.mrays_per_second[threads]);
                row.push(both.map_or("-".to_owned(), |(ours, theirs)| {
                    format!("{:.2}", ours.median / theirs.median)
                }));
            }
            table.add_row(row);
        }
        table
    }
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
