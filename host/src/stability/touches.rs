//! Triangles that cells lose by rounding.

use super::builds::FAMILY;
use super::cases::{About, Test, Wrong, judged};
use super::exhibits::structures::is_apart_in_f32;
use super::report::{Role, RowReport};
use super::tally::Failure;
use crate::octree::overlapped_children;
use glam::{DVec3, Vec3};
use oktant_shared::octree::CELL_MARGIN;

/// A triangle that touches a cell at one of its corners, in whole numbers, so that it is known exactly.
struct Touch {
    corners: [Vec3; 3],
    /// Of the cell and its seven neighbours.
    center: Vec3,
    half: f32,
    /// Which of the eight.
    child: u32,
}

/// Triangles that cells lose by the rounding of f32.
pub fn rounding(count: usize) -> RowReport {
    let about = About {
        id: "build-rounding",
        family: FAMILY,
        title: "triangles that touch a cell at its corner",
        input: "triangles and cells at whole numbers below 4,096, the middle of the triangle at a corner of the cell that is \
                otherwise on one side of its plane",
        remedy: "overlap is tested in f64, with cells that are a little wider",
        fails: &["plane test in f32"],
    };
    let mut random = fastrand::Rng::with_seed(61);
    let touches: Vec<Touch> = std::iter::repeat_with(|| touch(&mut random))
        .flatten()
        .take(count)
        .collect();
    let tests: &[Test<Touch>] = &[
        ("in f64, with a margin", Role::Default, |touch| {
            let margin = CELL_MARGIN * 2.0 * touch.half;
            let children = overlapped_children(&touch.corners, touch.center, touch.half, margin);
            Wrong::when(children >> touch.child & 1 == 0, "missed")
        }),
        ("plane test in f32", Role::Exhibit, |touch| {
            let offset = |bit: u32| if touch.child >> bit & 1 == 1 { 0.5 } else { -0.5 };
            let middle = touch.center + Vec3::new(offset(0), offset(1), offset(2)) * touch.half;
            Wrong::when(is_apart_in_f32(&touch.corners, middle, 0.5 * touch.half), "missed")
        }),
    ];
    let failure = |touch: &Touch, _: &Wrong| Failure {
        corners: vec![touch.corners.map(|corner| corner.to_array()).into()],
        ..Failure::default()
    };
    about.report(judged(&touches, tests, failure))
}

fn touch(random: &mut fastrand::Rng) -> Option<Touch> {
    let mut vector = |most: i32| DVec3::from_array([(); 3].map(|()| f64::from(random.i32(-most..=most))));
    let (u, v, low) = (vector(500), vector(500), vector(1500));
    let child = random.u32(0..8);
    let edge = f64::from(2 * random.i32(1..200));
    // Exact: the products are below 2^53.
    let normal = u.cross(v);
    if normal.to_array().contains(&0.0) {
        return None;
    }
    // Eight cells with edges of `edge`; the plane goes through the child's corner that lies furthest along the normal.
    let place = |bit: u32| f64::from(child >> bit & 1);
    let low_of_child = low + DVec3::new(place(0), place(1), place(2)) * edge;
    let mut corner = low_of_child;
    for axis in 0..3 {
        if normal[axis] > 0.0 {
            corner[axis] += edge;
        }
    }
    Some(Touch {
        corners: [corner - u - v, corner + 2.0 * u - v, corner - u + 2.0 * v].map(|it| it.as_vec3()),
        center: (low + edge).as_vec3(),
        half: edge as f32,
        child,
    })
}
