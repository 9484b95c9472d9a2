//! One mesh in every encoding and with every type.

use oktant::mesh::Mesh;

use super::load;

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Encoding {
    Ascii,
    Little,
    Big,
}

pub const ENCODINGS: [Encoding; 3] = [Encoding::Ascii, Encoding::Little, Encoding::Big];
const INTEGERS: [&str; 6] = ["char", "uchar", "short", "ushort", "int", "uint"];
pub const TYPES: [&str; 8] = ["char", "uchar", "short", "ushort", "int", "uint", "float", "double"];

/// A file that is written value by value.
pub struct Writer {
    encoding: Encoding,
    pub bytes: Vec<u8>,
}

impl Writer {
    pub fn new(encoding: Encoding, header: &str) -> Self {
        let format = match encoding {
            Encoding::Ascii => "ascii",
            Encoding::Little => "binary_little_endian",
            Encoding::Big => "binary_big_endian",
        };
        let bytes = format!("ply\nformat {format} 1.0\n{header}end_header\n").into_bytes();
        Self { encoding, bytes }
    }

    pub fn put(&mut self, kind: &str, value: f64) {
        if self.encoding == Encoding::Ascii {
            let word = match kind {
                "float" => format!("{} ", value as f32),
                _ => format!("{value} "),
            };
            self.bytes.extend(word.as_bytes());
            return;
        }
        let mut bytes = match kind {
            "char" => (value as i8).to_le_bytes().to_vec(),
            "uchar" => (value as u8).to_le_bytes().to_vec(),
            "short" => (value as i16).to_le_bytes().to_vec(),
            "ushort" => (value as u16).to_le_bytes().to_vec(),
            "int" => (value as i32).to_le_bytes().to_vec(),
            "uint" => (value as u32).to_le_bytes().to_vec(),
            "float" => (value as f32).to_le_bytes().to_vec(),
            "double" => value.to_le_bytes().to_vec(),
            _ => panic!("{kind}"),
        };
        if self.encoding == Encoding::Big {
            bytes.reverse();
        }
        self.bytes.extend(bytes);
    }

    pub fn end_element(&mut self) {
        if self.encoding == Encoding::Ascii {
            self.bytes.push(b'\n');
        }
    }
}

/// A square pyramid without base, of which the last face is a quadrilateral.
const VERTICES: [[f64; 3]; 5] = [[0., 0., 0.], [4., 0., 0.], [4., 4., 0.], [0., 4., 0.], [2., 2., 3.]];
const FACES: [&[u32]; 5] = [&[0, 1, 4], &[1, 2, 4], &[2, 3, 4], &[3, 0, 4], &[0, 3, 2, 1]];

fn pyramid(encoding: Encoding, coordinate: &str, length: &str, index: &str) -> Mesh {
    let header = format!(
        "element vertex 5\nproperty {coordinate} x\nproperty {coordinate} y\nproperty {coordinate} z\n\
         element face 5\nproperty list {length} {index} vertex_indices\n"
    );
    let mut file = Writer::new(encoding, &header);
    for vertex in VERTICES {
        vertex.iter().for_each(|&value| file.put(coordinate, value));
        file.end_element();
    }
    for face in FACES {
        file.put(length, face.len() as f64);
        face.iter().for_each(|&corner| file.put(index, f64::from(corner)));
        file.end_element();
    }
    load(&file.bytes).unwrap()
}

#[test]
fn all_types_in_all_encodings_give_the_same_triangles() {
    let expected = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [0, 3, 2], [0, 2, 1]];
    for encoding in ENCODINGS {
        for coordinate in TYPES {
            for length in INTEGERS {
                for index in TYPES {
                    let mesh = pyramid(encoding, coordinate, length, index);
                    assert_eq!(mesh.triangles, expected);
                    for (position, vertex) in mesh.positions.iter().zip(VERTICES) {
                        let there = (position.as_dvec3() + mesh.shift).to_array();
                        assert_eq!(there, vertex, "{coordinate} {length} {index}");
                    }
                }
            }
        }
    }
}

#[test]
fn colors_of_every_type() {
    for encoding in ENCODINGS {
        for kind in TYPES {
            let full = match kind {
                "char" => continue,
                "ushort" => 65535.0,
                "float" | "double" => 1.0,
                _ => 255.0,
            };
            for names in [
                ["red", "green", "blue", "alpha"],
                ["r", "g", "b", "a"],
                ["diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"],
            ] {
                for channels in [3, 4] {
                    let mut header =
                        "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n".to_owned();
                    for name in &names[..channels] {
                        header += &format!("property {kind} {name}\n");
                    }
                    header += "element face 1\nproperty list uchar int vertex_indices\n";
                    let mut file = Writer::new(encoding, &header);
                    for i in 0..3_u8 {
                        for value in [f64::from(i), f64::from(i * i), 0.0] {
                            file.put("float", value);
                        }
                        let shares = [1.0, f64::from(i) * 0.2, 0.0, 0.6];
                        for share in &shares[..channels] {
                            let value = share * full;
                            file.put(kind, if full > 1.0 { value.round() } else { value });
                        }
                        file.end_element();
                    }
                    file.put("uchar", 3.0);
                    [0.0, 1.0, 2.0].iter().for_each(|&corner| file.put("int", corner));
                    let alpha = if channels == 4 { 153 } else { 255 };
                    let mesh = load(&file.bytes).unwrap();
                    let expected = [0, 51, 102].map(|green| [255, green, 0, alpha]);
                    assert_eq!(mesh.colors, expected, "{kind} {names:?}");
                }
            }
        }
    }
}

#[test]
fn colors_out_of_range_are_clamped() {
    let header = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                  property float red\nproperty int green\nproperty char blue\n\
                  element face 1\nproperty list uchar int vertex_indices\n";
    let mut file = Writer::new(Encoding::Little, header);
    for (red, green, blue) in [(2.0, 256.0, 127.0), (-1.0, -7.0, -1.0), (f64::NAN, 1e9, 0.0)] {
        [0.0, 0.0, 1.0, red].iter().for_each(|&value| file.put("float", value));
        file.put("int", green);
        file.put("char", blue);
    }
    file.put("uchar", 3.0);
    [0.0, 1.0, 2.0].iter().for_each(|&corner| file.put("int", corner));
    let mesh = load(&file.bytes).unwrap();
    assert_eq!(mesh.colors, [[255, 255, 127, 255], [0, 0, 0, 255], [0, 255, 0, 255]]);
}

/// A quad of two triangles and a separate triangle, each face of its own colour.
fn faces_of_colors(vertex_properties: &str, vertex_values: &str, faces: &[&str]) -> Mesh {
    let header = format!(
        "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n{vertex_properties}\
         element face {}\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n\
         property list uchar int vertex_indices\n",
        faces.len()
    );
    let mut body = String::new();
    for position in ["0 0 0", "1 0 0", "1 1 0", "0 1 0", "5 5 5"] {
        body += &format!("{position} {vertex_values}\n");
    }
    load(&super::ascii(&header, &format!("{body}{}\n", faces.join("\n")))).unwrap()
}

#[test]
fn face_colors_split_vertices() {
    const RED: [u8; 4] = [255, 0, 0, 255];
    const BLUE: [u8; 4] = [0, 0, 255, 255];
    let faces = ["255 0 0 3 0 1 2", "0 0 255 3 0 2 3", "255 0 0 3 2 1 0"];
    let own = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    for (properties, values, unused) in [("", "", [255; 4]), (own, "1 2 3", [1, 2, 3, 255])] {
        let mesh = faces_of_colors(properties, values, &faces);
        assert_eq!(mesh.triangles.len(), 3);
        for (triangle, (corners, color)) in
            mesh.triangles
                .iter()
                .zip([([0, 1, 2], RED), ([0, 2, 3], BLUE), ([2, 1, 0], RED)])
        {
            for (&copy, vertex) in triangle.iter().zip(corners) {
                assert_eq!(mesh.colors[copy as usize], color);
                assert_eq!(mesh.positions[copy as usize], mesh.positions[vertex]);
                assert_eq!(mesh.normals[copy as usize], mesh.normals[vertex]);
            }
        }
        // Only the two vertices that faces of both colours share are split.
        assert_eq!(mesh.positions.len(), 7);
        assert_eq!(mesh.colors[4], unused);
    }
}

#[test]
fn face_colors_make_no_edge() {
    // Two halves of a roof: the normals along the ridge are those of both.
    let header = "element vertex 6\nproperty float x\nproperty float y\nproperty float z\n\
                  element face 2\nproperty list uchar int vertex_indices\n\
                  property uchar r\nproperty uchar g\nproperty uchar b\n";
    let body = "-1 0 0\n0 0 1\n0 5 1\n-1 5 0\n1 0 0\n1 5 0\n4 0 1 2 3 9 9 9\n4 1 4 5 2 7 7 7\n";
    let mesh = load(&super::ascii(header, body)).unwrap();
    assert_eq!(mesh.positions.len(), 8);
    for &corner in mesh.triangles.as_flattened() {
        let corner = corner as usize;
        if mesh.positions[corner].x == 0.0 {
            assert!(mesh.normals[corner].abs_diff_eq(glam::Vec3::Z, 1e-6));
        }
    }
}

#[test]
fn a_face_without_color_keeps_that_of_its_vertices() {
    let header = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
                  property uchar red\nproperty uchar green\nproperty uchar blue\n\
                  element tristrips 1\nproperty list int int vertex_indices\n\
                  element face 1\nproperty list uchar int vertex_indices\n\
                  property uchar red\nproperty uchar green\nproperty uchar blue\n";
    let body = "0 0 0 1 1 1\n1 0 0 2 2 2\n0 1 0 3 3 3\n1 1 0 4 4 4\n3 0 1 2\n3 2 1 3 9 9 9\n";
    let mesh = load(&super::ascii(header, body)).unwrap();
    let reds = mesh
        .triangles
        .iter()
        .map(|triangle| triangle.map(|corner| mesh.colors[corner as usize][0]));
    assert_eq!(reds.collect::<Vec<_>>(), [[1, 2, 3], [9, 9, 9]]);
}

#[test]
fn incomplete_colors_and_normals_are_not_used() {
    let header = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                  property uchar red\nproperty uchar green\nproperty float nx\nproperty float ny\n\
                  property list uchar uchar blue\n\
                  element face 1\nproperty list uchar int vertex_indices\n";
    let body = "0 0 0 1 1 1 1 0\n1 0 0 1 1 1 1 0\n0 1 0 1 1 1 1 0\n3 0 1 2\n";
    let mesh = load(&super::ascii(header, body)).unwrap();
    assert!(mesh.colors.is_empty() && mesh.normals.is_empty());
}
