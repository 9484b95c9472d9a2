//! What a ray visited and tested, for looking at in any 3D program.

use super::{Trace, Vec3Array};
use std::collections::HashSet;
use std::fmt::Write;

/// Corners of a box's faces, counter-clockwise from outside; bit 0 of a corner is x.
const FACES: [[usize; 4]; 6] = [
    [0, 4, 6, 2],
    [1, 3, 7, 5],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 2, 3, 1],
    [4, 5, 7, 6],
];

/// Something with a name, a colour, corners and faces.
struct Shape {
    name: String,
    color: [u8; 3],
    corners: Vec<Vec3Array>,
    faces: Vec<Vec<usize>>,
}

/// Boxes in greys, darker the deeper; the triangle that was hit in red, others that are crossed in orange, the rest in blue.
fn shapes(trace: &Trace) -> Vec<Shape> {
    let cells = trace.visits.iter().enumerate().map(|(at, visit)| {
        let sides = [visit.low, visit.high];
        let corner = |corner: usize| [0, 1, 2].map(|axis| sides[corner >> axis & 1][axis]);
        let grey = 230 - 12 * visit.depth.min(16) as u8;
        Shape {
            name: format!("{at}_{}_{}_depth_{}", visit.kind, visit.index, visit.depth),
            color: [grey; 3],
            corners: (0..8).map(corner).collect(),
            faces: FACES.map(Vec::from).into(),
        }
    });
    let mut known = HashSet::new();
    let triangles = trace
        .tests
        .iter()
        .filter(|tested| known.insert(tested.triangle))
        .map(|tested| {
            let is_hit = trace.hit.is_some_and(|hit| hit.triangle == tested.triangle);
            Shape {
                name: format!("triangle_{}", tested.triangle),
                color: match (is_hit, tested.contact) {
                    (true, _) => [220, 40, 40],
                    (_, "apart") => [60, 90, 200],
                    _ => [240, 150, 30],
                },
                corners: tested.corners.into(),
                faces: vec![vec![0, 1, 2]],
            }
        });
    cells.chain(triangles).collect()
}

/// As a PLY file (text), in colours.
pub fn ply(trace: &Trace) -> String {
    let shapes = shapes(trace);
    let count = |of: fn(&Shape) -> usize| shapes.iter().map(of).sum::<usize>();
    let mut text = format!(
        "ply\nformat ascii 1.0\ncomment oktant trace\nelement vertex {}\nproperty float x\nproperty float y\n\
         property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face {}\n\
         property list uchar int vertex_indices\nend_header\n",
        count(|shape| shape.corners.len()),
        count(|shape| shape.faces.len())
    );
    for shape in &shapes {
        let [red, green, blue] = shape.color;
        for [x, y, z] in &shape.corners {
            let _ = writeln!(text, "{x} {y} {z} {red} {green} {blue}");
        }
    }
    let mut first = 0;
    for shape in &shapes {
        for face in &shape.faces {
            let _ = writeln!(text, "{} {}", face.len(), joined(face, first));
        }
        first += shape.corners.len();
    }
    text
}

/// As an OBJ file, each cell and triangle an object of its own.
pub fn obj(trace: &Trace) -> String {
    let mut text = String::from("# oktant trace\n");
    // OBJ counts from 1.
    let mut first = 1;
    for shape in shapes(trace) {
        let _ = writeln!(text, "o {}", shape.name);
        for [x, y, z] in &shape.corners {
            let _ = writeln!(text, "v {x} {y} {z}");
        }
        for face in &shape.faces {
            let _ = writeln!(text, "f {}", joined(face, first));
        }
        first += shape.corners.len();
    }
    text
}

fn joined(face: &[usize], first: usize) -> String {
    let corners: Vec<String> = face.iter().map(|corner| (corner + first).to_string()).collect();
    corners.join(" ")
}
