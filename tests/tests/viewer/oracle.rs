//! The picture that is shown, compared with the oracle's.

use super::window::{Image, Session, run};
use std::path::Path;

/// Colours of pixels that disagree in what is seen, its depth, its shadow and its colour.
const COLORS: [[u8; 3]; 4] = [[255, 64, 64], [255, 170, 40], [80, 170, 255], [90, 230, 110]];
const NAMES: [&str; 4] = ["oracle-id", "oracle-t", "oracle-shadow", "oracle-color"];
const PIXELS: usize = 320 * 240;
/// The legend is higher up, its lines broken in a window as narrow as that.
const BELOW_LEGEND: u32 = 158;

/// Pixels below the legend that stand out.
fn outstanding(picture: &Image) -> usize {
    let pixels = picture.enumerate_pixels().filter(|(_, y, _)| *y >= BELOW_LEGEND);
    pixels.filter(|(.., pixel)| COLORS.contains(&pixel.0)).count()
}

fn brightness(picture: &Image) -> f64 {
    let pixels = picture.enumerate_pixels().filter(|(_, y, _)| *y >= BELOW_LEGEND);
    pixels.map(|(.., pixel)| f64::from(pixel.0[1])).sum()
}

/// What the step `print` said of the oracle, each time.
fn said(text: &str) -> Vec<[String; 4]> {
    let values = |name: &str| -> Vec<String> {
        let lines = text
            .lines()
            .filter_map(|line| line.strip_prefix(name)?.strip_prefix(' '));
        lines.map(str::to_owned).collect()
    };
    let all = NAMES.map(values);
    (0..all[0].len())
        .map(|i| std::array::from_fn(|kind| all[kind][i].clone()))
        .collect()
}

fn what_disagrees_is_shown(backend: &str) {
    let session = Session::new();
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/scenes/mirrors.toml");
    let report = run(
        &session,
        &[
            scene.to_str().unwrap(),
            "--backend",
            backend,
            "--size",
            "320x240",
            "--samples",
            "1",
        ],
        "key I
        wait settled
        screenshot plain.png
        print
        oracle on
        wait settled
        print
        screenshot oracle.png
        drag left 40 0
        wait settled
        print
        key O
        wait settled
        print
        screenshot after.png",
    );
    let said = said(&report.standard_output);
    let [before, found, turned, after] = said.try_into().unwrap_or_else(|_| panic!("{report}"));
    assert_eq!(
        [before, after],
        [[(); 4].map(|()| "-".to_owned()), [(); 4].map(|()| "-".to_owned())],
        "{report}"
    );
    for counts in [&found, &turned] {
        let counts = counts.each_ref().map(|count| count.parse::<usize>().unwrap());
        println!("{backend}: {NAMES:?} are {counts:?} of {PIXELS}");
        let [ids, depths, shadows, colors] = counts;
        // Rays that pass an edge within rounding; the plane's horizon, a row or two; and what is reflected more than once.
        assert!(ids.max(shadows) <= PIXELS / 500, "{counts:?}");
        assert!(depths <= PIXELS / 100, "{counts:?}");
        assert!((1..PIXELS / 100).contains(&colors), "{counts:?}");
    }
    let pictures = ["plain.png", "oracle.png", "after.png"].map(|name| session.await_picture(name));
    let [plain, oracle, after] = &pictures;
    assert_eq!((outstanding(plain), outstanding(after)), (0, 0));
    let disagree: usize = found.iter().map(|count| count.parse::<usize>().unwrap()).sum();
    let shown = outstanding(oracle);
    assert!(shown > 0 && shown <= disagree, "{shown} of {disagree}");
    assert!(brightness(oracle) < 0.7 * brightness(plain), "what agrees is veiled");
    assert!(brightness(after) > 0.8 * brightness(plain), "and no longer");
}

#[test]
#[ignore = "needs a display"]
fn what_the_cpu_has_otherwise_is_shown() {
    what_disagrees_is_shown("cpu");
}

#[test]
#[ignore = "needs a display and a Vulkan driver"]
fn what_the_gpu_has_otherwise_is_shown() {
    what_disagrees_is_shown("gpu");
}
