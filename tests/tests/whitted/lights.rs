//! Lights add up, and an area light is the mean of the points that it consists of.

use glam::{Vec3, vec3};
use oktant::scene::Scene;
use oktant_shared::frame::Frame;
use oktant_shared::light::{AREA, Light};
use oktant_shared::ray::Ray;
use oktant_shared::traversal::{Standard, Traversal};
use oktant_tests::stage::{Stage, camera, directional_light, frame, point_light, see};
use std::sync::Arc;

/// A shiny floor with a block on it.
fn scene(lights: Vec<Light>) -> (Arc<Scene>, Frame) {
    let mut stage = Stage::with_block();
    stage.model.lights = lights;
    let scene = stage.build();
    let frame = frame(&scene, camera(vec3(2.0, 5.0, 6.0), Vec3::ZERO, 40.0, 8, 8));
    (scene, frame)
}

/// Shines downwards.
fn area(samples_per_side: u32) -> Light {
    Light {
        kind: AREA,
        edge_u: Vec3::X * 1.5,
        edge_v: Vec3::Z * 1.2,
        samples_per_side,
        falloff_radius: 0.1,
        ..point_light(vec3(-1.2, 3.0, -0.4), vec3(9.0, 8.0, 7.0))
    }
}

/// Points all over the floor that the camera sees, some in the block's shadow, some half in it.
fn targets(scene: &Scene, eye: Vec3) -> Vec<Vec3> {
    let all = (0..2_500).map(|i| vec3((i % 50) as f32 * 0.12 - 2.97, 0.0, (i / 50) as f32 * 0.12 - 2.97));
    all.filter(|target| !Standard::any_hit(&scene.view(), &Ray::new(eye, *target - eye)))
        .collect()
}

/// Oracle: the sum of one picture for each point light in the middle of the area light's squares, dimmed by Lambert's
/// cosine at the light. Tolerance: 1e-5 of full light. That penumbrae took part is checked: the sums of points that all
/// lights, some or none reach must each be many.
#[test]
fn an_area_light_is_the_sum_of_its_points() {
    for side in [1, 2, 5] {
        let (scene, frame) = scene(vec![area(side)]);
        let light = area(side);
        let (mut full, mut half, mut none) = (0, 0, 0);
        for target in targets(&scene, frame.camera.eye) {
            let ray = Ray::new(frame.camera.eye, target - frame.camera.eye);
            let mut reached = 0;
            let mut sum = Vec3::ZERO;
            for i in 0..side * side {
                let along = |n: u32| (n as f32 + 0.5) / side as f32;
                let position = light.position + light.edge_u * along(i % side) + light.edge_v * along(i / side);
                let cosine = (position - target).normalize().y;
                let point = Light {
                    falloff_radius: light.falloff_radius,
                    ..point_light(position, light.color * (cosine / (side * side) as f32))
                };
                let one = Frame { light: point, ..frame };
                let color = see(&scene, &one, &ray).color;
                reached += u32::from(color != Vec3::ZERO);
                sum += color;
            }
            if reached == side * side {
                full += 1;
            } else if reached > 0 {
                half += 1;
            } else {
                none += 1;
            }
            let seen = see(&scene, &frame, &ray);
            assert!(
                (seen.color - sum).abs().max_element() <= 1e-5,
                "at {target}: {} and {sum}",
                seen.color
            );
        }
        println!("{side} x {side}: {full} points lit, {half} half, {none} not");
        assert!(full > 500 && none > 20 && (half > 100 || side == 1));
    }
}

/// Oracle: the sum of the pictures that each light makes alone. Tolerance: 1e-5 of full light.
#[test]
fn lights_add_up() {
    let lights = vec![
        // Below the floor.
        point_light(vec3(0.0, -2.0, 1.0), Vec3::ONE),
        point_light(vec3(2.0, 2.0, 1.0), vec3(0.5, 0.1, 0.1)),
        directional_light(vec3(-1.0, 2.0, 0.5), vec3(0.1, 0.4, 0.2)),
        area(3),
        Light {
            falloff_radius: 0.3,
            ..point_light(vec3(-2.0, 1.0, 2.0), vec3(0.1, 0.2, 0.9))
        },
    ];
    let (scene, frame) = scene(lights.clone());
    let mut shadow_rays = 0;
    for target in targets(&scene, frame.camera.eye) {
        let ray = Ray::new(frame.camera.eye, target - frame.camera.eye);
        let sum: Vec3 = lights
            .iter()
            .map(|light| {
                let alone = Frame {
                    light: *light,
                    light_count: 0,
                    ..frame
                };
                see(&scene, &alone, &ray).color
            })
            .sum();
        let all = see(&scene, &frame, &ray);
        assert!(
            (all.color - sum).abs().max_element() <= 1e-5,
            "at {target}: {} and {sum}",
            all.color
        );
        shadow_rays += all.shadow_rays;
    }
    assert!(shadow_rays > 1_500 * 9, "all of the lights ask");
}
