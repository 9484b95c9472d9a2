//! Lights that cannot matter send no shadow rays, and nothing that shows is missing for it.

use glam::{Vec3, vec3};
use oktant::picture::Picture;
use oktant::scene::Scene;
use oktant_shared::frame::Frame;
use oktant_shared::light::{AREA, Light};
use oktant_shared::material::Material;
use oktant_tests::stage::{Stage, black, camera, directional_light, frame, matte, mean, picture, point_light};
use std::sync::Arc;

/// A block on a long floor under two lights, and a third one beside them.
fn scene(beside: Option<Light>) -> (Arc<Scene>, Frame) {
    let mut stage = Stage::with_block();
    let lights = [
        Light {
            falloff_radius: 0.1,
            ..point_light(vec3(1.5, 2.0, 0.5), Vec3::splat(2.0))
        },
        Light {
            kind: AREA,
            edge_u: Vec3::X * 1.5,
            edge_v: Vec3::Z * 1.2,
            samples_per_side: 3,
            falloff_radius: 0.1,
            ..point_light(vec3(-1.2, 3.0, -0.4), vec3(2.0, 3.0, 1.0))
        },
    ];
    stage.model.lights = lights.into_iter().chain(beside).collect();
    let scene = stage.build();
    let frame = frame(&scene, camera(vec3(2.0, 3.0, 6.0), vec3(0.0, 0.5, -4.0), 60.0, 96, 64));
    (scene, frame)
}

fn rendered(beside: Option<Light>) -> Picture {
    let (scene, frame) = scene(beside);
    picture(&scene, &frame)
}

/// Shadow rays of each pixel.
fn shadow_rays(picture: &Picture) -> Vec<f32> {
    picture.work.iter().map(|work| work.y).collect()
}

/// Oracle: the same picture without the light, bit by bit; no more rays.
#[test]
fn lights_below_the_horizon_send_no_shadow_ray() {
    let below = [
        directional_light(vec3(0.0, -1.0, -1e-3), Vec3::ONE),
        point_light(vec3(0.0, -3.0, -40.0), Vec3::ONE),
    ];
    let without = rendered(None);
    for light in below {
        let with = rendered(Some(light));
        // The block's lower face is all that they reach, and it is not seen; those of its sides that are have them behind.
        assert_eq!(with.sums, without.sums);
        assert_eq!(shadow_rays(&with), shadow_rays(&without));
    }
}

/// Oracle: the same picture without the light, bit by bit where a pixel is out of its range, and no more rays there; within
/// its range, as many as a light without end sends.
#[test]
fn out_of_range_no_shadow_ray_is_sent_and_nothing_changes() {
    for light in [
        point_light(vec3(1.0, 1.0, 0.5), Vec3::ONE),
        Light {
            kind: AREA,
            edge_u: Vec3::X * 0.2,
            edge_v: Vec3::Z * 0.2,
            samples_per_side: 2,
            falloff_radius: 0.1,
            ..point_light(vec3(1.0, 1.0, 0.5), Vec3::ONE)
        },
    ] {
        let without = rendered(None);
        let endless = rendered(Some(light));
        let with = rendered(Some(Light { range: 2.5, ..light }));
        let [before, all, now] = [&without, &endless, &with].map(shadow_rays);
        let mut spared = 0;
        let mut sent = 0;
        for (pixel, now) in now.into_iter().enumerate() {
            let (before, all) = (before[pixel], all[pixel]);
            assert!((before <= now) & (now <= all), "{pixel}: {before}, {now}, {all}");
            if now == before {
                assert_eq!(with.sums[pixel], without.sums[pixel], "{pixel}");
            }
            spared += u32::from(now < all);
            sent += u32::from(now > before);
        }
        println!("{spared} pixels spared, {sent} with more rays");
        assert!(spared > 1_000 && sent > 300, "{spared}, {sent}");
    }
}

/// What is out of range of all lights is as dark as without lights, and asks nothing.
#[test]
fn a_picture_out_of_range_costs_no_shadow_rays() {
    let mut stage = Stage::default();
    stage.material(matte(Vec3::ONE));
    stage.plane(Vec3::ZERO, Vec3::Y, 0);
    stage.model.lights = vec![Light {
        range: 2.0,
        ..point_light(Vec3::Y * 2.5, Vec3::ONE)
    }];
    let scene = stage.build();
    let frame = frame(&scene, camera(vec3(0.0, 2.0, 4.0), Vec3::ZERO, 60.0, 32, 24));
    let picture = picture(&scene, &frame);
    assert_eq!(shadow_rays(&picture).iter().sum::<f32>(), 0.0);
}

/// Oracle: Blinn's formula in f64. Of a highlight the edge is the last that is seen: it is culled where less than a twentieth of a
/// step of 8 bits is left of it, however bright the light and however long the exposure.
#[test]
fn no_light_that_shows_is_culled() {
    for (brightness, exposure) in [(1.0_f32, 1.0_f32), (300.0, 1.0), (1.0, 256.0), (40.0, 16.0)] {
        let mut stage = Stage::default();
        stage.material(Material {
            specular: Vec3::ONE,
            exponent: 20.0,
            ..black()
        });
        stage.plane(Vec3::ZERO, Vec3::Y, 0);
        let light = vec3(0.0, 2.0, -1.0);
        stage.model.lights = vec![point_light(light, Vec3::splat(brightness))];
        let scene = stage.build();
        let eye = vec3(0.0, 2.0, 4.0);
        let [width, height] = [96, 64];
        let frame = Frame {
            exposure,
            ..frame(&scene, camera(eye, Vec3::ZERO, 100.0, width, height))
        };
        let picture = picture(&scene, &frame);
        let mut culled = 0;
        let mut worst = 0.0_f64;
        for (index, (sum, work)) in (0..).zip(picture.sums.iter().zip(&picture.work)) {
            let (x, y) = ((index % width) as f32 + 0.5, (index / width) as f32 + 0.5);
            let ray = frame.camera.ray(x, y, 0.0);
            if ray.direction.y >= 0.0 {
                continue;
            }
            let place = ray.origin.as_dvec3() - ray.direction.as_dvec3() * f64::from(ray.origin.y / ray.direction.y);
            let [to_light, to_eye] = [light, eye].map(|end| (end.as_dvec3() - place).normalize());
            let wanted = (to_light + to_eye).normalize().y.powi(20) * f64::from(brightness);
            // Where the highlight is, roundings are of its own size.
            let off = (f64::from(mean(*sum).x) - wanted).abs() - 1e-4 * wanted;
            worst = worst.max(off * f64::from(exposure));
            culled += u32::from(work.y == 0.0);
        }
        println!("light of {brightness}, exposed {exposure} times: off by {worst:.1e}, {culled} pixels culled");
        assert!(worst <= 1.0 / 65_536.0, "{brightness}, {exposure}");
        assert!(culled > 100, "{brightness}, {exposure}: {culled}");
    }
}
