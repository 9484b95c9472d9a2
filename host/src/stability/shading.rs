//! Where shading fails: at normals that are not those of the triangle, at edges of shadows, in glass.

use super::aim::{Aim, at};
use super::cases::{About, Row, Test, Wrong, judged};
use super::exhibits::optics;
use super::meshes::{of_pairs, sphere, tilted};
use super::report::{Role, RowReport};
use super::subject::triangle;
use super::surface_case::{Case, ball, cases, middle, on_ball, shaded, through};
use super::tally::Failure;
use super::{LabError, Plan};
use crate::progress::silent;
use crate::scene::Scene;
use crate::structure::StructureOptions;
use glam::Vec3;
use oktant_shared::medium::Media;
use oktant_shared::normal::face_normal;
use oktant_shared::optics::{reflected, refracted};
use oktant_shared::ray::Ray;
use oktant_shared::traversal::{Standard, Traversal};
use std::sync::Arc;

const FAMILY: &str = "shading";

/// All of them.
pub const SHADING_ROWS: &[Row] = &[
    Row {
        id: "reflect-below",
        mesh: Some(|| tilted(&[Vec3::Z; MOST_TRIANGLES])),
        run: |plan| {
            let about = About {
                id: "reflect-below",
                family: FAMILY,
                title: "rays that are reflected to below the surface",
                input: "triangles whose normals are tilted away from the viewer, by up to the elevation at which the ray \
                        comes",
                remedy: "the normal is bent back until the reflected ray is above the triangle",
                fails: &["normal as it is interpolated"],
            };
            let tests: &[Test<Case>] = &[
                ("normal bent to the viewer", Role::Default, |case| {
                    below(case, case.surface.normal)
                }),
                ("normal as it is interpolated", Role::Exhibit, |case| {
                    below(case, case.normal)
                }),
            ];
            on_triangles(plan, &about, tests, 0.0, 1.0)
        },
    },
    Row {
        id: "normal-away",
        mesh: Some(|| tilted(&[Vec3::Z; MOST_TRIANGLES])),
        run: |plan| {
            let about = About {
                id: "normal-away",
                family: FAMILY,
                title: "normals that face away from the viewer",
                input: "triangles whose normals are tilted away from the viewer, by more than the elevation at which the \
                        ray comes",
                remedy: "the triangle alone says which side is in front",
                fails: &["side by the normal", "normal turned to the viewer"],
            };
            let tests: &[Test<Case>] = &[
                ("side by the triangle", Role::Default, |case| {
                    let is_right = case.surface.from_front && case.surface.normal.dot(Vec3::Z) > 0.0;
                    Wrong::when(!is_right, "false")
                }),
                ("side by the normal", Role::Exhibit, |case| {
                    Wrong::when(case.normal.dot(case.ray.direction) > 0.0, "false")
                }),
                ("normal turned to the viewer", Role::Exhibit, |case| {
                    let turned = if case.normal.dot(case.ray.direction) > 0.0 {
                        -case.normal
                    } else {
                        case.normal
                    };
                    Wrong::when(turned.dot(Vec3::Z) <= 0.0, "false")
                }),
            ];
            on_triangles(plan, &about, tests, 1.05, 2.0)
        },
    },
    Row {
        id: "terminator",
        mesh: Some(ball),
        run: |plan| {
            let about = About {
                id: "terminator",
                family: FAMILY,
                title: "facets of a round thing in the shadow of themselves",
                input: "a sphere of 8 stacks and 16 slices; lights at random that are above the horizon of the interpolated \
                        normal, its sine above 0.02",
                remedy: "shadow rays start on the rounder surface that the normals describe",
                fails: &["from the triangle"],
            };
            let tests: &[Test<Case>] = &[
                ("from the surface that the normals describe", Role::Default, |case| {
                    let shadow = Ray::new(case.surface.shadow_origin, case.light);
                    Wrong::ray(Standard::any_hit(&case.scene.view(), &shadow), shadow)
                }),
                ("from the triangle", Role::Exhibit, |case| {
                    let is_behind = case.surface.side.dot(case.light) <= 0.0;
                    let shadow = Ray::new(case.surface.front_origin(), case.light);
                    Wrong::ray(is_behind || Standard::any_hit(&case.scene.view(), &shadow), shadow)
                }),
            ];
            let mut cases = on_ball(plan.rays)?;
            cases.retain(|case| case.normal.dot(case.light) > 0.02);
            Ok(about.report(judged(&cases, tests, |case, wrong| {
                failure(case, wrong).replayed("lab:terminator", "")
            })))
        },
    },
    Row {
        id: "zero-normal",
        // A normal is not finite; the ray that meets it is right.
        mesh: None,
        run: |plan| {
            let about = About {
                id: "zero-normal",
                family: FAMILY,
                title: "normals that cancel",
                input: "pairs of triangles back to back, whose normals sum up to zero at their common corners",
                remedy: "below a length of 10^-10 the triangle's normal is taken",
                fails: &["unit vector of zero"],
            };
            let tests: &[Test<Case>] = &[
                ("triangle's normal", Role::Default, |case| {
                    let is_unit = (case.surface.normal.length() - 1.0).abs() < 1e-5;
                    Wrong::when(!is_unit, "not finite")
                }),
                ("unit vector of zero", Role::Exhibit, |case| {
                    Wrong::when(!case.normal.normalize().is_finite(), "not finite")
                }),
            ];
            let mesh = of_pairs(plan.rays.min(10_000));
            let rays = (0..mesh.triangles.len() / 2).map(|pair| {
                let target = middle(&mesh, 2 * pair);
                at(target + Vec3::new(0.3, 0.2, 2.0), target)
            });
            let rays = rays.collect();
            Ok(about.report(judged(&cases(mesh, rays)?, tests, failure)))
        },
    },
    Row {
        id: "power",
        // A colour is not finite; the ray that meets it is right.
        mesh: None,
        run: |plan| {
            let about = About {
                id: "power",
                family: FAMILY,
                title: "powers of numbers below zero in Phong's highlight",
                input: "a sphere, lights at random, exponents of 0, 0.5, 1 and 20.5",
                remedy: "the cosine is 0 to 1; an exponent of 0 means no highlight",
                fails: &["power of the cosine as it is"],
            };
            let tests: &[Test<Case>] = &[
                ("cosine from 0 to 1", Role::Default, |case| {
                    Wrong::when(!shaded(case).is_finite(), "not finite")
                }),
                ("power of the cosine as it is", Role::Exhibit, |case| {
                    let cosine = reflected(case.ray.direction.normalize(), case.surface.normal).dot(case.light);
                    Wrong::when(!cosine.powf(case.exponent).is_finite(), "not finite")
                }),
            ];
            Ok(about.report(judged(&on_ball(plan.rays)?, tests, failure)))
        },
    },
    Row {
        id: "total",
        mesh: Some(|| sphere(1.0, Vec3::ZERO)),
        run: |plan| {
            let about = About {
                id: "total",
                family: FAMILY,
                title: "total reflection in glass",
                input: "closed sphere of radius 1; from inside at the middles of its triangles, at 30 to 60 degrees from the \
                        normal, from an index of 1.5 into one of 1: the limit is at 41.8",
                remedy: "total reflection is a branch, not the root of a number below zero",
                fails: &["root of what is left"],
            };
            let tests: &[Test<(Ray, Vec3)>] = &[
                ("a branch", Role::Default, |(ray, normal)| {
                    let refraction = refracted(ray.direction, *normal, 1.5, 1.0);
                    let is_fair = refraction.total || (refraction.direction.length() - 1.0).abs() < 1e-5;
                    Wrong::when(!is_fair, "not finite")
                }),
                ("root of what is left", Role::Exhibit, |(ray, normal)| {
                    let refracted = optics::refracted(ray.direction, *normal, 1.5);
                    Wrong::when(!refracted.is_finite(), "not finite")
                }),
            ];
            let ball = sphere(1.0, Vec3::ZERO);
            let mut aim = Aim::new(&ball, 44);
            let rays: Vec<(Ray, Vec3)> = std::iter::repeat_with(|| {
                let corners = aim.triangle();
                let normal = face_normal(&triangle(corners));
                let along = normal.cross(aim.unit()).normalize();
                let angle = (45.0 + 15.0 * aim.signed()).to_radians();
                let direction = (along * angle.sin() + normal * angle.cos()).normalize();
                let target = (corners[0] + corners[1] + corners[2]) / 3.0;
                (Ray::new(target - 0.5 * direction, direction), -normal)
            })
            .take(plan.rays)
            .collect();
            let failure = |(ray, normal): &(Ray, Vec3), _: &Wrong| {
                let failure = Failure {
                    corners: vec![vec![normal.to_array()]],
                    ..Failure::of_ray(ray)
                };
                failure.replayed("lab:total", "")
            };
            Ok(about.report(judged(&rays, tests, failure)))
        },
    },
    Row {
        id: "inside",
        mesh: Some(|| sphere(1.0, Vec3::ZERO)),
        run: |plan| {
            let about = About {
                id: "inside",
                family: FAMILY,
                title: "whether a ray is inside of glass, behind corners that are hit twice",
                input: "closed sphere of radius 1; from outside through its vertices to behind it",
                remedy: "crossing a triangle against its normal enters, along it leaves; nothing is toggled",
                fails: &["toggled at every crossing"],
            };
            let tests: &[Test<(Arc<Scene>, Ray)>] = &[
                ("by the triangle's normal", Role::Default, |(scene, ray)| {
                    Wrong::when(through(scene, *ray) != Media::AIR, "false")
                }),
                ("toggled at every crossing", Role::Exhibit, |(scene, ray)| {
                    Wrong::when(optics::crossings(scene, ray) % 2 == 1, "false")
                }),
            ];
            let mesh = sphere(1.0, Vec3::ZERO);
            let scene = Arc::new(Scene::new(&mesh, &StructureOptions::default(), &silent)?);
            let mut aim = Aim::new(&mesh, 45);
            let rays = std::iter::repeat_with(|| {
                let vertex = aim.vertex();
                (scene.clone(), at(vertex * 3.0 + aim.unit() * 0.5, vertex))
            });
            // The exhibit tests all triangles.
            let rays: Vec<_> = rays.take(plan.rays.min(2_000)).collect();
            let failure = |(_, ray): &(Arc<Scene>, Ray), _: &Wrong| Failure::of_ray(ray).replayed("lab:inside", "");
            Ok(about.report(judged(&rays, tests, failure)))
        },
    },
];

fn below(case: &Case, normal: Vec3) -> Option<Wrong> {
    let mirrored = Ray::new(case.surface.front_origin(), reflected(case.ray.direction, normal));
    Wrong::ray(mirrored.direction.z <= 0.0, mirrored)
}

/// Triangles side by side, where there are not fewer rays.
const MOST_TRIANGLES: usize = 100_000;

/// Triangles in the plane z = 0, whose normals are tilted by `least` to `most` of the elevation at which a ray comes.
fn on_triangles(
    plan: &Plan,
    about: &About,
    tests: &[Test<Case>],
    least: f32,
    most: f32,
) -> Result<RowReport, LabError> {
    let mut random = fastrand::Rng::with_seed(41);
    let (mut normals, mut directions) = (Vec::new(), Vec::new());
    for _ in 0..plan.rays.min(MOST_TRIANGLES) {
        let elevation = (5.0 + 35.0 * random.f32()).to_radians();
        let tilt = elevation * (least + (most - least) * random.f32());
        let (sin, cos) = (std::f32::consts::TAU * random.f32()).sin_cos();
        let along = Vec3::new(cos, sin, 0.0);
        directions.push(along * elevation.cos() - Vec3::Z * elevation.sin());
        normals.push((along * tilt.sin() + Vec3::Z * tilt.cos()).normalize());
    }
    let mesh = tilted(&normals);
    let rays = directions.iter().enumerate().map(|(id, direction)| {
        let origin = middle(&mesh, id) - *direction * 3.0;
        Ray::new(origin, *direction)
    });
    let rays = rays.collect();
    let replayed = |case: &Case, wrong: &Wrong| failure(case, wrong).replayed(&format!("lab:{}", about.id), "");
    Ok(about.report(judged(&cases(mesh, rays)?, tests, replayed)))
}

fn failure(case: &Case, wrong: &Wrong) -> Failure {
    Failure {
        corners: vec![vec![
            case.surface.side.to_array(),
            case.normal.to_array(),
            case.light.to_array(),
        ]],
        ..Failure::of_ray(&wrong.ray.unwrap_or(case.ray))
    }
}
