//! A mirror shows the scene as a camera behind it sees it.

use glam::{DVec3, Vec3, vec3};
use oktant::balls::balls;
use oktant::scene::Scene;
use oktant::slots::Slots;
use oktant_shared::camera::Camera;
use oktant_shared::environment::Environment;
use oktant_shared::frame::Frame;
use oktant_shared::hit::Hit;
use oktant_shared::material::{Material, SMOOTH_NORMALS};
use oktant_shared::optics::reflected;
use oktant_shared::plane::PLANE;
use oktant_shared::ray::Ray;
use oktant_shared::surface::Surface;
use oktant_shared::texture::{CHECKERBOARD, Texture};
use oktant_shared::trace::closest_hit;
use oktant_shared::traversal::Standard;
use oktant_shared::variant::EVERYTHING;
use oktant_tests::meshes::quad;
use oktant_tests::stage::{Stage, camera, frame, hits, matte, mean, mirror, picture, point_light};
use std::sync::Arc;

/// A point of the mirror, and its normal: askew, beside everything.
const PLACE: Vec3 = vec3(-4.5, 1.0, 0.0);
const NORMAL: Vec3 = vec3(1.0, 0.1, 0.2);

#[derive(Clone, Copy, Debug, PartialEq)]
enum Mirror {
    None,
    Triangles,
    Plane,
}

/// Balls with highlights on a checkerboard under a gradient, with a light, all in front of the mirror.
fn scene(with: Mirror) -> (Arc<Scene>, u32) {
    let mut stage = Stage::default();
    let shiny = stage.material(Material {
        base: vec3(0.8, 0.5, 0.3),
        ambient: 1.0,
        diffuse: 0.7,
        specular: Vec3::splat(0.3),
        exponent: 30.0,
        flags: SMOOTH_NORMALS,
        ..matte(Vec3::ONE)
    });
    stage.model.textures.push(Texture {
        first: 0,
        width: 0x30_80_f0,
        height: 0xf0_e0_c0,
        kind: CHECKERBOARD,
        repeats: 8.0,
        reserved: [0; 3],
    });
    let board = stage.material(Material {
        texture: 0,
        ..matte(Vec3::ONE)
    });
    let silver = stage.material(mirror());
    stage.mesh(&balls(), shiny);
    stage.mesh(&quad(vec3(-3.0, 0.0, 3.0), Vec3::X * 6.0, Vec3::Z * -6.0), board);
    let first_of_mirror = stage.model.mesh.triangles.len() as u32;
    match with {
        Mirror::None => {}
        Mirror::Triangles => {
            let (u, v) = NORMAL.normalize().any_orthonormal_pair();
            let (u, v) = if u.cross(v).dot(NORMAL) > 0.0 { (u, v) } else { (v, u) };
            stage.mesh(&quad(PLACE - (u + v) * 8.0, u * 16.0, v * 16.0), silver);
        }
        Mirror::Plane => stage.plane(PLACE, NORMAL, silver),
    }
    stage
        .model
        .lights
        .push(point_light(vec3(2.0, 6.0, 5.0), Vec3::splat(0.8)));
    stage.model.ambient = Vec3::splat(0.2);
    stage.model.environment = Environment {
        zenith: vec3(0.2, 0.4, 0.9),
        horizon: vec3(0.9, 0.8, 0.6),
        nadir: vec3(0.1, 0.3, 0.1),
        ..Environment::constant(Vec3::ZERO)
    };
    (stage.build(), first_of_mirror)
}

/// The camera as it looks in the mirror, left and right exchanged with it: each pixel's ray is the mirrored one.
fn mirrored(camera: Camera) -> Camera {
    let normal = NORMAL.as_dvec3().normalize();
    let flip = |v: DVec3| v - normal * (2.0 * normal.dot(v));
    let direction = |v: Vec3| flip(v.as_dvec3()).as_vec3();
    Camera {
        eye: (PLACE.as_dvec3() + flip((camera.eye - PLACE).as_dvec3())).as_vec3(),
        right: direction(camera.right),
        up: direction(camera.up),
        forward: direction(camera.forward),
        ..camera
    }
}

/// What a ray sees that was reflected where another one met the mirror.
fn seen_in_mirror(scene: &Scene, frame: &Frame, pixel: u32, hit: &Hit) -> Hit {
    let camera = &frame.camera;
    let (x, y) = (pixel % camera.width, pixel / camera.width);
    let ray = camera.ray(x as f32 + 0.5, y as f32 + 0.5, 0.0);
    let world = scene.world();
    let surface = Surface::new::<EVERYTHING>(frame, &world, &ray, &Slots::of(scene).placed(hit));
    let onwards = Ray::new(surface.front_origin(), reflected(ray.direction, surface.normal));
    let seen = closest_hit::<Standard, EVERYTHING>(frame, &world, &onwards);
    if seen.triangle & PLANE != 0 {
        seen
    } else {
        world.scene.identified(seen)
    }
}

/// Oracle: the same scene without the mirror, seen by the mirrored camera. The same triangle on 99.9 % of the mirror's
/// pixels, and there the same colour to 1e-4; the rest are edges, and edges of shadows and squares. The mirrored camera
/// itself is rounded, so no pixel's ray is the same to the last bit.
fn shows_what_the_mirrored_camera_sees(with: Mirror) {
    let (scene_with, first_of_mirror) = scene(with);
    let (scene_without, _) = scene(Mirror::None);
    let before = camera(vec3(1.0, 2.6, 6.0), vec3(-3.5, 0.8, 0.0), 55.0, 480, 360);
    let frame_with = frame(&scene_with, before);
    let frame_without = frame(&scene_without, mirrored(before));
    let first = hits(&scene_with, &frame_with);
    let expected = hits(&scene_without, &frame_without);
    let shown = picture(&scene_with, &frame_with);
    let colors = picture(&scene_without, &frame_without);

    let is_mirror = |hit: &Hit| hit.is_hit() && (hit.triangle >= first_of_mirror || hit.triangle & PLANE != 0);
    let (mut pixels, mut same, mut alike, mut on_balls) = (0, 0, 0, 0);
    for (pixel, hit) in first.iter().enumerate().filter(|(_, hit)| is_mirror(hit)) {
        pixels += 1;
        let seen = seen_in_mirror(&scene_with, &frame_with, pixel as u32, hit);
        if seen.triangle == expected[pixel].triangle {
            same += 1;
            on_balls += u32::from(seen.triangle < 4_032);
            let off = mean(shown.sums[pixel]) - mean(colors.sums[pixel]);
            alike += u32::from(off.abs().max_element() <= 1e-4);
        }
    }
    println!(
        "{with:?}: of {pixels} pixels {same} show the same triangle, {alike} of them in the same colour; {on_balls} on balls"
    );
    assert!(pixels > 50_000 && on_balls > 5_000, "the mirror is in the picture");
    assert!(f64::from(same) >= 0.999 * f64::from(pixels));
    assert!(f64::from(alike) >= 0.999 * f64::from(same));
}

#[test]
fn a_mirror_of_triangles() {
    shows_what_the_mirrored_camera_sees(Mirror::Triangles);
}

#[test]
fn a_mirror_that_is_a_plane() {
    shows_what_the_mirrored_camera_sees(Mirror::Plane);
}
