//! Headers: what programs write, and what nobody should.

use super::{CORNER, ascii, assert_refused, load, plain};

const TRIANGLE: [[u32; 3]; 1] = [[0, 1, 2]];

#[track_caller]
fn assert_triangle(file: &[u8]) {
    let mesh = load(file).unwrap();
    assert_eq!(mesh.triangles, TRIANGLE);
    let corners: Vec<[f32; 3]> = mesh.positions.iter().map(|p| p.to_array()).collect();
    assert_eq!(corners, [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]]);
}

fn text(file: &str) -> Vec<u8> {
    file.as_bytes().to_vec()
}

fn plain_file() -> String {
    String::from_utf8(ascii(&plain(3, 1), &format!("{CORNER}3 0 1 2\n"))).unwrap()
}

#[test]
fn variants_of_the_header_are_read() {
    let file = plain_file();
    assert_triangle(file.as_bytes());
    // Comments anywhere, also of other alphabets and in no valid encoding.
    let comments = "comment\ncomment 点群 \u{1F407} \"quoted\"\nobj_info num_cols 512\nobj_info\n";
    for keyword in [
        "format",
        "element vertex",
        "property float y",
        "element face",
        "end_header",
    ] {
        assert_triangle(&text(&file.replace(keyword, &format!("{comments}{keyword}"))));
    }
    let mut bytes = file.replace("element face", "comment @\nelement face").into_bytes();
    let at = bytes.iter().position(|&b| b == b'@').unwrap();
    bytes[at] = 0xFF;
    assert_triangle(&bytes);
    // Line ends of all systems, blank lines, tabs, blanks at the end, a byte order mark.
    assert_triangle(&text(&file.replace('\n', "\r\n")));
    assert_triangle(&text(&file.replace('\n', "\r")));
    assert_triangle(&text(&file.replace('\n', " \t\n")));
    assert_triangle(&text(&file.replace('\n', "\n\n")));
    assert_triangle(&text(&file.replace(' ', "\t ")));
    assert_triangle(&text(&format!("\u{FEFF}{file}")));
    assert_triangle(&text(&format!("\u{FEFF}{}", file.replace('\n', "\r\n"))));
    assert_triangle(file.trim_end().as_bytes());
    // The format may be repeated, and stand anywhere.
    assert_triangle(&text(&file.replace("element face", "format ascii 1.0\nelement face")));
    let late = file.replace("format ascii 1.0\n", "");
    assert_triangle(&text(&late.replace("end_header", "format ascii 1.0\nend_header")));
    // Newer type names, the other list name, leading zeros.
    assert_triangle(&text(&file.replace("float", "float32")));
    assert_triangle(&text(&file.replace("uchar int", "uint8 int32")));
    assert_triangle(&text(&file.replace("vertex_indices", "vertex_index")));
    assert_triangle(&text(&file.replace("element vertex 3", "element vertex 0003")));
}

#[test]
fn a_very_long_comment_is_read() {
    let comment = format!("comment {}\nelement face", "word ".repeat(2 << 20));
    assert_triangle(&text(&plain_file().replace("element face", &comment)));
}

#[test]
fn other_formats_are_refused() {
    assert_refused(b"", &["empty"]);
    assert_refused(b"\xEF\xBB\xBF", &["empty"]);
    assert_refused(b"pl", &["not a PLY file"]);
    assert_refused(b"PLY\nformat ascii 1.0\n", &["not a PLY file"]);
    assert_refused(b"plywood\n", &["not a PLY file"]);
    assert_refused(b"ply wood\n", &["not a PLY file"]);
    assert_refused(b"\n\nply\n", &["not a PLY file"]);
    assert_refused(b"solid cube\nfacet normal 0 0 1\n", &["not a PLY file"]);
    assert_refused(b"\x1F\x8B\x08\x00\x00", &["gzip"]);
    assert_refused(b"\xFF\xFEp\0l\0y\0\n\0", &["UTF-16"]);
    assert_refused(b"\xFE\xFF\0p\0l\0y\0\n", &["UTF-16"]);
    assert_refused(b"ply", &["no end_header"]);
    assert_refused(b"ply\n", &["no end_header"]);
    assert_refused(b"ply\r", &["no end_header"]);
}

#[test]
fn broken_headers_are_refused() {
    let file = plain_file();
    let refused = |from: &str, to: &str, words: &[&str]| {
        let broken = file.replacen(from, to, 1);
        assert_ne!(broken, file);
        assert_refused(broken.as_bytes(), words);
    };
    refused("format ascii 1.0\n", "", &["no format line"]);
    refused("ascii 1.0", "ascii 2.0", &["line 2", "version 2.0"]);
    refused("ascii 1.0", "ascii", &["line 2", "names no known format"]);
    refused("ascii 1.0", "ASCII 1.0", &["line 2", "names no known format"]);
    refused("ascii 1.0", "binary 1.0", &["line 2", "binary_little_endian"]);
    refused(
        "end_header",
        "format binary_big_endian 1.0\nend_header",
        &["line 9", "contradicts"],
    );
    refused(
        "format",
        "property float x\nformat",
        &["line 2", "before the first element"],
    );
    refused(
        "element face",
        "Created by Blender3D\nelement face",
        &["line 7", "Blender3D"],
    );
    refused("element face", "ply\nelement face", &["line 7", "\"ply\""]);
    refused(
        "element face",
        "\u{1B}[31mred\u{7}\nelement face",
        &["line 7", "\\u{1b}[31mred"],
    );
    refused("element vertex 3", "element vertex", &["line 3", "element vertex"]);
    refused("element vertex 3", "element vertex 3 4", &["line 3"]);
    for count in ["-3", "3.0", "three", "1e3", "0x3", "99999999999999999999999", "+3"] {
        refused(
            "element vertex 3",
            &format!("element vertex {count}"),
            &["line 3", count],
        );
    }
    refused("float x", "half x", &["line 4", "\"half\"", "float and double"]);
    refused("float x", "int64 x", &["line 4", "\"int64\""]);
    refused("float x", "float", &["line 4"]);
    refused("float x", "float x y", &["line 4"]);
    refused("uchar int", "float int", &["line 8", "\"float\"", "list length"]);
    refused("uchar int", "uchar", &["line 8"]);
    refused("end_header", "end_header now", &["line 9", "end_header now"]);
    let long = format!("{}\nelement face", "x".repeat(10 << 20));
    refused("element face", &long, &["line 7", "xxx..."]);
}

#[test]
fn headers_without_a_mesh_are_refused() {
    let file = plain_file();
    let refused = |from: &str, to: &str, words: &[&str]| {
        assert_refused(file.replace(from, to).as_bytes(), words);
    };
    refused(
        "element vertex",
        "element point",
        &["no element \"vertex\"", "3 \"point\""],
    );
    refused("element face 1", "element face 0", &["no faces", "3 \"vertex\""]);
    refused("element face", "element facet", &["no faces", "1 \"facet\""]);
    refused("vertex_indices", "corners", &["\"face\"", "vertex_indices"]);
    refused("list uchar int", "int", &["\"face\"", "list"]);
    refused("float z", "float height", &["\"z\""]);
    refused("float x", "list uchar float x", &["\"x\""]);
    refused("float y", "float y\nproperty float x", &["property \"x\" twice"]);
    refused(
        "element face",
        "element vertex 3\nelement face",
        &["line 7", "\"vertex\"", "twice"],
    );
    refused(
        "end_header",
        "element face 1\nend_header",
        &["line 9", "\"face\"", "twice"],
    );
    assert_refused(b"ply\nformat ascii 1.0\nend_header\n", &["no elements at all"]);
    assert_refused(&ascii(&plain(0, 0), ""), &["no faces"]);
    assert_refused(&ascii(&plain(0, 1), "3 0 1 2\n"), &["line 10", "no vertices"]);
    assert_refused(&ascii(&plain(1, 1), "0 0 0\n3 0 0 1\n"), &["vertex 1", "only vertex 0"]);
}

#[test]
fn unused_elements_may_be_repeated() {
    let body = format!("7\n8\n{CORNER}9\n3 0 1 2\n");
    let header = plain(3, 1).replace("element face", "element junk 1\nproperty int a\nelement face");
    let header = format!("element junk 2\nproperty int a\n{header}");
    assert_triangle(&ascii(&header, &body));
}

#[test]
fn a_header_of_old_macs_ends_at_its_carriage_return() {
    // The first byte of the data is a newline, which is no part of the header's end.
    let header = "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\n\
                  property uchar y\nproperty uchar z\nelement face 1\n\
                  property list uchar uchar vertex_indices\nend_header\n";
    let body = [10, 0, 0, 11, 0, 0, 10, 1, 0, 3, 0, 1, 2];
    for end in ["\r", "\n", "\r\n", " \n"] {
        let mut file = header.replace('\n', end).into_bytes();
        file.extend(body);
        let mesh = load(&file).unwrap();
        assert_eq!(mesh.triangles, TRIANGLE, "{end:?}");
        assert_eq!(mesh.positions[0].to_array(), [10.0, 0.0, 0.0], "{end:?}");
        assert_eq!(mesh.positions[2].to_array(), [10.0, 1.0, 0.0], "{end:?}");
    }
}
