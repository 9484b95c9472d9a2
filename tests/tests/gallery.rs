#![cfg(test)]
//! The commands of `docs/gallery.md` run, and make the pictures that it shows.

use oktant_tests::images::{CPU, difference};
use oktant_tests::program::{Run, run};
use std::path::{Path, PathBuf};

fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs")
}

fn gallery() -> String {
    std::fs::read_to_string(docs().join("gallery.md")).unwrap()
}

/// The arguments of every command.
fn commands(text: &str) -> Vec<Vec<&str>> {
    let lines = text.lines().filter_map(|line| line.strip_prefix("oktant "));
    lines.map(|line| line.split_whitespace().collect()).collect()
}

/// The pictures that are shown, relative to the folder of the page.
fn pictures(text: &str) -> Vec<&str> {
    let links = text.split("](").skip(1).filter_map(|rest| rest.split_once(')'));
    links
        .map(|(link, _)| link)
        .filter(|link| link.ends_with(".png") || link.ends_with(".gif"))
        .collect()
}

/// Runs a command of the page in a folder, on the CPU, with the scenes of the project; the picture may be of another size.
fn run_on_cpu(folder: &Path, command: &[&str], size: Option<&str>) -> Run {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize().unwrap();
    let mut arguments: Vec<String> = command.iter().map(ToString::to_string).collect();
    for i in 1..arguments.len() {
        match (arguments[i - 1].as_str(), size) {
            ("--size", Some(size)) => arguments[i] = size.into(),
            ("render", _) => arguments[i] = root.join(&arguments[i]).display().to_string(),
            _ => {}
        }
    }
    arguments.extend(["--backend".into(), "cpu".into()]);
    run(folder, &arguments)
}

/// Pictures that take a second or two in the size in which they are shown.
const QUICK: [&str; 8] = [
    "bunny",
    "balls",
    "depth-0",
    "depth-1",
    "depth-2",
    "depth-16",
    "samples-1",
    "samples-4",
];

#[test]
fn pictures_are_what_their_commands_make() {
    let text = gallery();
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir_all(folder.path().join("docs/gallery")).unwrap();
    let mut wrong = Vec::new();
    for name in QUICK {
        let picture = format!("docs/gallery/{name}.png");
        let commands = commands(&text);
        let command = commands.iter().find(|command| command.contains(&picture.as_str()));
        let command = command.unwrap_or_else(|| panic!("no command makes {picture}"));
        let run = run_on_cpu(folder.path(), command, None);
        assert_eq!(run.code, Some(0), "{}: {}", command.join(" "), run.error);
        let made = image::open(folder.path().join(&picture)).unwrap().to_rgb8();
        let shown = docs().join(format!("gallery/{name}.png"));
        wrong.extend(difference(&shown, &made, &CPU, "gallery"));
    }
    assert!(wrong.is_empty(), "run the commands anew: {}", wrong.join("\n"));
}

#[test]
fn every_command_makes_its_pictures() {
    let text = gallery();
    let commands = commands(&text);
    assert!(commands.len() >= 20, "the commands are gone");
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir_all(folder.path().join("docs/gallery")).unwrap();
    for command in commands {
        let run = run_on_cpu(folder.path(), &command, Some("64x48"));
        assert_eq!(run.code, Some(0), "{}: {}", command.join(" "), run.error);
    }
    // What the commands made is what the page shows, and what lies there.
    let mut shown: Vec<PathBuf> = pictures(&text).iter().map(PathBuf::from).collect();
    let mut made = files(&folder.path().join("docs"));
    // The picture beside which the others lie is not shown.
    made.retain(|path| path != Path::new("gallery/aov.png"));
    let mut there = files(&docs());
    there.retain(|path| path.starts_with("gallery") && path != Path::new("gallery/aov.png"));
    shown.sort();
    assert_eq!(shown, made);
    assert_eq!(shown, there);
}

/// Pictures in the folder `gallery` of a folder, sorted.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder.join("gallery"))
        .unwrap()
        .map(|entry| Path::new("gallery").join(entry.unwrap().file_name()))
        .collect();
    files.sort();
    files
}

#[test]
fn the_page_is_read_as_it_is_meant() {
    let text =
        "a\n```\noktant render x.toml -o docs/gallery/x.png\n```\n![x](gallery/x.png) ![y](gallery/y.gif) [z](z.md)\n";
    assert_eq!(commands(text), [["render", "x.toml", "-o", "docs/gallery/x.png"]]);
    assert_eq!(pictures(text), ["gallery/x.png", "gallery/y.gif"]);
}
