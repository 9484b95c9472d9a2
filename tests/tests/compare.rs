//! `oktant compare`: figures against those of other programs, limits, pictures of the difference.
#![cfg(test)]

use image::{Rgb, RgbImage};
use oktant_tests::program::{Run, run};
use serde_json::Value;
use std::path::Path;

/// The pictures of tests/reference/compare.py.
fn picture(shift: u32) -> RgbImage {
    RgbImage::from_fn(96, 64, |x, y| {
        let x = x + shift;
        let square = ((x / 8) ^ (y / 8)) & 1;
        Rgb([((x * 5 + y) % 256) as u8, (x * y / 8 % 256) as u8, (square * 200) as u8])
    })
}

/// A folder with two pictures and one of another size.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    picture(0).save(folder.path().join("a.png")).unwrap();
    picture(1).save(folder.path().join("b.png")).unwrap();
    RgbImage::new(96, 63).save(folder.path().join("low.png")).unwrap();
    folder
}

fn compare(folder: &Path, arguments: &[&str]) -> Run {
    run(folder, [&["compare"], arguments].concat())
}

fn figures(folder: &Path, arguments: &[&str]) -> Value {
    let run = compare(folder, &[arguments, &["--json"]].concat());
    assert_eq!(run.code, Some(0), "{}", run.error);
    serde_json::from_str(&run.output).expect("JSON")
}

#[test]
fn figures_are_those_of_other_programs() {
    let folder = folder();
    let is = figures(folder.path(), &["a.png", "b.png"]);
    // What tests/reference/compare.py prints: FLIP by its authors' program, the rest by scikit-image and NumPy.
    let near = |is: &Value, wanted: f64, tolerance: f64| {
        let is = is.as_f64().expect("a number");
        assert!((is - wanted).abs() < tolerance, "{is} instead of {wanted}");
    };
    near(&is["rmse"], 0.150_055_95, 1e-7);
    near(&is["psnr"], 14.659_672_65, 1e-5);
    near(&is["ssim"], 0.825_585_746, 1e-7);
    near(&is["flip"]["mean"], 0.224_883_97, 1e-6);
    near(&is["flip"]["percentile_99"], 0.694_274_07, 1e-6);
    near(&is["flip"]["largest"], 0.957_870_8, 1e-6);
    assert_eq!(is["differing"], 6144);
    let alike = figures(folder.path(), &["a.png", "a.png"]);
    assert_eq!((&alike["rmse"], &alike["psnr"]), (&0.0.into(), &Value::Null));
    assert_eq!(
        (&alike["differing"], &alike["flip"]["largest"]),
        (&0.into(), &0.0.into())
    );
}

#[test]
fn limits_decide_the_exit_code() {
    let folder = folder();
    for (option, passes, fails) in [
        ("--max-rmse", "0.1501", "0.15"),
        ("--max-flip", "0.2249", "0.2248"),
        ("--max-flip-99", "0.6943", "0.6942"),
        ("--max-differing", "6144", "6143"),
        ("--min-ssim", "0.8255", "0.8256"),
        ("--min-psnr", "14.65", "14.66"),
    ] {
        let run = compare(folder.path(), &["a.png", "b.png", option, passes]);
        assert_eq!((run.code, run.error.as_str()), (Some(0), ""), "{option}");
        let run = compare(folder.path(), &["a.png", "b.png", option, fails]);
        assert_eq!(run.code, Some(1), "{option}");
        assert!(run.output.contains("SSIM"), "figures are printed all the same");
        assert_eq!(run.error.lines().count(), 1, "{}", run.error);
        assert!(run.error.contains(option), "{}", run.error);
    }
    let run = compare(
        folder.path(),
        &["a.png", "a.png", "--max-differing", "0", "--min-psnr", "99"],
    );
    assert_eq!(run.code, Some(0), "{}", run.error);
}

#[test]
fn the_difference_becomes_a_picture() {
    let folder = folder();
    let path = folder.path().join("d.png");
    for show in ["flip", "signed"] {
        let run = compare(folder.path(), &["a.png", "b.png", "-o", "d.png", "--show", show]);
        assert_eq!(run.code, Some(0), "{}", run.error);
        let picture = image::open(&path).unwrap().to_rgb8();
        assert_eq!(picture.dimensions(), (96, 64));
        let colors: std::collections::HashSet<_> = picture.pixels().collect();
        assert!(colors.len() > 20, "{show}: {}", colors.len());
    }
    compare(folder.path(), &["a.png", "a.png", "-o", "d.png", "--show", "signed"]);
    assert!(
        image::open(&path)
            .unwrap()
            .to_rgb8()
            .pixels()
            .all(|pixel| pixel.0 == [128; 3])
    );
}

#[test]
fn light_and_colours_of_one_rendering_agree() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for file in ["r.png", "r.exr", "r16.png"] {
        let bits: &[&str] = if file == "r16.png" { &["--bits", "16"] } else { &[] };
        let render = ["render", "bunny", "--size", "80x60", "--backend", "cpu", "-o", file];
        let run = run(folder, [&render, bits].concat());
        assert_eq!(run.code, Some(0), "{}", run.error);
    }
    for (a, b, step) in [
        ("r.exr", "r.png", "0.51"),
        ("r16.png", "r.exr", "0.002"),
        ("r.png", "r16.png", "0.51"),
    ] {
        let is = figures(folder, &[a, b, "--step", step]);
        assert_eq!(is["differing"], 0, "{a} {b}: {is}");
        assert!(is["rmse"].as_f64().unwrap() > 0.0, "{a} {b}");
    }
    // Neither is empty.
    let is = figures(folder, &["r.exr", "r.png", "--step", "0.1"]);
    assert!(is["differing"].as_u64().unwrap() > 100, "{is}");
}

#[test]
fn what_cannot_be_compared_is_told_in_a_sentence() {
    let folder = folder();
    for (arguments, code, told) in [
        (
            &["a.png", "low.png"][..],
            1,
            "The pictures differ in size, 96x64 and 96x63 pixels",
        ),
        (&["a.png", "no.png"], 1, "no.png: there is no such file"),
        (&["a.png", "b.png", "-o", "d.exr"], 2, "a name that ends in .png"),
        (&["a.png", "b.png", "-o", "no/d.png"], 1, "The folder no does not exist"),
        (&["a.png", "b.png", "--max-flip=-1"], 2, "give a number, 0 or more"),
        (&["a.png", "b.png", "--show", "flip"], 2, "--output"),
        (&["a.png"], 2, "<B>"),
    ] {
        let run = compare(folder.path(), arguments);
        assert_eq!(run.code, Some(code), "{arguments:?}: {}", run.error);
        assert!(run.error.contains(told), "{arguments:?}: {}", run.error);
        assert!(run.output.is_empty(), "{arguments:?}");
    }
}
