//! The pictures of two eyes: a point is shifted between them by what its depth says.

use glam::{Vec3, vec3};
use oktant_shared::camera::Camera;
use oktant_shared::frame::Frame;
use oktant_shared::ray::Ray;
use oktant_shared::sampling::REGULAR;
use oktant_shared::stereo::{ANAGLYPH, MONO, ROWS, SIDE_BY_SIDE, STACKED};
use oktant_shared::texture::NO_TEXTURE;
use oktant_tests::meshes::icosphere;
use oktant_tests::stage::{Stage, camera, frame, glowing, mean, picture};

const WIDTH: u32 = 160;
const HEIGHT: u32 = 120;
const EYE_SHIFT: f32 = 0.08;
const CONVERGENCE: f32 = 5.0;

fn eyes() -> Camera {
    Camera {
        eye_shift: EYE_SHIFT,
        convergence: CONVERGENCE,
        ..camera(vec3(1.0, 2.0, 3.0), vec3(-2.0, 1.0, -1.0), 40.0, WIDTH, HEIGHT)
    }
}

/// Where an eye sees a point, in pixels from the upper left corner, by similar triangles in f64.
fn projected(camera: &Camera, point: Vec3, eye: f64) -> [f64; 2] {
    let [forward, right, up] = [camera.forward, camera.right, camera.up].map(|v| v.as_dvec3());
    let offset = point.as_dvec3() - camera.eye.as_dvec3();
    let depth = offset.dot(forward);
    let shift = eye * f64::from(camera.eye_shift);
    // The eye stands aside, and the middle of its picture is where the line to the point of convergence goes through.
    let across = (offset.dot(right.normalize()) - shift) / depth + shift / f64::from(camera.convergence);
    let upwards = offset.dot(up.normalize()) / depth;
    [
        (across / right.length() + 1.0) / 2.0 * f64::from(camera.width),
        (1.0 - upwards / up.length()) / 2.0 * f64::from(camera.height),
    ]
}

fn points() -> impl Iterator<Item = Vec3> {
    let camera = eyes();
    let places = [(0.0, 0.0), (0.5, -0.4), (-0.6, 0.5)];
    let depths = [1.5_f32, 3.0, CONVERGENCE, 9.0, 40.0];
    depths.into_iter().flat_map(move |depth| {
        places.map(|(across, upwards)| {
            camera.eye + (camera.forward + camera.right * across + camera.up * upwards) * depth
        })
    })
}

/// Oracle: similar triangles in f64. The ray of each eye through where it should see a point passes the point within
/// 1e-6 of its depth, a few roundings.
#[test]
fn rays_of_both_eyes_pass_the_point() {
    let camera = eyes();
    for point in points() {
        for eye in [-1.0_f32, 0.0, 1.0] {
            let [x, y] = projected(&camera, point, f64::from(eye));
            let ray: Ray = camera.ray(x as f32, y as f32, eye);
            let depth = (point - camera.eye).dot(camera.forward);
            let off = ray.at(depth).distance(point);
            assert!(off <= 2e-6 * depth.max(1.0), "eye {eye}, {point}: {off}");
        }
        let [left, right] = [-1.0, 1.0].map(|eye| projected(&camera, point, eye));
        let depth = f64::from((point - camera.eye).dot(camera.forward));
        let disparity = 2.0 * f64::from(EYE_SHIFT) * (1.0 / f64::from(CONVERGENCE) - 1.0 / depth);
        let pixels = disparity / f64::from(camera.right.length()) * f64::from(WIDTH) / 2.0;
        assert!((right[0] - left[0] - pixels).abs() < 1e-5 && right[1] == left[1]);
    }
}

/// The mean place of what shines in a picture, pixels; each pixel is given as column, row and brightness.
fn centroid(pixels: impl Iterator<Item = (u32, u32, f32)>) -> [f64; 2] {
    let mut sum = [0.0_f64; 3];
    for (x, y, brightness) in pixels {
        let brightness = f64::from(brightness);
        sum[0] += (f64::from(x) + 0.5) * brightness;
        sum[1] += (f64::from(y) + 0.5) * brightness;
        sum[2] += brightness;
    }
    assert!(sum[2] > 0.0, "something shines");
    [sum[0] / sum[2], sum[1] / sum[2]]
}

/// End to end, in all ways to share a picture: a tiny ball that shines, in each eye's picture. Oracle: similar triangles
/// in f64. Tolerance: 0.05 pixels for its centre (64 samples a pixel leave some hundredths), half a pixel for the height
/// in rows, of which an eye has every other one.
#[test]
fn a_small_ball_is_where_each_eye_sees_it() {
    for point in points() {
        let camera = eyes();
        let depth = (point - camera.eye).dot(camera.forward);
        let mut stage = Stage::default();
        stage.material(glowing(NO_TEXTURE));
        stage.model.ambient = Vec3::ONE;
        let mut ball = icosphere(2);
        // Three pixels across, or more where an eye sees every other row.
        for position in &mut ball.positions {
            *position = point + *position * (depth * 0.014);
        }
        stage.mesh(&ball, 0);
        let scene = stage.build();
        for stereo in [MONO, SIDE_BY_SIDE, ROWS, STACKED, ANAGLYPH] {
            let frame = Frame {
                stereo,
                samples: 64,
                samples_per_side: 8,
                sample_count: 64,
                pattern: REGULAR,
                ..frame(&scene, camera)
            };
            let picture = picture(&scene, &frame);
            let pixels = || {
                let colors = picture.sums.iter().map(|sum| mean(*sum));
                (0..)
                    .zip(colors)
                    .map(|(i, color)| (i % picture.width, i / picture.width, color))
            };
            for eye in [-1.0_f64, 1.0] {
                let is_right = eye > 0.0;
                let [x, y] = match stereo {
                    SIDE_BY_SIDE => {
                        let half = pixels().filter(|(x, ..)| (*x >= WIDTH) == is_right);
                        centroid(half.map(|(x, y, color)| (x % WIDTH, y, color.x)))
                    }
                    STACKED => {
                        let half = pixels().filter(|(_, y, _)| (*y >= HEIGHT) == is_right);
                        centroid(half.map(|(x, y, color)| (x, y % HEIGHT, color.x)))
                    }
                    ROWS => {
                        let half = pixels().filter(|(_, y, _)| (y % 2 == 1) == is_right);
                        centroid(half.map(|(x, y, color)| (x, y, color.x)))
                    }
                    ANAGLYPH => {
                        centroid(pixels().map(|(x, y, color)| (x, y, if is_right { color.z } else { color.x })))
                    }
                    _ => centroid(pixels().map(|(x, y, color)| (x, y, color.x))),
                };
                let expected = projected(&camera, point, if stereo == MONO { 0.0 } else { eye });
                let least = if stereo == ROWS { 0.5 } else { 0.05 };
                assert!(
                    (x - expected[0]).abs() < 0.05 && (y - expected[1]).abs() < least,
                    "mode {stereo}, eye {eye}, depth {depth}: at {x}, {y}, not {expected:?}"
                );
            }
        }
    }
}
