//! The reference data: PLY files of all kinds, and large meshes against the clock.

#![cfg(test)]

use oktant_tests::data::reference;
use oktant_tests::program::{Run, run};
use std::collections::BTreeMap;
use std::path::Path;
use std::time::Duration;

/// What must come of a file: the number of triangles, or words of the sentence.
enum Expected {
    Triangles(u32),
    Sentence(&'static [&'static str]),
}

use Expected::{Sentence, Triangles};

/// The files that are known. Of others only what holds for all is checked.
const KNOWN: [(&str, Expected); 23] = [
    ("00_ok_ascii", Triangles(1)),
    ("02_ok_be", Triangles(1)),
    ("04_crlf_header_le", Triangles(1)),
    ("06_empty", Sentence(&["empty"])),
    ("08_no_end_header", Sentence(&["end_header"])),
    ("10_huge_vertex_count", Sentence(&["line 12", "4000000000"])),
    ("12_count_overflow", Sentence(&["line 3"])),
    ("14_trunc_vertices_le", Sentence(&["element vertex 1"])),
    ("16_trunc_ascii", Sentence(&["line 11", "2 of the 3"])),
    ("18_index_neg", Sentence(&["line 13", "vertex -1"])),
    ("20_list_len_neg", Sentence(&["element face 0", "-1 entries"])),
    ("22_huge_float", Sentence(&["line 10", "coordinate x"])),
    ("24_extra_tokens", Triangles(1)),
    ("26_face_before_vertex", Triangles(1)),
    ("28_degenerate_lists", Triangles(1)),
    ("30_utm_double", Triangles(1)),
    ("32_no_comment_prefix", Sentence(&["line 3"])),
    ("34_no_xyz", Sentence(&["vertex", "no number property \"x\""])),
    ("36_tabs", Triangles(1)),
    ("38_bom", Triangles(1)),
    ("40_float_list_index", Triangles(1)),
    ("44_zero_prop_element_4e9_le", Sentence(&["no faces"])),
    ("46_zero_prop_element_ascii", Sentence(&["no faces"])),
];

/// Loads a mesh and builds its octree, as far as a picture of one pixel needs it.
fn open(folder: &Path, file: &Path) -> Run {
    let mut arguments: Vec<_> = ["render", "--backend", "cpu", "--size", "1x1", "-o", "out.png"]
        .map(Into::into)
        .to_vec();
    arguments.push(file.as_os_str().to_owned());
    run(folder, arguments)
}

#[test]
#[ignore = "needs the reference data"]
fn every_file_gives_triangles_or_a_sentence() {
    let known: BTreeMap<_, _> = KNOWN.into_iter().collect();
    let folder = tempfile::tempdir().unwrap();
    let mut seen = 0;
    let files = reference("ply/00_ok_ascii.ply");
    for entry in std::fs::read_dir(files.parent().unwrap()).unwrap() {
        let file = entry.unwrap().path();
        let name = file.file_stem().unwrap().to_str().unwrap().to_owned();
        let result = open(folder.path(), &file);
        println!(
            "{name}: {:?}, {} MB: {}",
            result.time,
            result.memory >> 20,
            result.error.trim()
        );
        assert!(result.time < Duration::from_secs(1), "{name} took {:?}", result.time);
        assert!(result.memory < 256 << 20, "{name} took {} bytes", result.memory);
        // Warnings stand in lines of their own before the last.
        let last = result.error.lines().last().unwrap_or_default();
        match result.code {
            Some(0) => assert!(last.contains(" triangle"), "{name}: {last}"),
            Some(1) => assert!(last.starts_with("oktant: ") && last.contains(&name), "{name}: {last}"),
            other => panic!("{name} ended with {other:?}: {}", result.error),
        }
        match known.get(name.as_str()) {
            Some(Triangles(count)) => assert!(last.contains(&format!(" {count} triangle")), "{name}: {last}"),
            Some(Sentence(words)) => {
                assert_eq!(result.code, Some(1), "{name}");
                assert!(words.iter().all(|word| last.contains(word)), "{name}: {last}");
            }
            None => {}
        }
        seen += 1;
    }
    assert!(seen >= KNOWN.len(), "{seen} files");
}

/// The best of a few runs: the clock must not pay for what else the machine does.
fn best(mesh: &str, tries: u32) -> (Duration, u64) {
    let folder = tempfile::tempdir().unwrap();
    let runs: Vec<Run> = (0..tries).map(|_| open(folder.path(), Path::new(mesh))).collect();
    for run in &runs {
        assert_eq!(run.code, Some(0), "{}", run.error);
        println!("{mesh}: {:?}, {} MB", run.time, run.memory >> 20);
    }
    (
        runs.iter().map(|run| run.time).min().unwrap_or_default(),
        runs.iter().map(|run| run.memory).max().unwrap_or_default(),
    )
}

#[test]
#[ignore = "needs the reference data"]
fn the_large_dragon_opens_in_three_seconds_and_a_gigabyte() {
    let dragon = reference("meshes/dragon-871k.ply");
    let (time, memory) = best(dragon.to_str().unwrap(), 3);
    assert!(time < Duration::from_secs(3), "{time:?}");
    assert!(memory < 1_000_000_000, "{memory}");
}

#[test]
#[ignore = "measures time, wants the machine for itself"]
fn the_bunny_opens_in_a_fifth_of_a_second() {
    let (time, _) = best("bunny", 5);
    assert!(time < Duration::from_millis(200), "{time:?}");
}
