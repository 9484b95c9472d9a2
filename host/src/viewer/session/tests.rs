//! What inputs do to the session.

use super::steering::{DISTANCES, wrapped};
use super::*;
use crate::view::Place;
use glam::Vec3;
use oktant_shared::orbit::Orbit;

fn session() -> Session {
    Session::new(View::default(), [800, 600], 1.0)
}

#[test]
fn the_camera_and_the_light_turn() {
    let mut session = session();
    let start = session.view;
    let drag = Input::Turn {
        right: 100.0,
        down: 50.0,
    };
    assert_eq!(session.apply(drag.clone()), Effect::Render);
    let near = |a: f32, b: f32| (a - b).abs() < 1e-3;
    assert!(near(session.view.camera.azimuth, start.camera.azimuth - 30.0));
    assert!(near(session.view.camera.elevation, start.camera.elevation + 15.0));
    assert_eq!(session.view.light, start.light);
    let camera = session.view.camera;
    session.apply(Input::TurnLight {
        right: 100.0,
        down: 50.0,
    });
    assert_eq!(session.view.camera, camera);
    assert!(near(session.view.light.azimuth, start.light.azimuth + 30.0));
    assert!(near(session.view.light.elevation, start.light.elevation - 15.0));
    session.scale = 2.0;
    session.apply(drag);
    assert!(
        (session.view.camera.azimuth - (camera.azimuth - 15.0)).abs() < 1e-3,
        "pixels are smaller"
    );
}

#[test]
fn angles_stay_in_range() {
    let mut session = session();
    for _ in 0..100 {
        session.apply(Input::Turn {
            right: 77.0,
            down: 90.0,
        });
    }
    assert_eq!(session.view.camera.elevation, 90.0);
    assert!((-180.0..180.0).contains(&session.view.camera.azimuth));
    assert_eq!(wrapped(180.0), -180.0);
    assert_eq!(wrapped(-190.0), 170.0);
    let at_the_pole = session.view;
    assert_eq!(
        session.apply(Input::Turn { right: 0.0, down: 5.0 }),
        Effect::Nothing,
        "there is nothing above the pole"
    );
    assert_eq!(session.view, at_the_pole);
}

#[test]
fn the_wheel_has_limits() {
    let mut session = session();
    let before = session.view.camera.distance;
    session.apply(Input::Zoom(2.0));
    assert!((session.view.camera.distance - before * 0.81).abs() < 1e-5);
    session.apply(Input::Zoom(1e9));
    assert_eq!(session.view.camera.distance, DISTANCES[0]);
    session.apply(Input::Zoom(-1e9));
    assert_eq!(session.view.camera.distance, DISTANCES[1]);
    assert_eq!(session.apply(Input::Zoom(-1.0)), Effect::Nothing);
}

#[test]
fn panning_follows_the_pointer() {
    // Where the target was is seen as many pixels from the middle as the pointer went.
    let mut session = session();
    session.view.camera = Place {
        azimuth: 30.0,
        elevation: 40.0,
        distance: 3.0,
    };
    session.apply(Input::Pan {
        right: 60.0,
        down: -45.0,
    });
    let view = session.view;
    let orbit = Orbit {
        center: view.target,
        radius: view.camera.distance,
        azimuth: view.camera.azimuth,
        elevation: view.camera.elevation,
        up: view.up,
    };
    let camera = oktant_shared::camera::Camera::on_orbit(&orbit, view.field_of_view, 800, 600);
    let ray = camera.ray(400.0 + 60.0, 300.0 - 45.0, 0.0);
    let nearest = ray.at(-ray.origin.dot(ray.direction) / ray.direction.length_squared());
    assert!(nearest.length() < 1e-4, "{nearest}");
}

#[test]
fn framing_fits_the_narrower_side_and_reset_goes_home() {
    let mut session = session();
    session.apply(Input::Pan { right: 9.0, down: 9.0 });
    session.apply(Input::Frame);
    assert_eq!(session.view.target, Vec3::ZERO);
    let wide = session.view.camera.distance;
    assert!((wide * 20.0_f32.to_radians().sin() - 1.0).abs() < 1e-5);
    session.apply(Input::Resize {
        size: [300, 600],
        scale: 1.0,
    });
    session.apply(Input::Frame);
    assert!(session.view.camera.distance > 1.5 * wide);
    session.apply(Input::NextSamples);
    session.apply(Input::Reset);
    let home = View {
        samples: Samples::Four,
        ..View::default()
    };
    assert_eq!(session.view, home);
    assert_eq!(session.apply(Input::Reset), Effect::Nothing);
}

#[test]
fn switches() {
    let mut session = session();
    assert_eq!(session.apply(Input::ToggleShading), Effect::Render);
    assert_eq!(session.view.shading, Shading::Flat);
    let counts: Vec<u32> = (0..4)
        .map(|_| {
            session.apply(Input::NextSamples);
            session.view.samples.count()
        })
        .collect();
    assert_eq!(counts, [4, 16, 64, 1]);
    assert_eq!(session.apply(Input::ToggleHelp), Effect::Redraw);
    assert!(session.help);
    assert_eq!(session.apply(Input::ToggleFigures), Effect::Redraw);
    assert!(!session.figures);
    assert_eq!(session.apply(Input::SwitchBackend), Effect::SwitchBackend);
    assert_eq!(session.apply(Input::Save(None)), Effect::Save(None));
    assert_eq!(session.apply(Input::Quit), Effect::Quit);
    assert_eq!(session.apply(Input::See(See::Pin([3.0, 4.0]))), Effect::Redraw);
    assert_eq!(
        session.seeing.pin.map(|pin| (pin.pixel, pin.view)),
        Some(([3, 4], session.view))
    );
    assert_eq!(session.apply(Input::Leave), Effect::Redraw, "unpins first");
    assert_eq!(session.seeing.pin, None);
    assert_eq!(session.apply(Input::Leave), Effect::Quit);
    let minimised = Input::Resize {
        size: [0, 0],
        scale: 1.0,
    };
    assert_eq!(session.apply(minimised.clone()), Effect::Render);
    assert!(!session.is_visible());
    assert_eq!(session.apply(minimised), Effect::Nothing);
}

#[test]
fn tone_and_exposure_show_the_same_picture_otherwise() {
    let mut session = session();
    assert_eq!(session.apply(Input::NextTone), Effect::Show);
    assert_eq!(session.view.tone.curve, Curve::Reinhard);
    for _ in 0..3 {
        assert_eq!(session.apply(Input::Expose(1.0)), Effect::Show);
    }
    assert_eq!(session.view.tone.exposure, 1.0, "three steps are a stop");
    session.apply(Input::Expose(-1e6));
    assert_eq!(session.view.tone.exposure, EXPOSURES[0]);
    assert_eq!(session.apply(Input::Expose(-1.0)), Effect::Nothing);
    session.apply(Input::Reset);
    assert_eq!(session.view.tone.curve, Curve::Reinhard, "how it looks stays");
}

#[test]
fn the_depth_has_limits() {
    let mut session = session();
    session.view.depth = 5;
    assert_eq!(session.apply(Input::Deepen(1)), Effect::Render);
    assert_eq!(session.view.depth, 6);
    for (steps, limit) in [(-1, 0), (1, MAX_DEPTH)] {
        for _ in 0..20 {
            session.apply(Input::Deepen(steps));
        }
        assert_eq!(session.view.depth, limit);
        assert_eq!(session.apply(Input::Deepen(steps)), Effect::Nothing);
    }
}

#[test]
fn stereo_goes_round_and_keeps_the_eyes() {
    let mut session = session();
    assert_eq!(session.apply(Input::PartEyes(1.0)), Effect::Nothing, "one eye");
    let mut modes = Vec::new();
    for _ in 0..5 {
        assert_eq!(session.apply(Input::NextStereo), Effect::Render);
        modes.push(session.view.stereo.map(|stereo| stereo.mode));
    }
    let mode = |mode| Some(mode);
    assert_eq!(
        modes,
        [
            mode(StereoMode::Anaglyph),
            mode(StereoMode::SideBySide),
            mode(StereoMode::Rows),
            mode(StereoMode::Sequential),
            None
        ]
    );
    let focus = Focus {
        center: Vec3::ZERO,
        radius: 3.0,
    };
    session.open(session.view, focus);
    session.apply(Input::NextStereo);
    let near = |a: f32, b: f32| (a - b).abs() < 1e-5;
    // A thirtieth of the distance to what the camera looks at.
    assert!(near(session.eye_distance(), 2.8 * 3.0 / 30.0));
    assert_eq!(session.apply(Input::PartEyes(1.0)), Effect::Render);
    assert!(near(session.eye_distance(), 1.1 * 2.8 * 3.0 / 30.0));
    let apart = session.eye_distance();
    session.apply(Input::Zoom(3.0));
    for _ in 0..5 {
        session.apply(Input::NextStereo);
    }
    assert_eq!(session.view.stereo.and_then(|stereo| stereo.eye_distance), Some(apart));
}
