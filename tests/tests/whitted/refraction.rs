//! Snell's law, Fresnel's equations and total internal reflection, against f64.

use glam::{DVec3, Vec3};
use oktant_shared::environment::Environment;
use oktant_shared::material::{FRESNEL, Material};
use oktant_shared::optics::refracted;
use oktant_shared::ray::Ray;
use oktant_tests::meshes::quad;
use oktant_tests::stage::{Stage, camera, clear, frame, leaves_towards, see};

/// From the thinner into the denser medium and back; air, water, glass, diamond, and hot over cold air.
const BOUNDARIES: [(f32, f32); 10] = [
    (1.0, 1.5),
    (1.5, 1.0),
    (1.0, 1.33),
    (1.33, 1.0),
    (1.33, 1.5),
    (1.5, 1.33),
    (1.0, 2.42),
    (2.42, 1.0),
    (1.0, 1.0003),
    (1.0003, 1.0),
];

/// The refracted unit vector by Snell's law in the plane of incidence; none where all is reflected.
fn snell(direction: DVec3, normal: DVec3, from: f32, to: f32) -> Option<DVec3> {
    let (direction, normal) = (direction.normalize(), normal.normalize());
    let tangent = direction - normal * normal.dot(direction);
    let sine = tangent.length() * f64::from(from) / f64::from(to);
    if sine >= 1.0 {
        return None;
    }
    let along = if sine == 0.0 { DVec3::ZERO } else { tangent.normalize() };
    Some(along * sine - normal * (1.0 - sine * sine).sqrt())
}

/// The angle from which on all is reflected, degrees; 90 where there is none.
fn critical_angle(from: f32, to: f32) -> f64 {
    (f64::from(to) / f64::from(from)).min(1.0).asin().to_degrees()
}

/// A unit vector that meets a surface with that normal at an angle in degrees.
fn incoming(normal: Vec3, angle: f64, turn: f64) -> Vec3 {
    let (u, v) = normal.as_dvec3().any_orthonormal_pair();
    let (sin, cos) = angle.to_radians().sin_cos();
    let aside = u * turn.cos() + v * turn.sin();
    (aside * sin - normal.as_dvec3() * cos).as_vec3()
}

fn normals(count: usize) -> impl Iterator<Item = Vec3> {
    let mut random = fastrand::Rng::with_seed(11);
    std::iter::repeat_with(move || Vec3::from_array(std::array::from_fn(|_| random.f32() - 0.5)).normalize())
        .take(count)
}

/// Oracle: Snell's law in f64 for the same rounded vectors. Tolerance: 1e-6 as a distance of unit vectors, 16 units in
/// the last place; 1e-4 within 0.1 degree of the critical angle, where the cosine beyond is the root of a difference.
#[test]
fn refracted_rays_follow_snell_both_ways() {
    let (mut worst, mut worst_near_critical) = (0.0_f64, 0.0_f64);
    for (from, to) in BOUNDARIES {
        let critical = critical_angle(from, to);
        for (i, normal) in normals(20).enumerate() {
            for step in 0..=8990 {
                let angle = f64::from(step) / 100.0;
                let direction = incoming(normal, angle, i as f64);
                let refraction = refracted(direction, normal, from, to);
                let exact = snell(direction.as_dvec3(), normal.as_dvec3(), from, to);
                let is_near_critical = critical < 90.0 && (angle - critical).abs() < 0.1;
                match exact {
                    Some(exact) if !refraction.total => {
                        let error = exact.distance(refraction.direction.as_dvec3());
                        if is_near_critical {
                            worst_near_critical = worst_near_critical.max(error);
                        } else {
                            worst = worst.max(error);
                        }
                    }
                    // Which of the two it is may be a matter of rounding at the critical angle, and only there.
                    _ => assert!(
                        exact.is_none() == refraction.total || (angle - critical).abs() < 1e-3,
                        "from {from} to {to} at {angle} degrees"
                    ),
                }
            }
        }
    }
    println!("off Snell's law: {worst:.2e}, near the critical angle {worst_near_critical:.2e}");
    assert!(worst <= 1e-6 && worst_near_critical <= 1e-4);
}

/// Oracle: Fresnel's equations in f64, in terms of sines and tangents of the two angles instead of indices and cosines.
/// Tolerance: 2e-6; near grazing the reflectance changes by that much within a unit in the last place of the cosine.
#[test]
fn reflectance_follows_fresnel() {
    let mut worst = 0.0_f64;
    for (from, to) in BOUNDARIES {
        for step in 1..=899 {
            let angle = f64::from(step) / 10.0;
            if angle > critical_angle(from, to) - 0.1 {
                break;
            }
            let direction = incoming(Vec3::Z, angle, 1.0);
            let incidence = direction.as_dvec3().truncate().length().atan2(-f64::from(direction.z));
            let beyond = (incidence.sin() * f64::from(from) / f64::from(to)).asin();
            let perpendicular = (incidence - beyond).sin() / (incidence + beyond).sin();
            let parallel = (incidence - beyond).tan() / (incidence + beyond).tan();
            let exact = (perpendicular * perpendicular + parallel * parallel) / 2.0;
            let error = (f64::from(refracted(direction, Vec3::Z, from, to).reflectance) - exact).abs();
            worst = worst.max(error);
        }
    }
    println!("off Fresnel's equations: {worst:.2e}");
    assert!(worst <= 2e-6);
}

/// Oracle: `asin(to / from)`. The angle is bisected over all f32; the tolerance is what an error of three units in the
/// last place of the squared sine does to the angle.
#[test]
fn total_reflection_starts_at_the_critical_angle() {
    for (from, to) in BOUNDARIES.into_iter().filter(|(from, to)| from > to) {
        let is_total = |angle: f32| {
            let (sin, cos) = f64::from(angle).sin_cos();
            refracted(DVec3::new(sin, -cos, 0.0).as_vec3(), Vec3::Y, from, to).total
        };
        let (mut below, mut above) = (0.1_f32.to_bits(), 1.57_f32.to_bits());
        assert!(!is_total(f32::from_bits(below)) && is_total(f32::from_bits(above)));
        while above - below > 1 {
            let middle = below.midpoint(above);
            if is_total(f32::from_bits(middle)) {
                above = middle;
            } else {
                below = middle;
            }
        }
        let above = f32::from_bits(above);
        let exact = (f64::from(to) / f64::from(from)).asin();
        let tolerance = 3.0 * f64::from(f32::EPSILON) / (2.0 * exact).sin().abs();
        let off = f64::from(above) - exact;
        println!(
            "from {from} to {to}: total from {} degrees, off by {off:.1e}",
            above.to_degrees()
        );
        assert!(off.abs() <= tolerance, "{off} is more than {tolerance}");
    }
}

/// A surface of glass at y = 0, seen from inside: as a plane, and as two triangles that enclose nothing.
fn surfaces_from_below(material: Material) -> [Stage; 2] {
    let mut plane = Stage::default();
    plane.material(material);
    plane.plane(Vec3::ZERO, Vec3::Y, 0);
    let mut triangles = Stage::default();
    triangles.material(material);
    let corner = Vec3::new(-300.0, 0.0, 300.0);
    triangles.mesh(&quad(corner, Vec3::X * 600.0, Vec3::Z * -600.0), 0);
    [plane, triangles]
}

/// Through the whole tracer. Oracle: Snell's law in f64. Tolerance: 1e-6 and, for reading the direction off the
/// environment, another 2e-6.
#[test]
fn traced_rays_follow_snell_out_of_glass() {
    for stage in surfaces_from_below(clear(1.5)) {
        let scene = stage.build();
        let frame = frame(&scene, camera(Vec3::NEG_Y, Vec3::ZERO, 40.0, 8, 8));
        for step in 0..410 {
            let direction = incoming(Vec3::NEG_Y, f64::from(step) / 10.0, 0.7);
            let exact = snell(direction.as_dvec3(), DVec3::NEG_Y, 1.5, 1.0).unwrap();
            let seen = leaves_towards(&scene, &frame, &Ray::new(Vec3::NEG_Y * 2.0, direction));
            assert!(
                seen.distance(exact) <= 3e-6,
                "{step} tenths of a degree: {seen} and {exact}"
            );
        }
    }
}

/// Through the whole tracer, with Fresnel's weights: the sky is red and what is below is green, by the sine of the
/// elevation. Oracle: Fresnel's equations in f64. Beyond the critical angle not the least red may be seen, and all of the
/// green (to 2e-6, from reading it); before it, both parts together are 1 (to 1e-5).
#[test]
fn nothing_goes_through_beyond_the_critical_angle() {
    for (ior, stage) in [1.33_f32, 1.5, 2.42].into_iter().flat_map(|ior| {
        let glass = Material {
            flags: FRESNEL,
            ..clear(ior)
        };
        surfaces_from_below(glass).map(|stage| (ior, stage))
    }) {
        let mut stage = stage;
        stage.model.environment = Environment {
            zenith: Vec3::X,
            nadir: Vec3::Y,
            ..Environment::constant(Vec3::ZERO)
        };
        let scene = stage.build();
        let frame = frame(&scene, camera(Vec3::NEG_Y, Vec3::ZERO, 40.0, 8, 8));
        let critical = critical_angle(ior, 1.0);
        for step in 0..=890 {
            let angle = f64::from(step) / 10.0;
            let direction = incoming(Vec3::NEG_Y, angle, 0.7);
            let color = see(&scene, &frame, &Ray::new(Vec3::NEG_Y * 2.0, direction)).color;
            let reflected = f64::from(color.y) / angle.to_radians().cos();
            if angle > critical + 1e-3 {
                assert_eq!(color.x, 0.0, "{ior}, {angle} degrees");
                assert!(
                    (reflected - 1.0).abs() < 2e-6 / angle.to_radians().cos(),
                    "{ior}, {angle} degrees: {color}"
                );
            } else if angle < critical - 0.1 {
                let beyond = snell(direction.as_dvec3(), DVec3::NEG_Y, ior, 1.0).unwrap();
                let transmitted = f64::from(color.x) / beyond.y;
                assert!(
                    (reflected + transmitted - 1.0).abs() < 1e-5,
                    "{ior}, {angle} degrees: {color}"
                );
                assert!(color.x > 0.0 && color.y > 0.0);
            }
        }
    }
}
