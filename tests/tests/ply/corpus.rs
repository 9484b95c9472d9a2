//! Bodies: what is read from values, lists and lines.

use super::{CORNER, ascii, assert_refused, load, plain};

fn triangles(file: &[u8]) -> Vec<[u32; 3]> {
    load(file).unwrap().triangles
}

fn ascii_faces(faces: &[&str]) -> Vec<u8> {
    ascii(&plain(3, faces.len()), &format!("{CORNER}{}\n", faces.join("\n")))
}

fn little_endian(header: &str, body: &[&[u8]]) -> Vec<u8> {
    let mut file = format!("ply\nformat binary_little_endian 1.0\n{header}end_header\n").into_bytes();
    file.extend(body.concat());
    file
}

/// The usual three vertices, in binary.
fn corner() -> Vec<u8> {
    let values = [0., 0., 0., 1., 0., 0., 0., 1., 0_f32];
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

fn indices(values: &[i32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

#[test]
fn faces_before_vertices() {
    let header = "element face 1\nproperty list uchar int vertex_indices\nelement vertex 3\n\
                  property float x\nproperty float y\nproperty float z\n";
    let mesh = load(&ascii(header, &format!("3 0 1 2\n{CORNER}"))).unwrap();
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
    assert_eq!(mesh.positions[1].to_array(), [1., 0., 0.]);
    assert_refused(&ascii(header, &format!("3 0 1 3\n{CORNER}")), &["line 10", "vertex 3"]);
}

#[test]
fn small_faces_are_left_out_and_flat_ones_kept() {
    let file = ascii_faces(&["0", "1 0", "2 0 1", "3 0 1 2", "3 1 1 1", "3 0 1 0"]);
    assert_eq!(triangles(&file), [[0, 1, 2], [1, 1, 1], [0, 1, 0]]);
    assert_refused(&ascii_faces(&["0", "2 0 1"]), &["none of the 2 faces", "three corners"]);
    assert_refused(&ascii_faces(&["1 7"]), &["line 13", "corner 0", "vertex 7"]);
}

#[test]
fn values_beyond_the_declared_ones_are_ignored() {
    let file = ascii(&plain(3, 1), "0 0 0 7\n1 0 0\n0 1 0 # x\n3 0 1 2 9\n");
    let mesh = load(&file).unwrap();
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
    assert_eq!(mesh.positions[1].to_array(), [1., 0., 0.]);
    // After the last element, too.
    let file = ascii(&plain(3, 1), &format!("{CORNER}3 0 1 2\n3 2 1 0\n\n"));
    assert_eq!(triangles(&file), [[0, 1, 2]]);
}

#[test]
fn blank_lines_are_skipped() {
    let file = ascii(&plain(3, 1), "\n0 0 0\n\n \t\n1 0 0\n0 1 0\n\n3 0 1 2");
    assert_eq!(triangles(&file), [[0, 1, 2]]);
    let file = ascii(&plain(3, 1), "\n0 0 0\n\n \t\n1 0 0\n0 1 zero\n\n3 0 1 2");
    assert_refused(&file, &["line 15", "\"zero\""]);
}

#[test]
fn files_that_end_early_are_refused() {
    let file = ascii(&plain(3, 1), "0 0 0\n1 0");
    assert_refused(&file, &["line 11", "2 of the 3 \"vertex\""]);
    assert_refused(&ascii(&plain(3, 1), CORNER), &["line 12", "0 of the 1 \"face\""]);
    assert_refused(
        &ascii(&plain(3, 1), "0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
        &["line 10", "\"z\""],
    );
    assert_refused(&ascii_faces(&["3 0 1"]), &["line 13", "\"vertex_indices\""]);
    assert_refused(&ascii_faces(&["4000000000 0 1 2"]), &["line 13", "\"vertex_indices\""]);
    assert_refused(&ascii(&plain(4_000_000_000, 1), CORNER), &["3 of the 4000000000"]);
    assert_refused(
        &ascii(&plain(3, usize::MAX), CORNER),
        &["0 of the 18446744073709551615"],
    );

    let corner = corner();
    let short = little_endian(&plain(3, 1), &[&corner[..16]]);
    assert_refused(&short, &["element vertex 1", "declares 3"]);
    for count in [1 << 31, 1 << 32, usize::MAX] {
        let file = little_endian(&plain(count, 1), &[&corner]);
        assert_refused(&file, &["element vertex 3", &count.to_string()]);
        let file = little_endian(&plain(3, count), &[&corner, &[3], &indices(&[0, 1, 2])]);
        assert_refused(&file, &["element face 1", &count.to_string()]);
    }
    let file = little_endian(&plain(3, 1), &[&corner, &[255], &[0; 1019]]);
    assert_refused(&file, &["element face 0", "255 entries", "1019 bytes"]);
    let file = little_endian(&plain(3, 1), &[&corner, &[3], &[0; 11]]);
    assert_refused(&file, &["element face 0", "3 entries", "11 bytes"]);
}

#[test]
fn list_lengths_of_every_type_are_checked() {
    for (kind, length, shown) in [
        ("char", vec![0x80], "-128"),
        ("uchar", vec![0xFF], "255"),
        ("short", vec![0xFF, 0xFF], "-1"),
        ("ushort", vec![0xFF, 0xFF], "65535"),
        ("int", vec![0xFF; 4], "-1"),
        ("int", vec![0, 0, 0, 0x80], "-2147483648"),
        ("uint", vec![0xFF; 4], "4294967295"),
    ] {
        let header = plain(3, 1).replace("uchar", kind);
        let file = little_endian(&header, &[&corner(), &length]);
        assert_refused(&file, &["element face 0", shown, "0 bytes"]);
        // Also of a list that is skipped.
        let header = format!("{}property list {kind} double junk\n", plain(3, 1));
        let file = little_endian(&header, &[&corner(), &[3], &indices(&[0, 1, 2]), &length]);
        assert_refused(&file, &["element face 0", "\"junk\"", shown, "0 bytes"]);
    }
    assert_refused(&ascii_faces(&["-1 0 1 2"]), &["line 13", "-1 entries"]);
    assert_refused(&ascii_faces(&["3.5 0 1 2"]), &["line 13", "\"3.5\""]);
}

#[test]
fn wrong_indices_are_refused() {
    let refused = |face: &str, words: &[&str]| assert_refused(&ascii_faces(&[face]), words);
    refused("3 0 1 3", &["line 13", "corner 2", "vertex 3", "0 to 2"]);
    refused("3 0 -1 2", &["line 13", "corner 1", "vertex -1"]);
    refused("3 4294967295 1 2", &["corner 0", "vertex 4294967295"]);
    refused("3 4294967296 1 2", &["corner 0", "vertex 4294967296"]);
    refused("3 99999999999999999999 1 2", &["corner 0", "whole"]);
    refused("3 0.5 1 2", &["corner 0", "0.5", "whole"]);
    refused("3 1e400 1 2", &["corner 0", "whole"]);
    for word in [
        "nan", "inf", "0x1", "1,5", "1_0", "--1", "e1", ".", "", "one", "1e", "½",
    ] {
        refused(&format!("3 0 {word} 2"), &["line 13"]);
    }
    refused("4 0 1 2 3", &["corner 3", "vertex 3"]);
    for bad in [-1, 3, i32::MIN, i32::MAX] {
        let file = little_endian(&plain(3, 1), &[&corner(), &[3], &indices(&[0, 1, bad])]);
        assert_refused(&file, &["element face 0", "corner 2", &format!("vertex {bad},")]);
    }
    let header = plain(3, 1).replace("uchar int", "uchar float");
    for (bad, shown) in [
        (0.5, "0.5"),
        (f32::NAN, "NaN"),
        (-f32::INFINITY, "-inf"),
        (2e7, "20000000"),
    ] {
        let face: Vec<u8> = [0.0, 1.0, bad].iter().flat_map(|v: &f32| v.to_le_bytes()).collect();
        assert_refused(&little_endian(&header, &[&corner(), &[3], &face]), &["corner 2", shown]);
    }
}

#[test]
fn wrong_coordinates_are_refused() {
    let refused = |word: &str, words: &[&str]| {
        for kind in ["float", "double"] {
            let header = plain(3, 1).replace("float", kind);
            let file = ascii(&header, &format!("0 0 0\n1 {word} 0\n0 1 0\n3 0 1 2\n"));
            assert_refused(&file, words);
        }
    };
    for word in ["nan", "NaN", "-nan(ind)", "inf", "-Infinity", "1.#QNAN"] {
        refused(word, &["line 11", "coordinate y", "finite"]);
    }
    for word in ["1e39", "-3.5e38", "1e400", "1e99999999999999999999", &"9".repeat(5000)] {
        refused(word, &["line 11", "coordinate y", "outside the range"]);
    }
    for word in [
        "1,5", "0x10", "1.2.3", "1e", "1e+", "+-1", "1f", "\u{FF11}", "\0", "1d3",
    ] {
        refused(word, &["line 11", "not a number", "\"y\""]);
    }
    for (bad, words) in [
        (f32::NAN, ["NaN", "finite"]),
        (f32::INFINITY, ["inf", "finite"]),
        (f32::NEG_INFINITY, ["-inf", "finite"]),
    ] {
        let mut vertices = corner();
        vertices[20..24].copy_from_slice(&bad.to_le_bytes());
        let file = little_endian(&plain(3, 1), &[&vertices, &[3], &indices(&[0, 1, 2])]);
        assert_refused(&file, &["element vertex 1", "coordinate z", words[0], words[1]]);
    }
    let header = plain(3, 1).replace("float", "double");
    let mut vertices = [0.0; 9];
    vertices[6] = -1e39;
    let vertices: Vec<u8> = vertices.iter().flat_map(|v: &f64| v.to_le_bytes()).collect();
    let file = little_endian(&header, &[&vertices, &[3], &indices(&[0, 1, 2])]);
    assert_refused(&file, &["element vertex 2", "coordinate x", "outside the range"]);
}

#[test]
fn numbers_as_programs_write_them() {
    let body = "1. -.5 +3\n1E0 2.5e-1 -0\n1e+00 034 .5E+1\n3.0 0.000 1e0 2.00\n";
    let mesh = load(&ascii(&plain(3, 1), body)).unwrap();
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
    let corners: Vec<[f32; 3]> = mesh.positions.iter().map(|p| p.to_array()).collect();
    assert_eq!(corners, [[1., -0.5, 3.], [1., 0.25, 0.], [1., 34., 5.]]);
    // Types say nothing about ascii.
    let header = plain(3, 1)
        .replace("uchar int", "char uchar")
        .replace("float y", "uchar y");
    let mesh = load(&ascii(&header, "0 300 0\n1 -2 0\n0 1.5 0\n3 0 1 2\n")).unwrap();
    assert_eq!(mesh.positions[0].y + mesh.shift.y as f32, 300.0);
    let header = plain(300, 1).replace("uchar int", "char char");
    let body = format!("{}3 0 298 299\n", "0 0 0\n".repeat(300));
    assert_eq!(triangles(&ascii(&header, &body)), [[0, 298, 299]]);
}

#[test]
fn what_is_not_used_is_skipped() {
    let header = "element empty 4000000000\n\
                  element camera 1\nproperty list uint float matrix\nproperty float view_px\n\
                  element vertex 3\nproperty list uchar short junk\nproperty float x\n\
                  property uchar flags\nproperty float y\nproperty double quality\nproperty float z\n\
                  element nothing 3\n\
                  element face 2\nproperty list uchar float texcoord\n\
                  property list uchar int vertex_indices\nproperty list int int other\n\
                  property int tag\nelement tail 1\nproperty char c\n";
    let text = "3 0.5 nan what 7\n0 0 1 0 inf 0\n2 5 6 1 1 0 ? 0\n1 9 0 1 1 . 0\n\
                6 0 0 1 0 0 1 3 0 1 2 0 5\n0 3 2 1 0 2 8 9 x\n1\n";
    let mesh = load(&ascii(header, text)).unwrap();
    assert_eq!(mesh.triangles, [[0, 1, 2], [2, 1, 0]]);
    let corners: Vec<[f32; 3]> = mesh.positions.iter().map(|p| p.to_array()).collect();
    assert_eq!(corners, [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]]);

    let float = |value: f32| value.to_le_bytes().to_vec();
    let vertex = |junk: &[u8], x: f32, y: f32| {
        [junk, &float(x), &[77], &float(y), &f64::NAN.to_le_bytes(), &float(0.0)].concat()
    };
    let body = [
        vec![1, 0, 0, 0, 9, 9, 9, 9, 8, 8, 8, 8],
        vertex(&[0], 0., 0.),
        vertex(&[2, 1, 2, 3, 4], 1., 0.),
        vertex(&[1, 1, 2], 0., 1.),
        [&[1][..], &float(0.5), &[3], &indices(&[0, 1, 2, 0, 5])].concat(),
        [&[0][..], &[3], &indices(&[2, 1, 0, 1, 4, 6])].concat(),
        vec![1],
    ];
    let body: Vec<&[u8]> = body.iter().map(Vec::as_slice).collect();
    let binary = load(&little_endian(header, &body)).unwrap();
    assert_eq!(binary, mesh);
}

#[test]
fn strips_alternate_and_restart() {
    let header = "element vertex 6\nproperty float x\nproperty float y\nproperty float z\n\
                  element tristrips 2\nproperty list int int vertex_indices\n";
    let vertices = "0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n";
    let body = format!("{vertices}10 -1 0 2 1 3 -1 -1 3 2 5\n5 0 1 2 2 3\n");
    assert_eq!(
        triangles(&ascii(header, &body)),
        [[0, 2, 1], [1, 2, 3], [3, 2, 5], [0, 1, 2], [2, 1, 2], [2, 2, 3]]
    );
    // -1 as an unsigned number.
    let unsigned = header.replace("int int", "int uint");
    let body = format!("{vertices}7 0 2 1 4294967295 3 2 5\n2 0 1\n");
    assert_eq!(triangles(&ascii(&unsigned, &body)), [[0, 2, 1], [3, 2, 5]]);
    let body = format!("{vertices}4 0 2 1 -2\n2 0 1\n");
    assert_refused(&ascii(header, &body), &["line 16", "corner 3", "vertex -2"]);
    // A restart is none in a face.
    assert_refused(&ascii_faces(&["4 0 1 2 -1"]), &["corner 3", "vertex -1"]);
    // Faces and strips of one file are in its order.
    let header = header.replace(
        "element tristrips 2",
        "element tristrips 1\nproperty list int int vertex_indices\nelement face 1",
    );
    let body = format!("{vertices}4 0 2 1 3\n3 5 4 3\n");
    assert_eq!(triangles(&ascii(&header, &body)), [[0, 2, 1], [1, 2, 3], [5, 4, 3]]);
}
