#![cfg(test)]
//! Charts of the error of pictures: what must be in them whatever the machine.

use glam::uvec2;
use oktant::bench::Device;
use oktant::chart::{Figure, Plan, depth_error, image_error, samples};
use oktant::mesh_source::MeshSource;
use oktant::progress::silent;
use oktant::source::Source;
use std::path::Path;

fn plan(source: Source) -> Plan {
    Plan {
        meshes: vec![MeshSource::Balls],
        sources: vec![source],
        pictures: uvec2(24, 18),
        devices: vec![Device::Cpu],
        size: uvec2(8, 8),
        rays: 1,
        repeats: 1,
        largest: 1000,
        command: "a test".into(),
    }
}

/// The values of a series in a panel, in the order in which they were measured.
fn values(figure: &Figure, panel: &str, series: &str) -> Vec<f64> {
    let records = figure.records.iter();
    let own = records.filter(|record| record.panel == panel && record.series == series);
    own.map(|record| record.y.drawn()).collect()
}

#[test]
fn more_samples_leave_less_error() {
    let figures = image_error(&plan(Source::Mesh(MeshSource::Balls)), &silent).unwrap();
    for figure in figures {
        let ways = [
            "regular grid",
            "regular grid, adaptive",
            "rotated grid",
            "rotated grid, adaptive",
            "R2 sequence",
            "R2 sequence, adaptive",
            "corners of blocks",
        ];
        assert_eq!(figure.series(), ways);
        assert_eq!(figure.records.iter().filter(|record| record.is_marked).count(), 1);
        assert!(figure.records.iter().all(|record| record.x > 0.0));
        let errors = figure
            .series()
            .into_iter()
            .map(|series| values(&figure, "balls", series));
        let errors: Vec<_> = errors.collect();
        let (blocks, pairs) = errors.split_last().unwrap();
        // Less than a sample of a pixel is worse than one, but not by much, and better than what is wrong.
        assert_eq!(blocks.len(), 3);
        for error in blocks {
            assert!(
                (1.0..2.0).contains(&(error / errors[0][0])),
                "{}: {blocks:?} {errors:?}",
                figure.stem
            );
        }
        for pair in pairs.chunks(2) {
            let (errors, adaptive) = (&pair[0], &pair[1]);
            assert_eq!((errors.len(), adaptive.len()), (4, 3));
            assert!(
                errors[3] < 0.3 * errors[0] && errors[3] > 0.0,
                "{}: {errors:?}",
                figure.stem
            );
            for (all, needed) in errors[1..].iter().zip(adaptive) {
                assert!(*needed < 1.5 * all, "{}: {errors:?}, {adaptive:?}", figure.stem);
            }
            // One sample lies in the middle, whatever the pattern.
            assert_eq!(errors[0], values(&figure, "balls", "regular grid")[0]);
        }
    }
}

#[test]
fn deeper_trees_and_lower_cutoffs_leave_less_error() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/scenes/mirrors.toml");
    let figure = depth_error(&plan(Source::Scene(path)), &silent).unwrap();
    let by = |what: &str| values(&figure, &format!("RMSE of the light by {what}"), "mirrors");
    let depths = by("depth");
    assert_eq!(depths.len(), 17);
    assert!(depths[0] > 10.0 * depths[3] && depths[3] > depths[16], "{depths:?}");
    // From 2^-10 of the default upwards.
    let cutoffs = by("cut-off");
    assert_eq!(cutoffs.len(), 16);
    assert!(
        cutoffs[15] > 2.0 * cutoffs[10] && cutoffs[10] >= cutoffs[0],
        "{cutoffs:?}"
    );
    // What differs is counted from a picture that is cut itself, of which there is a bound too.
    for (quantity, what, uncut) in [
        ("greatest", "depth", 16),
        ("greatest", "cut-off", 1),
        ("mean", "cut-off", 1),
    ] {
        let of = |series: &str| values(&figure, &format!("{quantity} steps of 8 bits by {what}"), series);
        let (off, bounds) = (of("mirrors"), of("mirrors, bound"));
        assert_eq!((off.len(), bounds.len()), (by(what).len(), by(what).len()));
        assert_eq!(off[uncut], 0.0, "the same picture");
        for (off, bound) in off.iter().zip(&bounds) {
            assert!(*off <= bound + bounds[uncut], "{quantity} by {what}: {off} {bound}");
        }
        let last = off.len() - 1;
        let (most, least) = if what == "depth" { (0, last) } else { (last, 0) };
        assert!(
            off[most] > 10.0 * off[least] && bounds[most] > 1.5 * bounds[least],
            "{quantity} by {what}: {off:?} {bounds:?}"
        );
    }
    assert_eq!(
        figure.records.iter().filter(|record| record.is_marked).count(),
        12,
        "two defaults, three values each, and three that are bounded, with their bounds"
    );
}

#[test]
fn rays_buy_less_error() {
    let [flip, rmse] = samples(&plan(Source::Mesh(MeshSource::Balls)), &silent).unwrap();
    let bar = "the bar";
    assert_eq!(flip.series(), ["as many everywhere", "adaptive:16", bar]);
    assert_eq!(rmse.series(), ["as many everywhere", "adaptive:16"]);
    let rays = |series: &str| -> Vec<f64> {
        let own = flip.records.iter().filter(|record| record.series == series);
        own.map(|record| record.x).collect()
    };
    for figure in [&flip, &rmse] {
        assert_eq!(figure.records.iter().filter(|record| record.is_marked).count(), 2);
        for series in ["as many everywhere", "adaptive:16"] {
            let errors = values(figure, "balls", series);
            // Samples that bring nothing more bring other roundings.
            let is_less = |a: &f64, b: &f64| *a >= b * (1.0 - 1e-9);
            assert!(errors.is_sorted_by(is_less), "{}: {errors:?}", figure.stem);
        }
    }
    // A camera ray a sample, and a shadow ray where it hits.
    let (fixed, adaptive) = (rays("as many everywhere"), rays("adaptive:16"));
    assert_eq!((fixed.len(), adaptive.len()), (4, 7));
    for (rays, samples) in fixed.iter().zip([1.0, 4.0, 16.0, 64.0]) {
        assert!((samples..2.0 * samples).contains(rays), "{fixed:?}");
    }
    assert!(adaptive.is_sorted() && adaptive[0] > fixed[0] && adaptive[6] < fixed[2]);
    let errors = values(&flip, "balls", "as many everywhere");
    assert_eq!(rays(bar), [fixed[0], 0.35 * fixed[2], 0.35 * fixed[2]]);
    assert_eq!(
        values(&flip, "balls", bar),
        [1.05 * errors[2], 1.05 * errors[2], errors[3]]
    );
}
