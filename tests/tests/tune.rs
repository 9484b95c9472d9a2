//! `oktant tune` and its profiles.

#![cfg(test)]

use oktant::costs::Costs;
use oktant::profile::Profile;
use oktant_tests::program::run;
use std::fs;
use tempfile::tempdir;

#[test]
#[ignore = "measures times, for which nothing else must run"]
fn a_profile_is_measured() {
    let folder = tempdir().unwrap();
    let made = run(folder.path(), ["tune", "--backend", "cpu", "-o", "a.toml"]);
    assert_eq!(made.code, Some(0), "{}", made.error);
    for name in ["octants: a step ", "octree: a step "] {
        assert!(made.output.contains(name), "{}", made.output);
    }
    let profile = Profile::read(&folder.path().join("a.toml")).unwrap();
    assert!(profile.device.starts_with("CPU, "), "{}", profile.device);
}

/// Trees of a profile whose steps are dear have larger leaves.
#[test]
fn a_profile_is_used() {
    let folder = tempdir().unwrap();
    let free = |node| Costs { node, triangle: 1.0 };
    let lazy = Profile::new("a device".into(), free(100.0), free(100.0));
    fs::write(folder.path().join("lazy.toml"), lazy.text()).unwrap();
    for traversal in ["octants", "octree"] {
        let leaves = |profile: &[&str]| {
            let arguments = [&["info", "balls", "--traversal", traversal], profile].concat();
            let told = run(folder.path(), arguments);
            assert_eq!(told.code, Some(0), "{}", told.error);
            let line = |name: &str| {
                let found = told.output.lines().find(|line| line.starts_with(name));
                found.unwrap_or_else(|| panic!("{}", told.output)).to_string()
            };
            (line("leaves"), line("costs"))
        };
        let (default, costs) = leaves(&[]);
        assert!(costs.contains("as 0.50 steps") && !costs.contains("profile"), "{costs}");
        let (fewer, costs) = leaves(&["--profile", "lazy.toml"]);
        assert!(costs.contains("as 0.01 steps, by the profile"), "{costs}");
        assert_ne!(default, fewer);
    }
}

#[test]
fn broken_profiles_are_refused_in_a_sentence() {
    let folder = tempdir().unwrap();
    let good = Profile::new("a device".into(), Costs::OCTANTS, Costs::OCTREE).text();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("old.toml", &good.replace("version = 1", "version = 0"));
    write("free.toml", &good.replace("triangle = 1.0000", "triangle = 0"));
    write("more.toml", &format!("{good}\n[grid]\nnode = 1\n"));
    write("text.toml", "Dear reader,\n");
    fs::write(folder.path().join("bytes.toml"), [0xff; 100]).unwrap();
    for (name, words) in [
        ("missing.toml", "cannot be read"),
        ("bytes.toml", "cannot be read"),
        ("old.toml", "its version is 0"),
        ("free.toml", "triangle of octree is 0"),
        ("more.toml", "unknown field `grid`"),
        ("text.toml", "line 1"),
    ] {
        for command in [
            &["info", "balls"][..],
            &["bench", "balls"],
            &["render", "balls", "-o", "a.png"],
        ] {
            let refused = run(folder.path(), [command, &["--profile", name]].concat());
            assert_eq!(refused.code, Some(1), "{}", refused.error);
            let sentence = refused.error.trim_end();
            assert!(sentence.contains(name) && sentence.contains(words), "{sentence}");
            assert!(
                !sentence.contains('\n') && sentence.contains("oktant tune"),
                "{sentence}"
            );
        }
    }
    assert!(!folder.path().join("a.png").exists());
}
