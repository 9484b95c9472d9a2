//! Positions: kept bit for bit, or brought near the origin.

use glam::{DVec3, Vec3};
use oktant::mesh::Mesh;

use super::{Random, ascii, assert_refused, load, plain};

fn binary(vertices: &[Vec3]) -> Mesh {
    let header = plain(vertices.len(), 1);
    let mut file = format!("ply\nformat binary_little_endian 1.0\n{header}end_header\n").into_bytes();
    for vertex in vertices {
        file.extend(vertex.to_array().iter().flat_map(|value| value.to_le_bytes()));
    }
    file.push(vertices.len() as u8);
    for corner in 0..vertices.len() as u32 {
        file.extend(corner.to_le_bytes());
    }
    load(&file).unwrap()
}

fn double(vertices: &[DVec3]) -> Mesh {
    let header = plain(vertices.len(), 1).replace("float", "double");
    let mut file = format!("ply\nformat binary_little_endian 1.0\n{header}end_header\n").into_bytes();
    for vertex in vertices {
        file.extend(vertex.to_array().iter().flat_map(|value| value.to_le_bytes()));
    }
    file.push(vertices.len() as u8);
    for corner in 0..vertices.len() as u32 {
        file.extend(corner.to_le_bytes());
    }
    load(&file).unwrap()
}

fn bits(positions: &[Vec3]) -> Vec<[u32; 3]> {
    positions.iter().map(|p| p.to_array().map(f32::to_bits)).collect()
}

#[test]
fn f32_near_the_origin_stay_bit_for_bit() {
    let mut random = Random(1);
    for scale in [1e-30, 1.0, 1e30] {
        // Fifteen diagonals from the origin is near enough.
        for centre in [0.0, 15.0] {
            let mut vertices: Vec<Vec3> = (0..100)
                .map(|_| {
                    let mut one = || ((random.unit() - 0.5 + centre) * scale) as f32;
                    Vec3::new(one(), one(), one())
                })
                .collect();
            vertices[7] = Vec3::new(-0.0, f32::from_bits(1), -f32::MIN_POSITIVE / 2.0);
            let mesh = binary(&vertices);
            assert_eq!(mesh.shift, DVec3::ZERO);
            assert_eq!(bits(&mesh.positions), bits(&vertices));
        }
    }
}

#[test]
fn far_f32_are_shifted_without_error() {
    let mut random = Random(2);
    let centre = Vec3::new(5e5, -4.6e6, 17.0);
    let vertices: Vec<Vec3> = (0..100)
        .map(|_| {
            let mut one = || random.unit() as f32 * 900.0;
            centre + Vec3::new(one(), one(), one() * 0.1)
        })
        .collect();
    let mesh = binary(&vertices);
    let (min, max) = mesh.bounds().unwrap();
    let diagonal = (max - min).length();
    assert!(((max + min) / 2.0).length() < 0.1 * diagonal, "{min} {max}");
    for (position, vertex) in mesh.positions.iter().zip(&vertices) {
        let there = position.as_dvec3() + mesh.shift;
        assert_eq!(there.truncate(), vertex.as_dvec3().truncate());
        assert!((there.z - f64::from(vertex.z)).abs() < 1e-7 * f64::from(diagonal));
    }
}

#[test]
fn a_vertex_that_no_triangle_uses_does_not_matter() {
    let header = plain(4, 1);
    let body = "0 0 0\n500000 0 0\n500001 0 0\n500000 1 0\n3 1 2 3\n";
    let mesh = load(&ascii(&header, body)).unwrap();
    assert!((mesh.shift - DVec3::new(500_000.5, 0.5, 0.0)).length() < 0.2);
    assert_eq!(mesh.positions[0].as_dvec3() + mesh.shift, DVec3::ZERO);
}

#[test]
fn doubles_keep_their_digits() {
    let mut random = Random(3);
    for (centre, size) in [
        (0.0, 1.0),
        (4_649_776.22, 0.05),
        (-1e12, 1e3),
        (1e30, 1e30),
        (1.0, 1e-9),
    ] {
        let vertices: Vec<DVec3> = (0..100)
            .map(|_| DVec3::from_array([(); 3].map(|()| centre + size * (random.unit() - 0.5))))
            .collect();
        let mesh = double(&vertices);
        for (position, vertex) in mesh.positions.iter().zip(&vertices) {
            let error = ((*vertex - mesh.shift) - position.as_dvec3()).abs().max_element();
            assert!(error <= size * 1e-7, "{centre} {error}");
        }
    }
}

#[test]
fn doubles_are_shifted_even_near_the_origin() {
    let vertices = [[10.0, 10.0, 0.0], [11.0, 10.0, 0.0], [10.0, 11.0, 0.0]].map(DVec3::from_array);
    let mesh = double(&vertices);
    assert!((mesh.shift - DVec3::new(10.5, 10.5, 0.0)).length() < 0.1);
    assert_eq!(mesh.positions[0].as_dvec3() + mesh.shift, vertices[0]);
    // A centre that rounds to zero leaves even the signs of zeros.
    let vertices = [[-1.0, -0.0, 0.0], [1.0, -0.0, 0.0], [-0.001, -0.01, 0.0]].map(DVec3::from_array);
    let mesh = double(&vertices);
    assert_eq!(mesh.shift.to_array().map(f64::to_bits), [0; 3]);
    assert_eq!(bits(&mesh.positions), bits(&vertices.map(|vertex| vertex.as_vec3())));
}

#[test]
fn ascii_floats_far_away_keep_the_digits_of_the_text() {
    let body = "500000.01 4649776.22 10\n500000.06 4649776.22 10\n500000.01 4649776.27 10\n3 0 1 2\n";
    for kind in ["float", "double"] {
        let mesh = load(&ascii(&plain(3, 1).replace("float", kind), body)).unwrap();
        let [a, b, c] = [0, 1, 2].map(|vertex: usize| mesh.positions[vertex]);
        assert!((b - a).abs_diff_eq(Vec3::new(0.05, 0.0, 0.0), 1e-8), "{}", b - a);
        assert!((c - a).abs_diff_eq(Vec3::new(0.0, 0.05, 0.0), 1e-8), "{}", c - a);
        let there = a.as_dvec3() + mesh.shift;
        assert!(there.abs_diff_eq(DVec3::new(500_000.01, 4_649_776.22, 10.0), 1e-8));
    }
}

#[test]
fn one_point_is_a_mesh_too() {
    for point in ["0 0 0", "7 8 9", "1e30 -1e30 0.1"] {
        for kind in ["float", "double"] {
            let header = plain(3, 1).replace("float", kind);
            let body = format!("{point}\n{point}\n{point}\n3 0 1 2\n");
            let mesh = load(&ascii(&header, &body)).unwrap();
            assert_eq!(mesh.positions, [Vec3::ZERO; 3]);
        }
    }
}

#[test]
fn the_largest_numbers_are_read() {
    let body = "3.4028234e38 0 0\n-3.4028234e38 0 0\n0 3.4028234e38 1e-45\n3 0 1 2\n";
    let mesh = load(&ascii(&plain(3, 1), body)).unwrap();
    assert_eq!(mesh.positions[0].x, f32::MAX);
    assert_eq!(mesh.positions[2].z, f32::from_bits(1));
    load(&ascii(&plain(3, 1).replace("float", "double"), body)).unwrap();
}

#[test]
fn a_vertex_that_leaves_the_range_by_the_shift_is_refused() {
    let header = plain(4, 1).replace("float", "double");
    let body = "3e38 0 0\n3e38 1 0\n3.1e38 0 0\n0 -3e38 0\n3 0 1 2\n";
    load(&ascii(&header, body)).unwrap();
    let body = body.replace("0 -3e38", "-3e38 0");
    assert_refused(&ascii(&header, &body), &["element vertex 3", "coordinate x", "range"]);
}
