//! A furnished room, made to be seen from inside.

use std::f32::consts::TAU;

use glam::{Mat3, Vec3};
use oktant::mesh::Mesh;

use super::{bare, icosphere, torus, uv_sphere};

/// A room of 6 by 5 by 2.7 m (x, y, z; z up, the floor at 0) with floorboards as long as the room, a table laid for
/// four, chairs, a shelf of books, a lamp with a bulb of a few millimetres: some 10,000 triangles between 0.1 mm and
/// 7 m long, many of them axis-parallel, coplanar or touching. The same every time.
pub fn room() -> Mesh {
    let mut furniture = Furniture::default();
    furniture.walls();
    furniture.floorboards();
    furniture.table(Vec3::new(3.1, 2.4, 0.0));
    for (turns, place) in [
        (0.0, Vec3::new(2.65, 1.75, 0.0)),
        (0.02, Vec3::new(3.55, 1.7, 0.0)),
        (0.5, Vec3::new(2.7, 3.1, 0.0)),
        (0.46, Vec3::new(3.6, 3.15, 0.0)),
    ] {
        furniture.chair(place, turns);
    }
    furniture.shelf(Vec3::new(0.02, 0.6, 0.0));
    furniture.lamp(Vec3::new(3.1, 2.4, 2.7));
    bare(furniture.positions, furniture.triangles)
}

#[derive(Default)]
struct Furniture {
    positions: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
}

impl Furniture {
    fn place(&mut self, part: &Mesh, shape: impl Fn(Vec3) -> Vec3) {
        let first = self.positions.len() as u32;
        self.positions.extend(part.positions.iter().map(|&point| shape(point)));
        self.triangles.extend(
            part.triangles
                .iter()
                .map(|corners| corners.map(|corner| corner + first)),
        );
    }

    fn cuboid(&mut self, low: Vec3, high: Vec3) {
        self.place(&cube(), |corner| low + corner * (high - low));
    }

    fn cylinder(&mut self, base: Vec3, radius: f32, height: f32, sides: u32) {
        self.place(&tube(sides), |point| base + point * Vec3::new(radius, radius, height));
    }

    fn walls(&mut self) {
        let (width, depth, height) = (6.0, 5.0, 2.7);
        let thickness = 0.1;
        let outside = Vec3::splat(thickness);
        let high = Vec3::new(width, depth, height);
        self.cuboid(-outside, Vec3::new(width, depth, 0.0) + outside.with_z(0.0));
        self.cuboid(Vec3::new(0.0, 0.0, height) - outside.with_z(0.0), high + outside);
        self.cuboid(Vec3::new(-thickness, 0.0, 0.0), Vec3::new(0.0, depth, height));
        self.cuboid(Vec3::new(width, 0.0, 0.0), Vec3::new(width + thickness, depth, height));
        self.cuboid(
            Vec3::new(-thickness, -thickness, 0.0),
            Vec3::new(width + thickness, 0.0, height),
        );
        // The wall with the window: sill, lintel and two piers.
        let wall = |x: f32, z: f32| Vec3::new(x, depth, z);
        for (low, high) in [
            (wall(-thickness, 0.0), wall(width + thickness, 0.9)),
            (wall(-thickness, 2.2), wall(width + thickness, height)),
            (wall(-thickness, 0.9), wall(1.8, 2.2)),
            (wall(4.2, 0.9), wall(width + thickness, 2.2)),
        ] {
            self.cuboid(low, high + Vec3::new(0.0, thickness, 0.0));
        }
        for bar in 0..5 {
            let x = 1.8 + 0.59 * bar as f32;
            self.cuboid(wall(x, 0.9) + Vec3::Y * 0.03, wall(x + 0.04, 2.2) + Vec3::Y * 0.07);
        }
    }

    /// Long and thin, one millimetre apart, each a little worn.
    fn floorboards(&mut self) {
        for board in 0..40 {
            let y = board as f32 * 0.125;
            let top = 0.015 + 0.0007 * ((board * 7) % 5) as f32;
            self.cuboid(Vec3::new(0.0, y, 0.0), Vec3::new(6.0, y + 0.124, top));
        }
        for (low, high) in [
            (Vec3::new(0.0, 0.0, 0.015), Vec3::new(6.0, 0.012, 0.09)),
            (Vec3::new(0.0, 4.988, 0.015), Vec3::new(6.0, 5.0, 0.09)),
        ] {
            self.cuboid(low, high);
        }
    }

    fn table(&mut self, place: Vec3) {
        let top = place + Vec3::new(0.0, 0.0, 0.72);
        self.cuboid(top - Vec3::new(0.9, 0.5, 0.0), top + Vec3::new(0.9, 0.5, 0.03));
        for (x, y) in [(-0.8, -0.4), (0.8, -0.4), (-0.8, 0.4), (0.8, 0.4)] {
            self.cylinder(place + Vec3::new(x, y, 0.0), 0.03, 0.72, 24);
        }
        let surface = top + Vec3::Z * 0.03;
        let (plate, ball) = (torus(1.0, 0.08, 40, 10), icosphere(2));
        for (x, y) in [(-0.45, -0.3), (0.45, -0.3), (-0.45, 0.3), (0.45, 0.3)] {
            let centre = surface + Vec3::new(x, y, 0.01);
            self.place(&plate, |point| centre + point * 0.11);
            self.cylinder(surface + Vec3::new(x + 0.2, y, 0.0), 0.033, 0.12, 32);
        }
        for (apple, x) in [-0.08, 0.0, 0.085].into_iter().enumerate() {
            let radius = 0.036 + 0.003 * apple as f32;
            self.place(&ball, |point| {
                surface + Vec3::new(x, 0.01 * apple as f32, radius) + point * radius
            });
        }
        // Crumbs.
        let crumb = icosphere(0);
        let mut random = fastrand::Rng::with_seed(2);
        for _ in 0..60 {
            let at = surface + Vec3::new(random.f32() * 1.6 - 0.8, random.f32() * 0.8 - 0.4, 0.0005);
            let radius = 0.0001 + 0.0004 * random.f32();
            self.place(&crumb, |point| at + point * radius);
        }
    }

    fn chair(&mut self, place: Vec3, turns: f32) {
        let rotation = Mat3::from_rotation_z(turns * TAU);
        let first = self.positions.len();
        self.cuboid(Vec3::new(-0.21, -0.21, 0.43), Vec3::new(0.21, 0.21, 0.46));
        for (x, y) in [(-0.19, -0.19), (0.19, -0.19), (-0.19, 0.19), (0.19, 0.19)] {
            self.cylinder(Vec3::new(x, y, 0.0), 0.018, 0.43, 16);
        }
        for slat in 0..5 {
            let x = -0.19 + 0.09 * slat as f32;
            self.cuboid(Vec3::new(x, -0.21, 0.46), Vec3::new(x + 0.02, -0.195, 0.88));
        }
        self.cuboid(Vec3::new(-0.21, -0.215, 0.88), Vec3::new(0.21, -0.19, 0.95));
        for point in &mut self.positions[first..] {
            *point = place + rotation * *point;
        }
    }

    fn shelf(&mut self, place: Vec3) {
        let mut random = fastrand::Rng::with_seed(1);
        for board in 0..5 {
            let height = 0.05 + 0.4 * board as f32;
            let low = place + Vec3::Z * height;
            self.cuboid(low, low + Vec3::new(0.28, 1.4, 0.02));
            if board == 4 {
                break;
            }
            let mut y = 0.02;
            while y < 1.3 {
                let thickness = 0.008 + 0.05 * random.f32();
                let size = Vec3::new(0.13 + 0.1 * random.f32(), thickness, 0.18 + 0.15 * random.f32());
                let corner = low + Vec3::new(0.01, y, 0.02);
                self.cuboid(corner, corner + size);
                // Most books touch.
                y += thickness + if random.u8(..) < 40 { 0.03 } else { 0.0 };
            }
        }
        for y in [0.0, 1.38] {
            let low = place + Vec3::Y * y;
            self.cuboid(low, low + Vec3::new(0.28, 0.02, 1.8));
        }
    }

    /// Hangs from `hook`.
    fn lamp(&mut self, hook: Vec3) {
        let shade = hook - Vec3::Z * 1.0;
        self.cylinder(shade, 0.004, 1.0, 8);
        self.place(&tube_wall(48), |point| {
            let radius = 0.25 - 0.17 * point.z;
            shade + Vec3::new(radius * point.x, radius * point.y, 0.22 * point.z - 0.12)
        });
        self.place(&uv_sphere(24, 16), |point| shade - Vec3::Z * 0.05 + point * 0.03);
        self.place(&icosphere(1), |point| shade - Vec3::Z * 0.09 + point * 0.004);
    }
}

/// The unit cube, outward.
fn cube() -> Mesh {
    let positions = (0..8_u8)
        .map(|corner| Vec3::from_array([0, 1, 2].map(|axis| f32::from(corner >> axis & 1))))
        .collect();
    let faces: [[u32; 4]; 6] = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let triangles = faces
        .into_iter()
        .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]])
        .collect();
    bare(positions, triangles)
}

/// The wall of a cylinder of radius 1 round the z axis from 0 to 1, open at both ends.
fn tube_wall(sides: u32) -> Mesh {
    let positions = (0..sides)
        .flat_map(|side| {
            let (y, x) = (TAU * side as f32 / sides as f32).sin_cos();
            [Vec3::new(x, y, 0.0), Vec3::new(x, y, 1.0)]
        })
        .collect();
    let triangles = (0..sides)
        .flat_map(|side| {
            let (a, b) = (2 * side, 2 * ((side + 1) % sides));
            [[a, b, b + 1], [a, b + 1, a + 1]]
        })
        .collect();
    bare(positions, triangles)
}

/// The same with both ends closed.
fn tube(sides: u32) -> Mesh {
    let mut tube = tube_wall(sides);
    tube.positions.extend([Vec3::ZERO, Vec3::Z]);
    let (bottom, top) = (2 * sides, 2 * sides + 1);
    for side in 0..sides {
        let (a, b) = (2 * side, 2 * ((side + 1) % sides));
        tube.triangles.extend([[bottom, b, a], [top, a + 1, b + 1]]);
    }
    tube
}

#[cfg(test)]
mod tests {
    use super::super::{bounds, is_closed};
    use super::*;

    #[test]
    fn parts_are_closed() {
        assert!(is_closed(&cube()));
        assert!(is_closed(&tube(9)));
        assert!(!is_closed(&tube_wall(9)));
    }

    #[test]
    fn the_room_holds_long_and_tiny_triangles() {
        let room = room();
        assert_eq!(room, super::room());
        assert!(
            (5_000..20_000).contains(&room.triangles.len()),
            "{}",
            room.triangles.len()
        );
        let longest_edge = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|vertex| room.positions[vertex as usize]);
            a.distance(b).max(b.distance(c)).max(c.distance(a))
        };
        let lengths: Vec<f32> = room.triangles.iter().map(longest_edge).collect();
        assert!(lengths.iter().copied().fold(0.0, f32::max) > 6.0);
        assert!(lengths.iter().copied().fold(f32::INFINITY, f32::min) < 0.001);
        let (low, high) = bounds(&room);
        assert!(low.min_element() >= -0.11 && high.x <= 6.11 && high.y <= 5.11 && high.z <= 2.81);
    }
}
