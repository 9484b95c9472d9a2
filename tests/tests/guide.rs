#![cfg(test)]
//! The guide: its links lead somewhere, commands make its pictures, and what it says in two places is the same.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize().unwrap()
}

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The pages: those of the guide, and those beside it. Paths from the root.
fn pages() -> Vec<String> {
    let mut pages: Vec<String> = fs::read_dir(root().join("docs"))
        .unwrap()
        .map(|entry| format!("docs/{}", entry.unwrap().file_name().display()))
        .filter(|path| path.ends_with(".md"))
        .collect();
    assert!(pages.len() > 15, "the guide is gone");
    pages.extend(["README.md", "CONTRIBUTING.md", "ARCHITECTURE.md", "assets/README.md"].map(String::from));
    pages
}

/// What stands in the round brackets of a page's links and pictures.
fn targets(text: &str) -> impl Iterator<Item = &str> {
    text.split("](")
        .skip(1)
        .filter_map(|rest| rest.split_once(')').map(|(target, _)| target))
}

/// Where a heading can be linked to: as the usual sites for repositories make it.
fn anchor(heading: &str) -> String {
    let kept = heading.trim().to_lowercase();
    let kept = kept.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

fn anchors(text: &str) -> BTreeSet<String> {
    let mut is_code = false;
    let mut anchors = BTreeSet::new();
    for line in text.lines() {
        is_code ^= line.starts_with("```");
        if let (false, Some((marks, heading))) = (is_code, line.split_once(' '))
            && !marks.is_empty()
            && marks.bytes().all(|byte| byte == b'#')
        {
            anchors.insert(anchor(heading));
        }
    }
    anchors
}

/// What is wrong with a page's links to files and headings of the repository.
fn broken(page: &str, text: &str) -> Vec<String> {
    let folder = root().join(page).parent().unwrap().to_path_buf();
    let wrong = targets(text).filter(|target| {
        if target.contains("://") {
            return false;
        }
        let (file, heading) = target.split_once('#').unwrap_or((target, ""));
        if file.is_empty() {
            return !anchors(text).contains(heading);
        }
        let path = folder.join(file);
        !path.exists()
            || !heading.is_empty() && !fs::read_to_string(path).is_ok_and(|text| anchors(&text).contains(heading))
    });
    wrong.map(|target| format!("{page}: {target}")).collect()
}

#[test]
fn links_lead_somewhere() {
    let wrong: Vec<String> = pages().iter().flat_map(|page| broken(page, &read(page))).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let text =
        "# A page, of `mine`\n[a](output.md#many-frames) [b](#a-page-of-mine) [c](x.md) [d](output.md#y) [e](#z)";
    let found = broken("docs/viewer.md", text);
    assert_eq!(
        found,
        ["x.md", "output.md#y", "#z"].map(|target| format!("docs/viewer.md: {target}"))
    );
}

/// The pictures that a page shows. Paths from the root.
fn shown(page: &str) -> BTreeSet<String> {
    let folder = if page.starts_with("docs/") { "docs/" } else { "" };
    let text = read(page);
    let pictures = text.split("![").skip(1).flat_map(|rest| targets(rest).next());
    pictures.map(|picture| format!("{folder}{picture}")).collect()
}

/// The charts that are drawn from the data beside them. Paths from the root.
fn charts() -> BTreeSet<String> {
    let files = fs::read_dir(root().join("docs/charts")).unwrap();
    let names = files.map(|file| file.unwrap().file_name().display().to_string());
    let data: Vec<String> = names
        .filter_map(|name| name.strip_suffix(".csv").map(String::from))
        .collect();
    data.iter()
        .flat_map(|name| ["svg", "png"].map(|ending| format!("docs/charts/{name}.{ending}")))
        .collect()
}

/// What the commands of a page write: the pictures that they name, and those that their scripts do.
fn written(page: &str) -> BTreeSet<String> {
    let text = read(page);
    let commands = text
        .lines()
        .filter(|line| line.starts_with("oktant ") || line.starts_with("cargo run --release -- "));
    let mut written = BTreeSet::new();
    for command in commands {
        let words: Vec<&str> = command.split_whitespace().collect();
        for pair in words.windows(2) {
            match pair[0] {
                "-o" => drop(written.insert(pair[1].to_string())),
                "--script" => {
                    let script = read(pair[1]);
                    let screenshots = script.lines().filter_map(|line| line.strip_prefix("screenshot "));
                    written.extend(screenshots.map(String::from));
                }
                _ => {}
            }
        }
        // Beside the picture lies one for each thing that pixels tell.
        if command.contains("--aov all")
            && let Some(picture) = words.iter().find_map(|word| word.strip_suffix(".png"))
        {
            let kinds = ["depth", "normal", "id", "barycentrics", "samples", "rays"];
            written.extend(kinds.map(|kind| format!("{picture}-{kind}.png")));
        }
    }
    written
}

#[test]
fn commands_make_the_pictures() {
    let made = read("docs/make-pictures");
    let made = made
        .split_once("then pages=(")
        .and_then(|(_, rest)| rest.split_once(')'));
    let made: Vec<&str> = made.expect("it names its pages").0.split_whitespace().collect();
    let charts = charts();
    for page in pages() {
        let (shown, written) = (shown(&page), written(&page));
        let missing: Vec<_> = shown
            .difference(&written)
            .filter(|picture| !charts.contains(*picture))
            .collect();
        assert!(
            missing.is_empty(),
            "{page} shows what none of its commands makes: {missing:?}"
        );
        let name = page.strip_prefix("docs/").map_or(format!("../{page}"), String::from);
        assert_eq!(
            shown.is_empty(),
            !made.contains(&name.as_str()),
            "docs/make-pictures, {name}"
        );
    }
}

#[test]
fn the_part_on_the_first_page_is_the_one_of_the_patch() {
    let patch = read("docs/examples/part.patch");
    let file = patch
        .split_once("+++ b/shared/src/triangle_test/scaled.rs\n")
        .expect("it is there")
        .1;
    let file = file.split("diff --git").next().unwrap_or_default();
    let added: Vec<&str> = file.lines().filter_map(|line| line.strip_prefix('+')).collect();
    let start = added
        .iter()
        .position(|line| line.starts_with("#[derive"))
        .expect("a type");
    let part: String = added[start..].iter().map(|line| format!("{line}\n")).collect();
    assert!(part.contains("impl TriangleTest for Scaled"), "{part}");

    let documented = read("host/src/lib.rs");
    let documented = documented.lines().filter_map(|line| line.strip_prefix("//!"));
    let documented: String = documented
        .map(|line| format!("{}\n", line.strip_prefix(' ').unwrap_or(line)))
        .collect();
    assert!(documented.contains(&part), "make both the same:\n{part}");
}
