#![cfg(test)]
//! The commands of `docs/gallery.md` run, and make the pictures that it shows.

use oktant_tests::program::run;
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
        .filter(|link| link.ends_with(".png"))
        .collect()
}

#[test]
fn every_command_makes_its_pictures() {
    let text = gallery();
    let commands = commands(&text);
    assert!(commands.len() >= 20, "the commands are gone");
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir_all(folder.path().join("docs/gallery")).unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize().unwrap();
    for command in commands {
        let mut arguments: Vec<String> = command.iter().map(ToString::to_string).collect();
        for i in 1..arguments.len() {
            match arguments[i - 1].as_str() {
                "--size" => arguments[i] = "64x48".into(),
                "render" => arguments[i] = root.join(&arguments[i]).display().to_string(),
                _ => {}
            }
        }
        arguments.extend(["--backend".into(), "cpu".into()]);
        let run = run(folder.path(), &arguments);
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
    let text = "a\n```\noktant render x.toml -o docs/gallery/x.png\n```\n![x](gallery/x.png) ![y](gallery/y.png)\n";
    assert_eq!(commands(text), [["render", "x.toml", "-o", "docs/gallery/x.png"]]);
    assert_eq!(pictures(text), ["gallery/x.png", "gallery/y.png"]);
}
