//! Vertex normals, from the file or computed; and bounds.

use glam::{DVec3, Vec3};
use oktant::mesh::Mesh;

use super::{Random, ascii, load};

fn mesh(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Mesh {
    Mesh {
        positions: positions.iter().copied().map(Vec3::from_array).collect(),
        triangles: triangles.to_vec(),
        ..Mesh::default()
    }
}

#[test]
fn normals_of_the_file_are_normalised() {
    let header = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
                  property float nx\nproperty float ny\nproperty float nz\n\
                  element face 2\nproperty list uchar int vertex_indices\n";
    let body = "0 0 0 0 3 4\n1 0 0 -1e-30 0 0\n0 1 0 0 0 1e30\n1 1 0 0 1e-45 0\n3 0 1 2\n3 2 1 3\n";
    let normals = load(&ascii(header, body)).unwrap().normals;
    assert_eq!(normals, [Vec3::new(0.0, 0.6, 0.8), Vec3::NEG_X, Vec3::Z, Vec3::Y]);
}

#[test]
fn invalid_normals_of_the_file_are_replaced() {
    for kind in ["float", "double"] {
        let header = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
                      property float nx\nproperty float ny\nproperty float nz\n\
                      element face 1\nproperty list uchar int vertex_indices\n"
            .replace("float n", &format!("{kind} n"));
        for invalid in ["0 0 0", "nan nan nan", "inf 0 0", "-nan(ind) 0 0", "1e999 0 0"] {
            let body = format!("0 0 0 {invalid}\n1 0 0 1 0 0\n0 1 0 0 1 0\n5 5 5 {invalid}\n3 0 1 2\n");
            let normals = load(&ascii(&header, &body)).unwrap().normals;
            assert_eq!(normals, [Vec3::Z, Vec3::X, Vec3::Y, Vec3::ZERO], "{invalid}");
        }
    }
}

/// A cube's corner normal is its diagonal, whichever way the faces are cut.
#[test]
fn normals_do_not_depend_on_the_cut() {
    let corners: Vec<[f32; 3]> = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(|v| v as f32)).collect();
    let faces = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    for cut in 0..64 {
        let mut triangles = Vec::new();
        for (i, [a, b, c, d]) in faces.into_iter().enumerate() {
            if cut >> i & 1 == 0 {
                triangles.extend([[a, b, c], [a, c, d]]);
            } else {
                triangles.extend([[a, b, d], [b, c, d]]);
            }
        }
        let cube = mesh(&corners, &triangles).with_normals();
        for (normal, position) in cube.normals.iter().zip(&cube.positions) {
            let expected = (*position - 0.5).normalize();
            assert!(normal.abs_diff_eq(expected, 1e-6), "{normal} {expected}");
        }
    }
}

/// The weights by acos in f64, for random fans.
#[test]
fn normals_are_weighted_by_angle() {
    let mut random = Random(4);
    for scale in [1e-35_f32, 1e-3, 1.0, 1e30] {
        for _ in 0..200 {
            let mut point = || Vec3::from_array([(); 3].map(|()| (random.unit() as f32 - 0.5) * scale));
            let positions: Vec<Vec3> = (0..6).map(|_| point()).collect();
            let triangles = [[0, 1, 2], [3, 0, 2], [3, 4, 0], [0, 4, 5]];
            let fan = Mesh {
                positions,
                triangles: triangles.to_vec(),
                ..Mesh::default()
            }
            .with_normals();
            let mut sum = DVec3::ZERO;
            for triangle in triangles {
                let at = triangle.iter().position(|&v| v == 0).unwrap();
                let [o, p, q] = [0, 1, 2].map(|i| fan.positions[triangle[(at + i) % 3] as usize].as_dvec3());
                let (p, q) = ((p - o).normalize(), (q - o).normalize());
                sum += p.cross(q).normalize() * p.dot(q).clamp(-1.0, 1.0).acos();
            }
            let error = (fan.normals[0].as_dvec3() - sum.normalize()).length();
            assert!(error < 1e-6, "{error}");
        }
    }
}

#[test]
fn normals_without_a_direction_are_zero() {
    let corners = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [3., 3., 3.]];
    // Back to back; without area; of no triangle.
    let both = mesh(&corners, &[[0, 1, 2], [2, 1, 0]]).with_normals();
    assert_eq!(both.normals, [Vec3::ZERO; 4]);
    let flat = mesh(&corners, &[[0, 1, 1], [2, 2, 2]]).with_normals();
    assert_eq!(flat.normals, [Vec3::ZERO; 4]);
    // A triangle without area does not matter beside one with area.
    let mixed = mesh(&corners, &[[0, 1, 1], [0, 1, 2]]).with_normals();
    assert_eq!(mixed.normals, [Vec3::Z, Vec3::Z, Vec3::Z, Vec3::ZERO]);
    assert_eq!(Mesh::default().with_normals(), Mesh::default());
}

#[test]
fn given_normals_are_kept() {
    let mut given = mesh(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]], &[[0, 1, 2]]);
    given.normals = vec![Vec3::X, Vec3::ZERO, Vec3::NEG_Z];
    assert_eq!(given.with_normals().normals, [Vec3::X, Vec3::Z, Vec3::NEG_Z]);
}

/// The sums are the same for any number of threads.
#[test]
fn normals_are_deterministic() {
    let mut random = Random(5);
    let positions: Vec<[f32; 3]> = (0..1000).map(|_| [(); 3].map(|()| random.unit() as f32)).collect();
    let triangles: Vec<[u32; 3]> = (0..200_000)
        .map(|_| [(); 3].map(|()| random.below(1000) as u32))
        .collect();
    let soup = mesh(&positions, &triangles);
    let parallel = soup.clone().with_normals();
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert_eq!(parallel, one.install(|| soup.with_normals()));
}

#[test]
fn bounds_are_those_of_the_triangles() {
    assert_eq!(Mesh::default().bounds(), None);
    let corners = [[9., 9., 9.], [1., 0., -1.], [0., 2., 0.], [1., 1., 3.], [-9., 0., 0.]];
    assert_eq!(mesh(&corners, &[]).bounds(), None);
    let (min, max) = mesh(&corners, &[[1, 2, 3]]).bounds().unwrap();
    assert_eq!((min, max), (Vec3::new(0., 0., -1.), Vec3::new(1., 2., 3.)));
}
