//! Rays that leave a surface do not meet it again, whatever the scale and wherever the scene is.

use glam::{Vec3, vec3};
use oktant::media::media_at;
use oktant::mesh::Mesh;
use oktant_shared::environment::Environment;
use oktant_shared::frame::Frame;
use oktant_shared::optics::{reflected, refracted};
use oktant_shared::ray::Ray;
use oktant_shared::scene::World;
use oktant_shared::surface::Surface;
use oktant_shared::trace::{any_hit, closest_hit};
use oktant_shared::traversal::Standard;
use oktant_shared::variant::EVERYTHING;
use oktant_tests::meshes::icosphere;
use oktant_tests::stage::{Stage, camera, clear, frame, see};

/// How often a ray met what it must not.
#[derive(Debug, Default, PartialEq)]
struct False {
    reflected: u32,
    shadow: u32,
    entering: u32,
    leaving: u32,
    grazing: u32,
}

/// Follows a ray into a convex body of glass and out again, as the tracer does.
fn follow(frame: &Frame, world: &World<'_>, ray: &Ray, random: &mut fastrand::Rng, found: &mut False) -> bool {
    let hit = closest_hit::<Standard, EVERYTHING>(frame, world, ray);
    if !hit.is_hit() {
        return false;
    }
    let surface = Surface::new::<EVERYTHING>(frame, world, ray, &hit);
    assert!(surface.from_front);
    let direction = ray.direction.normalize();
    let meets =
        |origin: Vec3, direction: Vec3| closest_hit::<Standard, EVERYTHING>(frame, world, &Ray::new(origin, direction));
    found.reflected += u32::from(meets(surface.front_origin(), reflected(direction, surface.normal)).is_hit());
    let light = loop {
        let light = Vec3::from_array(std::array::from_fn(|_| random.f32() * 2.0 - 1.0));
        if light.dot(surface.side) > 1e-3 {
            break light;
        }
    };
    let shadow = Ray {
        t_max: 1e3,
        ..Ray::new(surface.front_origin(), light)
    };
    found.shadow += u32::from(any_hit::<Standard, EVERYTHING>(frame, world, &shadow));
    // In, and out where it first can.
    let mut inside = Ray::new(
        surface.back_origin(),
        refracted(direction, surface.normal, 1.0, 1.5).direction,
    );
    for _ in 0..4 {
        let hit = closest_hit::<Standard, EVERYTHING>(frame, world, &inside);
        if !hit.is_hit() {
            // So near an edge, and out again at once, that the displaced origin lies outside already.
            found.grazing += 1;
            return true;
        }
        let surface = Surface::new::<EVERYTHING>(frame, world, &inside, &hit);
        if surface.from_front {
            found.entering += 1;
            return true;
        }
        let out = refracted(inside.direction, surface.normal, 1.5, 1.0);
        if !out.total {
            found.leaving += u32::from(meets(surface.back_origin(), out.direction).is_hit());
            return true;
        }
        inside = Ray::new(surface.front_origin(), reflected(inside.direction, surface.normal));
    }
    true
}

fn sphere(subdivisions: u32, radius: f32, center: Vec3) -> Mesh {
    let mut mesh = icosphere(subdivisions);
    for position in &mut mesh.positions {
        *position = center + *position * radius;
    }
    mesh
}

/// Places of the ball that the following tests try: radius, centre, distance of the camera in radii, subdivisions. Where
/// coordinates are large the triangles are too, so that rounding leaves the ball convex.
const PLACES: [(f32, Vec3, f32, u32); 11] = [
    (1.0, Vec3::ZERO, 3.0, 4),
    (1.0, Vec3::ZERO, 1000.0, 4),
    (1e-6, Vec3::ZERO, 3.0, 4),
    (1e-6, Vec3::ZERO, 1000.0, 4),
    (1e-3, Vec3::ZERO, 3.0, 4),
    (1e3, Vec3::ZERO, 3.0, 4),
    (1e3, Vec3::ZERO, 1000.0, 4),
    (1e6, Vec3::ZERO, 3.0, 4),
    (1e6, Vec3::ZERO, 1000.0, 4),
    (1.0, vec3(1000.0, 1234.0, -2234.0), 3.0, 2),
    (2.0, vec3(148_376.0, 1_234.0, -223_423.0), 3.0, 1),
];

/// Rays from all around that meet the ball somewhere.
fn rays(radius: f32, center: Vec3, distance: f32) -> impl Iterator<Item = Ray> {
    let mut random = fastrand::Rng::with_seed(3);
    std::iter::repeat_with(move || {
        let mut unit = || loop {
            let v = Vec3::from_array(std::array::from_fn(|_| random.f32() * 2.0 - 1.0));
            if (0.01..1.0).contains(&v.length_squared()) {
                return v.normalize();
            }
        };
        let eye = center + unit() * (radius * distance);
        let target = center + unit() * (radius * 0.99);
        Ray::new(eye, target - eye)
    })
}

/// Oracle: convexity. A ray that leaves a convex body outwards meets nothing; one that enters it next meets its inside,
/// and one that leaves it then meets nothing. None of 20,000 rays in each place may fail. Rays that cut off an edge by
/// less than the displacement are counted apart; of them there may be 1 in 1000.
#[test]
fn rays_that_leave_a_ball_do_not_meet_it() {
    for (radius, center, distance, subdivisions) in PLACES {
        let mut stage = Stage::default();
        stage.material(clear(1.5));
        stage.mesh(&sphere(subdivisions, radius, center), 0);
        let scene = stage.build();
        let world = scene.world();
        let frame = frame(&scene, camera(center + Vec3::Z * radius * 9.0, center, 40.0, 8, 8));
        let mut random = fastrand::Rng::with_seed(4);
        let mut found = False::default();
        let hits = rays(radius, center, distance)
            .take(20_000)
            .filter(|ray| follow(&frame, &world, ray, &mut random, &mut found))
            .count();
        println!("radius {radius} at {center}, from {distance} radii: {hits} hits, {found:?}");
        assert!(hits > 10_000);
        let grazing = found.grazing;
        assert_eq!(
            found,
            False {
                grazing,
                ..False::default()
            }
        );
        assert!(grazing <= hits as u32 / 1000, "{grazing} cut off edges");
    }
}

/// Oracle: a ball of something that does not bend light is met exactly twice: the tracer follows three rays, and the
/// light is that of the sky, twice tinted. Of the rays, 1 in 1000 may cut off an edge.
#[test]
fn a_clear_ball_is_entered_and_left_once() {
    for (radius, center, distance, subdivisions) in PLACES {
        let mut stage = Stage::default();
        let mut glass = clear(1.0);
        glass.transmission = vec3(0.5, 0.25, 1.0);
        stage.material(glass);
        stage.mesh(&sphere(subdivisions, radius, center), 0);
        stage.model.environment = Environment::constant(Vec3::ONE);
        let scene = stage.build();
        let frame = frame(&scene, camera(center + Vec3::Z * radius * 9.0, center, 40.0, 8, 8));
        let (mut met, mut edges) = (0, 0);
        for ray in rays(radius, center, distance).take(20_000) {
            let traced = see(&scene, &frame, &ray);
            assert!((1..=3).contains(&traced.rays));
            met += u32::from(traced.rays == 3);
            edges += u32::from(traced.rays == 2);
            assert_eq!(traced.color, glass.transmission.powf((traced.rays - 1) as f32));
        }
        assert!(met > 10_000 && edges <= met / 1000, "{edges} of {met}");
    }
}

/// Oracle: from a plane that reflects, rays go on their way at once: nothing of the plane is seen twice, and a shadow is
/// cast by nothing. Planes through the origin, along the axes and askew, and far away.
#[test]
fn rays_that_leave_a_plane_do_not_meet_it() {
    let mut random = fastrand::Rng::with_seed(5);
    for scale in [1e-6_f32, 1e-3, 1.0, 1e3, 1e6] {
        for (point, normal) in [
            (Vec3::ZERO, Vec3::Y),
            (Vec3::ZERO, vec3(0.3, 1.0, -0.2)),
            (Vec3::Y * 0.7, Vec3::Y),
            (Vec3::NEG_X, Vec3::X),
            (vec3(0.1, 0.7, -0.4), vec3(-0.5, 0.1, 0.3)),
            (vec3(1000.0, 1234.0, -2234.0), vec3(-0.5, 0.1, 0.3)),
        ] {
            let mut stage = Stage::default();
            let mut silver = clear(1.0);
            silver.mirror = Vec3::splat(0.5);
            silver.transmission = Vec3::splat(0.5);
            stage.material(silver);
            stage.plane(point * scale, normal, 0);
            let scene = stage.build();
            let world = scene.world();
            let frame = frame(&scene, camera(Vec3::ONE, Vec3::ZERO, 40.0, 8, 8));
            for _ in 0..2_000 {
                let mut vector = || Vec3::from_array(std::array::from_fn(|_| random.f32() * 2.0 - 1.0));
                let ray = Ray::new((point + vector() * 3.0) * scale, vector());
                let hit = closest_hit::<Standard, EVERYTHING>(&frame, &world, &ray);
                if !hit.is_hit() {
                    continue;
                }
                let surface = Surface::new::<EVERYTHING>(&frame, &world, &ray, &hit);
                let light = vector() * scale;
                let light = light * light.dot(surface.side).signum();
                assert!(!any_hit::<Standard, EVERYTHING>(
                    &frame,
                    &world,
                    &Ray::new(surface.front_origin(), light)
                ));
                let media = media_at(&scene, ray.origin).to_eye();
                let traced = see(&scene, &Frame { media, ..frame }, &ray);
                assert_eq!(traced.rays, 3, "one reflected, one transmitted");
            }
        }
    }
}
