//! What becomes of shapes.

use super::read;
use glam::{Vec3, vec3};
use std::collections::HashMap;

#[test]
fn transforms_keep_the_outside_outside() {
    let moved = "scale = [1, -2, 0.5]\nrotate = [30, 40, 50]\ntranslate = [5, 6, 7]\n";
    for content in [
        format!("[[mesh]]\nname = 'balls'\n{moved}"),
        "up = 'z'\n[[sphere]]\ncenter = [1, 2, 3]\nradius = 2\nrotate = [10, 20, 30]\n".into(),
        "[[box]]\ncenter = [1, 2, 3]\nsize = [1, 2, 3]\nrotate = [10, 20, 30]\n".into(),
    ] {
        let mesh = read(&content).model.mesh;
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|i| mesh.positions[i as usize]);
            let normal = triangle.map(|i| mesh.normals[i as usize]).iter().sum::<Vec3>();
            let face = (b - a).cross(c - a).normalize();
            assert!(face.dot(normal.normalize()) > 0.8, "{content}: {face} and {normal}");
        }
        for normal in &mesh.normals {
            assert!((normal.length() - 1.0).abs() < 1e-5);
        }
    }
    // Scaled, then turned about x, y and z, then moved.
    let moved = read("[[mesh]]\nname = 'balls'\nscale = 2\nrotate = [90, 0, 90]\ntranslate = [0, 0, 1]\n");
    let plain = read("[[mesh]]\nname = 'balls'\n").model.mesh.positions;
    for (moved, plain) in moved.model.mesh.positions.iter().zip(plain) {
        // About x: (x, -z, y); about z: (z, x, y).
        let wanted = vec3(plain.z, plain.x, plain.y) * 2.0 + Vec3::Z;
        assert!(moved.distance(wanted) < 1e-5, "{plain} became {moved}");
    }
}

#[test]
fn shapes_have_their_stated_triangles() {
    for (content, count) in [
        ("[[sphere]]\n", 1520),
        ("[[sphere]]\ntriangles = 8\n", 8),
        ("[[sphere]]\ntriangles = 1000\n", 960),
        ("[[sphere]]\ntriangles = 1000000\n", 4 * 500 * 499),
        ("[[box]]\n", 12),
        ("[[quad]]\nedge_u = [1, 0, 0]\nedge_v = [0, 1, 0]\n", 2),
        (
            "[materials.a]\n[materials.b]\n[[checkerboard]]\nsquares = [5, 7]\nmaterials = ['a', 'b']\n",
            70,
        ),
        (
            "[[lathe]]\nprofile = [[0, 0], [1, 0], [1, 2], [0, 2]]\nslices = 10\n",
            40,
        ),
        ("[[mesh]]\nname = 'stadium'\n", 55_680),
        ("[[plane]]\n", 0),
    ] {
        let model = read(content).model;
        assert_eq!(model.mesh.triangles.len(), count, "{content}");
        assert!(model.material_ids.is_empty() || model.material_ids.len() == count);
    }
}

#[test]
fn closed_shapes_are_closed() {
    for content in [
        "[[sphere]]\n",
        "[[sphere]]\ntriangles = 8\n",
        "[[sphere]]\ncenter = [100, 0.1, 3]\nradius = 0.3\ntriangles = 5000\nrotate = [1, 2, 3]\n",
        "[[box]]\nrotate = [10, 20, 30]\n",
        "[[lathe]]\nprofile = [[0, 0], [1, 0], [1, 2], [0, 2]]\n",
        "[[lathe]]\nprofile = [[1, 0], [1.5, 0], [1.5, 2], [1, 2], [1, 0]]\n",
        "[[mesh]]\nname = 'stadium'\n",
    ] {
        let mesh = read(content).model.mesh;
        let mut edges: HashMap<_, i32> = HashMap::new();
        let bits = |i: u32| mesh.positions[i as usize].to_array().map(|x| (x + 0.0).to_bits());
        for &[a, b, c] in &mesh.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                *edges.entry((bits(from), bits(to))).or_default() += 1;
            }
        }
        for (&(from, to), &count) in &edges {
            assert_eq!(count, 1, "{content}: an edge is there twice in the same direction");
            assert!(edges.contains_key(&(to, from)), "{content}: an edge has one side only");
        }
    }
}

#[test]
fn a_checkerboard_alternates() {
    let content = "[materials.a]\nbase = 0\n[materials.b]\n[[checkerboard]]\nsize = [3, 2]\nsquares = [3, 2]\n\
                   materials = ['a', 'b']\n";
    let model = read(content).model;
    for (triangle, id) in model.mesh.triangles.iter().zip(&model.material_ids) {
        let middle = triangle.map(|i| model.mesh.positions[i as usize]).iter().sum::<Vec3>() / 3.0;
        let square = (middle.x + 1.5).floor() + (middle.z + 1.0).floor();
        assert_eq!(*id, square as u32 % 2, "at {middle}");
    }
}
