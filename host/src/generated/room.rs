//! A furnished room, to be seen from inside.

use super::bumpy_ball::bumpy_ball;
use crate::mesh::Mesh;
use crate::shapes::cuboid;
use glam::{DVec3, Vec3, dvec3, vec3};

/// A mesh and a view inside it, see [`crate::ray_sets::inner`].
#[derive(Clone, Debug, PartialEq)]
pub struct Interior {
    /// The room and all in it.
    pub mesh: Mesh,
    /// Where the camera is, scene units.
    pub eye: DVec3,
    /// Where it looks.
    pub target: DVec3,
}

/// Inner size of the room, metres.
const ROOM: Vec3 = vec3(8.0, 3.0, 6.0);
/// Squares along a side of a wall, and triangles of a ball.
const WALL: u32 = 64;
const BALL: u32 = 20_000;

/// A room of 8 x 3 x 6 m with y up, closed, its front inside: a table with four chairs, a shelf full of books, and six
/// bumpy balls about the size of lamps and cushions. Walls and balls are cut finely, furniture coarsely, so that large
/// and small triangles lie side by side, as in the models of architects.
pub fn room() -> Interior {
    let mut mesh = Mesh::default();
    walls(&mut mesh);
    table(&mut mesh, vec3(0.6, 0.0, 0.2));
    shelf(&mut mesh, vec3(-3.78, 0.0, 0.0));
    for (center, radius) in [
        (vec3(0.6, 1.9, 0.2), 0.22),
        (vec3(0.3, 0.87, 0.1), 0.09),
        (vec3(1.0, 0.87, 0.4), 0.09),
        (vec3(3.2, 0.42, -2.2), 0.4),
        (vec3(2.5, 0.3, -2.5), 0.28),
        (vec3(-2.9, 0.32, 2.3), 0.3),
    ] {
        let ball = bumpy_ball(BALL);
        add(&mut mesh, &ball, |position| position * radius + center);
    }
    Interior {
        mesh,
        eye: dvec3(3.5, 1.7, 2.6),
        target: dvec3(-1.0, 0.9, -0.6),
    }
}

/// The six sides, cut into squares that meet at the edges, facing inwards.
fn walls(mesh: &mut Mesh) {
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let along = |i: u32| 2.0 * i as f32 / WALL as f32 - 1.0;
            let at = |i: u32, j: u32| {
                let mut corner = Vec3::ZERO;
                corner[axis] = side;
                corner[(axis + 1) % 3] = along(i);
                corner[(axis + 2) % 3] = along(j);
                corner * ROOM / 2.0 + Vec3::Y * ROOM.y / 2.0
            };
            let first = mesh.positions.len() as u32;
            let vertices = (0..=WALL).flat_map(|j| (0..=WALL).map(move |i| (i, j)));
            mesh.positions.extend(vertices.map(|(i, j)| at(i, j)));
            for j in 0..WALL {
                for i in 0..WALL {
                    let corner = |i: u32, j: u32| first + j * (WALL + 1) + i;
                    let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
                    // Axes in cyclic order make the first face towards +axis.
                    if side < 0.0 {
                        mesh.triangles.extend([[a, b, c], [a, c, d]]);
                    } else {
                        mesh.triangles.extend([[a, c, b], [a, d, c]]);
                    }
                }
            }
        }
    }
}

/// A table with a chair at each side.
fn table(mesh: &mut Mesh, place: Vec3) {
    stand(mesh, place, vec3(1.6, 0.78, 0.9), 0.04, 0.06);
    for (x, z) in [(-1.05, 0.0), (1.05, 0.0), (0.0, -0.72), (0.0, 0.72)] {
        let chair = place + vec3(x, 0.0, z);
        stand(mesh, chair, vec3(0.42, 0.46, 0.42), 0.03, 0.04);
        // The back is on the side away from the table.
        let outwards = vec3(x, 0.0, z).normalize();
        let size = if z == 0.0 {
            vec3(0.03, 0.5, 0.42)
        } else {
            vec3(0.42, 0.5, 0.03)
        };
        block(mesh, chair + outwards * 0.195 + Vec3::Y * 0.71, size);
    }
}

/// A board on four legs; its size is that of the whole.
fn stand(mesh: &mut Mesh, place: Vec3, size: Vec3, board: f32, leg: f32) {
    block(
        mesh,
        place + Vec3::Y * (size.y - board / 2.0),
        vec3(size.x, board, size.z),
    );
    for (x, z) in [(-0.45, -0.45), (-0.45, 0.45), (0.45, -0.45), (0.45, 0.45)] {
        let height = size.y - board;
        block(
            mesh,
            place + vec3(x * size.x, height / 2.0, z * size.z),
            vec3(leg, height, leg),
        );
    }
}

/// Six boards along the wall, full of books.
fn shelf(mesh: &mut Mesh, place: Vec3) {
    const LENGTH: f32 = 4.0;
    for board in 0..6_u32 {
        let height = 0.05 + 0.38 * board as f32;
        block(mesh, place + Vec3::Y * height, vec3(0.3, 0.03, LENGTH));
        if board == 5 {
            break;
        }
        let mut at = -LENGTH / 2.0;
        for book in 0_u32.. {
            let (thickness, tall) = book_size(board, book);
            if at + thickness > LENGTH / 2.0 {
                break;
            }
            let center = vec3(0.0, height + 0.015 + tall / 2.0, at + thickness / 2.0);
            block(mesh, place + center, vec3(0.2, tall, thickness * 0.96));
            at += thickness;
        }
    }
}

/// Thickness and height of a book, metres.
fn book_size(board: u32, book: u32) -> (f32, f32) {
    let mixed = (board * 8191 + book).wrapping_mul(0x9e37_79b1);
    let part = |shift: u32| (mixed >> shift & 0xff) as f32 / 255.0;
    (0.012 + 0.04 * part(24), 0.18 + 0.14 * part(16))
}

fn block(mesh: &mut Mesh, center: Vec3, size: Vec3) {
    add(mesh, &cuboid(size), |position| position + center);
}

fn add(mesh: &mut Mesh, part: &Mesh, place: impl Fn(Vec3) -> Vec3) {
    let first = mesh.positions.len() as u32;
    mesh.positions
        .extend(part.positions.iter().map(|&position| place(position)));
    mesh.triangles.extend(
        part.triangles
            .iter()
            .map(|corners| corners.map(|corner| first + corner)),
    );
}
