//! Polygons of four and more corners.

use std::collections::HashSet;
use std::f64::consts::TAU;

use glam::{DMat3, DQuat, DVec2, DVec3};

use super::{Random, assert_refused, load};

/// A file with one polygon of all these vertices.
fn file(points: &[DVec3]) -> Vec<u8> {
    let header = super::plain(points.len(), 1).replace("uchar int", "uint uint");
    let mut file = format!("ply\nformat binary_little_endian 1.0\n{header}end_header\n").into_bytes();
    for point in points {
        file.extend(point.as_vec3().to_array().iter().flat_map(|value| value.to_le_bytes()));
    }
    file.extend((points.len() as u32).to_le_bytes());
    for corner in 0..points.len() as u32 {
        file.extend(corner.to_le_bytes());
    }
    file
}

fn cut(points: &[DVec3]) -> Vec<[u32; 3]> {
    let triangles = load(&file(points)).unwrap().triangles;
    assert_eq!(triangles.len(), points.len() - 2);
    triangles
}

fn area(points: &[DVec2]) -> f64 {
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).map(|(p, q)| 0.5 * p.perp_dot(*q)).sum()
}

/// Cuts a simple polygon, placed in space by `frame`, and checks that the triangles are a disc with its boundary, that
/// none is turned over, and that they have its area.
#[track_caller]
fn check(outline: &[DVec2], frame: DMat3, offset: DVec3) {
    let points: Vec<DVec3> = outline.iter().map(|p| frame * p.extend(0.0) + offset).collect();
    let triangles = cut(&points);

    let count = outline.len() as u32;
    let mut edges = HashSet::new();
    for [a, b, c] in &triangles {
        for edge in [(a, b), (b, c), (c, a)] {
            assert!(edges.insert(edge), "edge {edge:?} twice in {triangles:?}");
        }
    }
    for corner in 0..count {
        let next = (corner + 1) % count;
        assert!(
            edges.contains(&(&corner, &next)),
            "no edge {corner} {next} in {triangles:?}"
        );
    }
    for (a, b) in &edges {
        assert!((*a + 1) % count == **b || edges.contains(&(b, a)), "a gap at {a} {b}");
    }

    let total = area(outline);
    let orientation = total.signum();
    let mut sum = 0.0;
    for triangle in triangles {
        let part = area(&triangle.map(|corner| outline[corner as usize]));
        assert!(
            part * orientation > -1e-6 * total.abs(),
            "turned over by {part} of {total}"
        );
        sum += part;
    }
    assert!((sum - total).abs() < 1e-6 * total.abs());
}

/// As [`check`], flat and exact, tilted, and from behind.
#[track_caller]
fn check_everywhere(outline: &[DVec2], random: &mut Random) {
    check(outline, DMat3::IDENTITY, DVec3::ZERO);
    for flat in [
        DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X),
        DMat3::from_cols(DVec3::Z, DVec3::X, DVec3::Y),
    ] {
        check(outline, flat, DVec3::new(3.0, -1.0, 2.0));
    }
    let axis = DVec3::from_array([(); 3].map(|()| random.unit() - 0.5)).normalize();
    let tilt = DMat3::from_quat(DQuat::from_axis_angle(axis, random.unit() * TAU));
    check(outline, tilt, DVec3::ZERO);
    let behind: Vec<DVec2> = outline.iter().rev().copied().collect();
    check(&behind, DMat3::IDENTITY, DVec3::ZERO);
    check(&behind, tilt, axis);
}

fn polar(radius: f64, turn: f64) -> DVec2 {
    DVec2::from_angle(turn * TAU) * radius
}

#[test]
fn convex_quads_are_cut_from_the_first_corner() {
    let square = [[0., 0., 0.], [2., 0., 0.], [2., 1., 0.], [0., 1., 0.]].map(DVec3::from_array);
    assert_eq!(cut(&square), [[0, 1, 2], [0, 2, 3]]);
    // Not flat.
    let bent = [[0., 0., 0.], [2., 0., 1.], [2., 1., 0.], [0., 1., 1.]].map(DVec3::from_array);
    assert_eq!(cut(&bent), [[0, 1, 2], [0, 2, 3]]);
    // Repeated corners.
    let triangle = [[0., 0., 0.], [2., 0., 0.], [2., 1., 0.], [2., 1., 0.]].map(DVec3::from_array);
    assert_eq!(cut(&triangle), [[0, 1, 2], [0, 2, 3]]);
}

#[test]
fn concave_quads_are_cut_at_the_reflex_corner() {
    let mut random = Random(1);
    let mut arrow = [[0., 0.], [4., 4.], [0., 1.5], [-4., 4.]].map(DVec2::from_array);
    for _ in 0..4 {
        check_everywhere(&arrow, &mut random);
        arrow.rotate_left(1);
    }
    // A corner on a straight edge must not vanish.
    let mut straight = [[0., 0.], [1., 0.], [2., 0.], [0., 2.]].map(DVec2::from_array);
    for _ in 0..4 {
        check_everywhere(&straight, &mut random);
        straight.rotate_left(1);
    }
}

#[test]
fn concave_polygons_are_covered_once() {
    let mut random = Random(2);
    let ell = [[0., 0.], [3., 0.], [3., 1.], [1., 1.], [1., 3.], [0., 3.]].map(DVec2::from_array);
    check_everywhere(&ell, &mut random);
    for corners in (5..200).chain([1000]) {
        let star: Vec<DVec2> = (0..corners)
            .map(|i| polar(0.2 + random.unit(), f64::from(i) / f64::from(corners)))
            .collect();
        check_everywhere(&star, &mut random);
    }
    for turns in 1..6 {
        let arm = |out: f64| {
            let steps = 40 * turns;
            (0..steps).map(move |i| polar(1.0 + out + f64::from(i) / 40.0, f64::from(i) / 40.0))
        };
        let spiral: Vec<DVec2> = arm(0.6).chain(arm(0.0).rev()).collect();
        check_everywhere(&spiral, &mut random);
    }
}

#[test]
fn corners_on_straight_edges_are_kept() {
    let mut random = Random(3);
    for columns in 1..60 {
        // A skyline with a corner at every whole number.
        let mut outline: Vec<DVec2> = (0..=columns).map(|x| DVec2::new(f64::from(x), 0.0)).collect();
        let mut height = 0;
        for x in (0..columns).rev() {
            let next = 1 + random.below(5) as i32;
            let right = f64::from(x + 1);
            let towards = (next - height).signum();
            while height != next {
                height += towards;
                outline.push(DVec2::new(right, f64::from(height)));
            }
            outline.push(DVec2::new(f64::from(x), f64::from(height)));
        }
        outline.extend((1..height).rev().map(|y| DVec2::new(0.0, f64::from(y))));
        check_everywhere(&outline, &mut random);
    }
    // A triangle with corners on its edges, cut from each.
    for on_each in 1..10 {
        let tips = [[0., 0.], [8., 0.], [0., 8.]].map(DVec2::from_array);
        let mut outline: Vec<DVec2> = (0..3)
            .flat_map(|i| {
                (0..=on_each).map(move |step| tips[i].lerp(tips[(i + 1) % 3], f64::from(step) / f64::from(on_each + 1)))
            })
            .collect();
        for _ in 0..outline.len() {
            check(&outline, DMat3::IDENTITY, DVec3::ZERO);
            outline.rotate_left(1);
        }
    }
}

#[test]
fn bad_polygons_keep_their_number_of_triangles() {
    let mut random = Random(4);
    for corners in (4..100).chain([300, 1000]) {
        for flat in [0.0, 1.0] {
            let crossing: Vec<DVec3> = (0..corners)
                .map(|_| DVec3::new(random.unit(), random.unit(), random.unit() * flat))
                .collect();
            cut(&crossing);
            let grid: Vec<DVec3> = crossing.iter().map(|p| (*p * 3.0).floor()).collect();
            cut(&grid);
            let line: Vec<DVec3> = crossing.iter().map(|p| DVec3::splat(p.x)).collect();
            cut(&line);
        }
        cut(&vec![DVec3::ONE; corners]);
        let pentagram: Vec<DVec3> = (0..corners)
            .map(|i| polar(1.0, (2 * i) as f64 / corners as f64).extend(0.0))
            .collect();
        cut(&pentagram);
    }
    let bow_tie = [[0., 0., 0.], [1., 1., 0.], [1., 0., 0.], [0., 1., 0.]].map(DVec3::from_array);
    assert_eq!(cut(&bow_tie), [[0, 1, 2], [0, 2, 3]]);
}

#[test]
fn ids_follow_the_file_through_polygons() {
    let header = super::plain(6, 4);
    let body = "0 0 0\n2 0 0\n3 2 0\n1 4 0\n-1 2 0\n1 1 9\n3 0 1 5\n5 0 1 2 3 4\n4 0 1 2 3\n3 1 2 5\n";
    let triangles = load(&super::ascii(&header, body)).unwrap().triangles;
    assert_eq!(triangles.len(), 7);
    assert_eq!(triangles[0], [0, 1, 5]);
    assert!(triangles[1..4].as_flattened().iter().all(|&corner| corner < 5));
    assert_eq!(triangles[4..], [[0, 1, 2], [0, 2, 3], [1, 2, 5]]);
}

#[test]
fn large_polygons_are_cut_or_refused() {
    let mut random = Random(5);
    // Rounded to f32, its corners turn both ways.
    let disc: Vec<DVec2> = (0..100_000).map(|i| polar(1.0, f64::from(i) / 1e5)).collect();
    check(&disc, DMat3::IDENTITY, DVec3::ZERO);
    let mut star = |corners: u32| -> Vec<DVec3> {
        (0..corners)
            .map(|i| polar(0.2 + random.unit(), f64::from(i) / f64::from(corners)).extend(0.0))
            .collect()
    };
    cut(&star(16_000));
    assert_refused(&file(&star(20_000)), &["element face 0", "20000 corners", "concave"]);
}
