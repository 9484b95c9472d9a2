//! Texture coordinates of vertices: what counts as some, in every encoding and with every type, and where they go.

use glam::Vec2;
use oktant::mesh::Mesh;

use super::encodings::{ENCODINGS, Encoding, TYPES, Writer};
use super::{ascii, assert_refused, load};

const NAMES: [[&str; 2]; 4] = [
    ["s", "t"],
    ["u", "v"],
    ["texture_u", "texture_v"],
    ["texture_s", "texture_t"],
];

/// The header of one triangle, whose vertices have these properties before and after their position.
fn header(before: &str, after: &str) -> String {
    format!(
        "element vertex 3\n{before}property float x\nproperty float y\nproperty float z\n{after}\
         element face 1\nproperty list uchar int vertex_indices\n"
    )
}

/// A triangle whose vertices have these values of `kind` in properties of these names.
fn triangle(encoding: Encoding, kind: &str, names: &[&str], values: [&[f64]; 3]) -> Mesh {
    let properties: String = names.iter().map(|name| format!("property {kind} {name}\n")).collect();
    let mut file = Writer::new(encoding, &header("", &properties));
    for (position, values) in [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]].iter().zip(values) {
        position.iter().for_each(|&value| file.put("float", value));
        values.iter().for_each(|&value| file.put(kind, value));
        file.end_element();
    }
    file.put("uchar", 3.0);
    [0.0, 1.0, 2.0].iter().for_each(|&corner| file.put("int", corner));
    file.end_element();
    load(&file.bytes).unwrap()
}

/// The coordinates of an ascii file of one triangle with these properties after the position.
fn coordinates(properties: &str, values: [&str; 3]) -> Vec<Vec2> {
    let [a, b, c] = values;
    let body = format!("0 0 0 {a}\n1 0 0 {b}\n0 1 0 {c}\n3 0 1 2\n");
    load(&ascii(&header("", properties), &body)).unwrap().coordinates
}

#[test]
fn coordinates_of_every_name_and_type_in_all_encodings() {
    for encoding in ENCODINGS {
        for kind in TYPES {
            // Integers are numbers, not shares of their type's largest.
            let values: [[f64; 2]; 3] = match kind {
                "float" | "double" => [[0.25, 0.75], [-1.5, 0.0], [3.0, 1e-3]],
                _ => [[0.0, 1.0], [7.0, 2.0], [127.0, 0.0]],
            };
            let expected = values.map(|[s, t]| Vec2::new(s as f32, t as f32));
            for [s, t] in NAMES {
                let mesh = triangle(encoding, kind, &[s, t], values.each_ref().map(<[f64; 2]>::as_slice));
                assert_eq!(mesh.coordinates, expected, "{encoding:?} {kind} {s}");
                let turned = values.map(|[s, t]| [t, s]);
                let mesh = triangle(encoding, kind, &[t, s], turned.each_ref().map(<[f64; 2]>::as_slice));
                assert_eq!(mesh.coordinates, expected, "{encoding:?} {kind} {t}");
            }
        }
    }
}

#[test]
fn integers_of_either_sign_are_numbers() {
    for encoding in ENCODINGS {
        for (kind, least, most) in [
            ("char", -128.0, 127.0),
            ("uchar", 0.0, 255.0),
            ("short", -32_768.0, 32_767.0),
            ("ushort", 0.0, 65_535.0),
            ("int", -2_147_483_648.0, 2_147_483_647.0),
            ("uint", 0.0, 4_294_967_295.0),
        ] {
            let mesh = triangle(
                encoding,
                kind,
                &["s", "t"],
                [&[least, most], &[most, least], &[0.0, 1.0]],
            );
            let (least, most) = (least as f32, most as f32);
            let expected = [[least, most], [most, least], [0.0, 1.0]].map(Vec2::from_array);
            assert_eq!(mesh.coordinates, expected, "{encoding:?} {kind}");
        }
    }
}

#[test]
fn a_file_without_a_pair_has_no_coordinates() {
    assert!(coordinates("", [""; 3]).is_empty());
    for names in NAMES {
        for name in names {
            assert!(coordinates(&format!("property float {name}\n"), ["1"; 3]).is_empty());
            for encoding in ENCODINGS {
                let mesh = triangle(encoding, "double", &[name], [&[1.0]; 3]);
                assert!(mesh.coordinates.is_empty() && mesh.triangles == [[0, 1, 2]]);
            }
        }
    }
    // Halves of different pairs; a list; another element.
    assert!(coordinates("property float s\nproperty float v\n", ["1 2"; 3]).is_empty());
    assert!(coordinates("property float texture_u\nproperty float texture_t\n", ["1 2"; 3]).is_empty());
    assert!(coordinates("property float s\nproperty list uchar float t\n", ["1 1 2"; 3]).is_empty());
    let of_face = format!("{}property float s\nproperty float t\n", header("", ""));
    let mesh = load(&ascii(&of_face, "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 1 1\n")).unwrap();
    assert!(mesh.coordinates.is_empty());
}

#[test]
fn of_several_pairs_the_first_complete_one_counts() {
    let two = "property float texture_u\nproperty float texture_v\nproperty float u\nproperty float v\n";
    assert_eq!(coordinates(two, ["8 9 1 2"; 3]), [Vec2::new(1.0, 2.0); 3]);
    let lone = "property float s\nproperty float v\nproperty float u\n";
    assert_eq!(coordinates(lone, ["9 2 1"; 3]), [Vec2::new(1.0, 2.0); 3]);
    assert_refused(
        &ascii(&header("", "property float s\nproperty float t\nproperty int t\n"), ""),
        &["property \"t\" twice"],
    );
}

#[test]
fn numbers_that_are_not_finite_become_zero() {
    for kind in ["float", "double"] {
        for encoding in [Encoding::Little, Encoding::Big] {
            let values = [&[f64::NAN, 0.5], &[0.5, f64::INFINITY], &[f64::NEG_INFINITY, f64::NAN]];
            let mesh = triangle(encoding, kind, &["s", "t"], values.map(<[f64; 2]>::as_slice));
            assert_eq!(
                mesh.coordinates,
                [[0.0, 0.5], [0.5, 0.0], [0.0, 0.0]].map(Vec2::from_array)
            );
        }
        let properties = format!("property {kind} u\nproperty {kind} v\n");
        for invalid in ["nan", "-nan(ind)", "inf", "-Infinity", "1.#QNAN", "1e999", "-1e39"] {
            let values = [&format!("{invalid} 1"), &format!("2 {invalid}"), "3 4"];
            let expected = [[0.0, 1.0], [2.0, 0.0], [3.0, 4.0]].map(Vec2::from_array);
            assert_eq!(coordinates(&properties, values), expected, "{kind} {invalid}");
        }
    }
    let file = ascii(
        &header("", "property float u\nproperty float v\n"),
        "0 0 0 0 0\n1 0 0 1 half\n0 1 0 0 1\n3 0 1 2\n",
    );
    assert_refused(&file, &["line 13", "\"half\"", "\"v\""]);
}

#[test]
fn coordinates_stand_between_other_properties() {
    // Names that only look like coordinates, and the letters that the loader itself calls its properties by.
    let before = "property float w\nproperty float t\nproperty float nz\nproperty uchar red\nproperty float nx\n";
    let after = "property float ny\nproperty uchar blue\nproperty float s\nproperty uchar green\nproperty float c\n";
    let body = "9 2 0 1 0 0 0 0 1 3 0.5 2 9\n9 4 0 1 0 1 0 0 1 3 1.5 2 9\n9 6 0 1 0 0 1 0 1 3 2.5 2 9\n3 0 1 2\n";
    let mesh = load(&ascii(&header(before, after), body)).unwrap();
    assert_eq!(
        mesh.coordinates,
        [[0.5, 2.0], [1.5, 4.0], [2.5, 6.0]].map(Vec2::from_array)
    );
    assert_eq!(mesh.normals, [glam::Vec3::Y; 3]);
    assert_eq!(mesh.colors, [[1, 2, 3, 255]; 3]);
}

#[test]
fn vertices_split_for_face_colors_keep_their_coordinates() {
    let header = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
                  property float s\nproperty float t\n\
                  element face 2\nproperty list uchar int vertex_indices\n\
                  property uchar red\nproperty uchar green\nproperty uchar blue\n";
    let body = "0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 0.5\n0 1 0 0 0.5\n3 0 1 2 255 0 0\n3 0 2 3 0 0 255\n";
    let mesh = load(&ascii(header, body)).unwrap();
    // Two of the four vertices have both colours.
    assert_eq!(mesh.coordinates.len(), 6);
    for (position, coordinate) in mesh.positions.iter().zip(&mesh.coordinates) {
        assert_eq!(*coordinate, Vec2::new(position.x, 0.5 * position.y));
    }
    let colors = mesh
        .triangles
        .iter()
        .map(|triangle| triangle.map(|corner| mesh.colors[corner as usize]));
    assert_eq!(
        colors.collect::<Vec<_>>(),
        [[[255, 0, 0, 255]; 3], [[0, 0, 255, 255]; 3]]
    );
}

#[test]
fn a_large_mesh_has_a_coordinate_for_each_vertex() {
    // More vertices than are read at a time; far from the origin, so that text is read twice.
    let count = 20_000;
    for far in [0, 100_000_000] {
        let mut file = Writer::new(
            Encoding::Ascii,
            &super::plain(count, 1).replace("float z\n", "float z\nproperty double u\nproperty int v\n"),
        );
        for i in 0..count {
            for value in [far + i % 7, i % 3, 0, 2 * i, i] {
                file.put("double", value as f64);
            }
            file.end_element();
        }
        file.bytes.extend(b"3 0 1 2\n");
        let mesh = load(&file.bytes).unwrap();
        assert_eq!(mesh.shift == glam::DVec3::ZERO, far == 0);
        let expected: Vec<Vec2> = (0..count).map(|i| Vec2::new(2.0 * i as f32, i as f32)).collect();
        assert_eq!(mesh.coordinates, expected);
    }
}
