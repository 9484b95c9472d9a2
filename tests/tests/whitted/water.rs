//! Water in a glass: nested media, whose surfaces overlap so that no gap is between them.

use super::layers::{Layer, through};
use glam::{DVec3, Vec3, dvec3, vec3};
use oktant::mesh::Mesh;
use oktant_shared::material::Material;
use oktant_shared::ray::Ray;
use oktant_tests::meshes::{hexahedron, turned_inside_out};
use oktant_tests::stage::{Stage, camera, clear, frame, glowing, leaves_towards, see};

const GLASS: f64 = 1.5;
const WATER: f64 = 1.33;
const PERIOD: f32 = 32.0;
const WALL: f64 = -5.0;
/// The scene's centre: in the middle of what the wall's texture can tell.
const CENTER: f32 = 16.0;

/// A flat surface, nearly level: its height at the centre, and its slopes.
#[derive(Clone, Copy)]
struct Face {
    height: f64,
    slope: [f64; 2],
}

impl Face {
    fn at(&self, x: f32, y: f32) -> Vec3 {
        let height = self.height + self.slope[0] * f64::from(x) + self.slope[1] * f64::from(y);
        vec3(CENTER + x, CENTER + y, height as f32)
    }

    fn between(&self, from: f64, to: f64) -> Layer {
        let center = f64::from(CENTER);
        Layer {
            point: dvec3(center, center, self.height),
            normal: dvec3(-self.slope[0], -self.slope[1], 1.0),
            from,
            to,
        }
    }

    fn moved(&self, by: f64) -> Face {
        Face {
            height: self.height + by,
            ..*self
        }
    }
}

/// What is between two faces, so wide to each side.
fn body(low: Face, high: Face, half: f32) -> Mesh {
    hexahedron(std::array::from_fn(|i| {
        let side = |bit: usize| if i >> bit & 1 == 0 { -half } else { half };
        let face = if i < 4 { low } else { high };
        face.at(side(0), side(1))
    }))
}

/// The glass from outside, from above: its wall, its hollow, the wall again. No two faces are parallel, so that
/// directions tell of every index on the way.
const TOP: Face = Face {
    height: 2.0,
    slope: [0.05, -0.02],
};
const HOLLOW_TOP: Face = Face {
    height: 1.0,
    slope: [-0.06, 0.04],
};
const HOLLOW_BOTTOM: Face = Face {
    height: -1.0,
    slope: [0.03, 0.07],
};
const BOTTOM: Face = Face {
    height: -2.0,
    slope: [-0.02, -0.05],
};

/// Traces rays that start at a height through a glass of water that reaches so far into the wall, and compares where
/// they meet the floor, and in which direction they leave, with the path through the layers.
fn rays_pass(name: &str, start: f64, reach: f64, priorities: [u32; 2], layers: &[Layer]) {
    // From inside of the glass steeper ones are all reflected.
    let steepest = if start > TOP.height { 40.0 } else { 24.0 };
    let stage = |with_floor: bool| {
        let mut stage = Stage::default();
        let texture = stage.position_texture(PERIOD);
        let floor = stage.material(glowing(texture));
        let medium = |ior: f64, priority| Material {
            priority,
            ..clear(ior as f32)
        };
        let glass = stage.material(medium(GLASS, priorities[0]));
        let water = stage.material(medium(WATER, priorities[1]));
        stage.mesh(&body(BOTTOM, TOP, 3.6), glass);
        stage.mesh(&turned_inside_out(body(HOLLOW_BOTTOM, HOLLOW_TOP, 3.0)), glass);
        let (low, high) = (HOLLOW_BOTTOM.moved(-reach), HOLLOW_TOP.moved(reach));
        stage.mesh(&body(low, high, 3.0 + reach as f32), water);
        if with_floor {
            stage.plane(Vec3::Z * WALL as f32, Vec3::Z, floor);
        }
        stage.model.ambient = Vec3::ONE;
        stage.build()
    };
    let (on_floor, in_the_open) = (stage(true), stage(false));
    let mut worst = [0.0_f64; 2];
    for part in [0.0_f32, 0.3, 0.6, 1.0] {
        let degrees = part * steepest;
        for turn in [0.1_f32, 1.7, 3.0, 5.1] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let direction = vec3(turn.cos() * sin, turn.sin() * sin, -cos);
            // Towards the middle of all.
            let eye = vec3(CENTER, CENTER, 0.0) - direction * (start as f32 / cos);
            let eye = vec3(eye.x + 0.2, eye.y - 0.3, start as f32);
            let ray = Ray::new(eye, direction);
            let (out, away) = through(eye.as_dvec3(), direction.as_dvec3(), layers);
            let expected = out + away * ((WALL - out.z) / away.z);
            let view = camera(eye, eye + direction, 40.0, 8, 8);
            let place = Stage::position(see(&on_floor, &frame(&on_floor, view), &ray).color, PERIOD);
            let off = DVec3::new(place[0], place[1], WALL).distance(expected);
            let turned = leaves_towards(&in_the_open, &frame(&in_the_open, view), &ray).distance(away);
            assert!(
                off <= 4e-5 && turned <= 3e-6,
                "{name}, {degrees} degrees, turned by {turn}: {off} from the place and {turned} from the direction"
            );
            worst = [worst[0].max(off), worst[1].max(turned)];
        }
    }
    println!(
        "{name}: at most {:.1e} off on the floor, {:.1e} in direction",
        worst[0], worst[1]
    );
}

/// Oracle: the path through the layers in f64, one after the other. Tolerances: 4e-5 units on the floor (a few
/// roundings of places at coordinates of 16, on triangles of 7 units), 3e-6 for the direction.
#[test]
fn rays_take_the_analytic_path() {
    let glass_of_water = [
        TOP.between(1.0, GLASS),
        HOLLOW_TOP.between(GLASS, WATER),
        HOLLOW_BOTTOM.between(WATER, GLASS),
        BOTTOM.between(GLASS, 1.0),
    ];
    rays_pass("the glass has priority", 4.0, 0.1, [2, 1], &glass_of_water);
    rays_pass("it hardly overlaps", 4.0, 1e-4, [2, 1], &glass_of_water);
    let (water_top, water_bottom) = (HOLLOW_TOP.moved(0.1), HOLLOW_BOTTOM.moved(-0.1));
    let mut water_first = glass_of_water;
    water_first[1] = water_top.between(GLASS, WATER);
    water_first[2] = water_bottom.between(WATER, GLASS);
    rays_pass("the water has priority", 4.0, 0.1, [1, 2], &water_first);
    let mut last_entered = glass_of_water;
    last_entered[1] = water_top.between(GLASS, WATER);
    rays_pass("neither: what is entered last", 4.0, 0.1, [3, 3], &last_entered);
    let gap = [
        TOP.between(1.0, GLASS),
        HOLLOW_TOP.between(GLASS, 1.0),
        HOLLOW_TOP.moved(-0.1).between(1.0, WATER),
        HOLLOW_BOTTOM.moved(0.1).between(WATER, 1.0),
        HOLLOW_BOTTOM.between(1.0, GLASS),
        BOTTOM.between(GLASS, 1.0),
    ];
    rays_pass("with air in between", 4.0, -0.1, [2, 1], &gap);
}

/// As above, but the camera stands in the water, in the glass, where both overlap, and in the gap of air.
#[test]
fn rays_that_start_inside_take_the_analytic_path() {
    let from_water = [HOLLOW_BOTTOM.between(WATER, GLASS), BOTTOM.between(GLASS, 1.0)];
    rays_pass("from the water", 0.0, 0.1, [2, 1], &from_water);
    let from_glass = [
        HOLLOW_TOP.between(GLASS, WATER),
        HOLLOW_BOTTOM.between(WATER, GLASS),
        BOTTOM.between(GLASS, 1.0),
    ];
    rays_pass("from the glass", 1.5, 0.1, [2, 1], &from_glass);
    rays_pass("from where both are", 1.05, 0.1, [2, 1], &from_glass);
    let from_gap = [
        HOLLOW_TOP.moved(-0.1).between(1.0, WATER),
        HOLLOW_BOTTOM.moved(0.1).between(WATER, 1.0),
        HOLLOW_BOTTOM.between(1.0, GLASS),
        BOTTOM.between(GLASS, 1.0),
    ];
    rays_pass("from the gap", 0.927, -0.1, [2, 1], &from_gap);
}
