//! Rays that leave a surface and meet it again.

use super::aim::{Aim, at};
use super::clock::quickest;
use super::exhibits::origins::{
    Departure, Method, bounded, bounded_on_ray, integers_on_ray, least_t, none, ten_thousandth, thousandth, wide,
};
use super::meshes::sphere;
use super::report::{MethodReport, Role, RowReport};
use super::tally::{Counts, Failure};
use crate::mesh::Mesh;
use crate::progress::silent;
use crate::scene::{Scene, SceneError};
use crate::structure::StructureOptions;
use glam::{Vec3, vec3};
use oktant_shared::normal::face_normal;
use oktant_shared::ray::Ray;
use oktant_shared::traversal::{Standard, Traversal};
use rayon::prelude::*;

/// A closed convex sphere or ellipsoid, met from outside; what leaves it outwards meets nothing.
pub struct DepartureMode {
    /// What a command line calls it.
    pub id: &'static str,
    title: &'static str,
    input: &'static str,
    /// Along x, y and z.
    radii: Vec3,
    center: Vec3,
    /// Radii from the sphere's middle to the camera.
    distance: f32,
    fails: &'static [&'static str],
}

const METHODS: [(&str, Role, Method); 8] = [
    ("weights, bound of rounding", Role::Default, bounded),
    ("weights, bound for wide triangles", Role::Exhibit, wide),
    ("on the ray, as it is", Role::Exhibit, none),
    ("on the ray, t from 1e-4", Role::Exhibit, least_t),
    ("on the ray, normal times 1e-3", Role::Exhibit, thousandth),
    ("on the ray, normal times 1e-4", Role::Exhibit, ten_thousandth),
    ("on the ray, bound of rounding", Role::Exhibit, bounded_on_ray),
    ("on the ray, Wachter and Binder", Role::Exhibit, integers_on_ray),
];

const OFFSET: Vec3 = vec3(1000.0, 1234.0, -2234.0);

/// All of them.
pub const DEPARTURE_MODES: &[DepartureMode] = &[
    DepartureMode {
        id: "leave-near",
        title: "of a sphere of radius 1, met from 3 radii",
        input: "closed sphere of radius 1; outwards from where rays from 3 radii away meet it",
        radii: Vec3::splat(1.0),
        center: Vec3::ZERO,
        distance: 3.0,
        fails: &["on the ray, as it is"],
    },
    DepartureMode {
        id: "leave-far",
        title: "of a sphere of radius 1, met from 1,000 radii",
        input: "closed sphere of radius 1; outwards from where rays from 1,000 radii away meet it",
        radii: Vec3::splat(1.0),
        center: Vec3::ZERO,
        distance: 1e3,
        fails: &[
            "on the ray, as it is",
            "on the ray, t from 1e-4",
            "on the ray, bound of rounding",
        ],
    },
    DepartureMode {
        id: "leave-small",
        title: "of a sphere of radius 0.001",
        input: "closed sphere of radius 0.001; outwards from where rays from 3 radii away meet it",
        radii: Vec3::splat(1e-3),
        center: Vec3::ZERO,
        distance: 3.0,
        fails: &["on the ray, as it is"],
    },
    DepartureMode {
        id: "leave-tiny",
        title: "of a sphere of radius 0.000001",
        input: "closed sphere of radius 0.000001; outwards from where rays from 3 radii away meet it",
        radii: Vec3::splat(1e-6),
        center: Vec3::ZERO,
        distance: 3.0,
        fails: &["on the ray, as it is"],
    },
    DepartureMode {
        id: "leave-large",
        title: "of a sphere of radius 1,000,000",
        input: "closed sphere of radius 1,000,000; outwards from where rays from 3 radii away meet it",
        radii: Vec3::splat(1e6),
        center: Vec3::ZERO,
        distance: 3.0,
        fails: &[
            "on the ray, as it is",
            "on the ray, t from 1e-4",
            "on the ray, normal times 1e-3",
            "on the ray, normal times 1e-4",
        ],
    },
    DepartureMode {
        id: "leave-offset",
        title: "of a sphere far from the origin of coordinates",
        input: "closed sphere of radius 1 about (1000, 1234, -2234); outwards from where rays from 3 radii away meet it",
        radii: Vec3::splat(1.0),
        center: OFFSET,
        distance: 3.0,
        fails: &[
            "on the ray, as it is",
            "on the ray, t from 1e-4",
            "on the ray, normal times 1e-4",
        ],
    },
    DepartureMode {
        id: "leave-slender",
        title: "of triangles that are hundreds of times as long as wide",
        input: "closed ellipsoid 200 times as long as wide; outwards from where rays from 3 lengths away meet it",
        radii: vec3(1.0, 1.0, 200.0),
        center: Vec3::ZERO,
        distance: 3.0,
        fails: &["weights, bound for wide triangles", "on the ray, as it is"],
    },
];

impl DepartureMode {
    /// The sphere.
    pub fn mesh(&self) -> Mesh {
        let mut mesh = sphere(1.0, Vec3::ZERO);
        for position in &mut mesh.positions {
            *position = *position * self.radii + self.center;
        }
        mesh
    }

    /// Runs all methods.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn run(&self, count: usize) -> Result<RowReport, SceneError> {
        let mesh = self.mesh();
        let scene = Scene::new(&mesh, &StructureOptions::default(), &silent)?;
        let view = scene.view();
        let mut aim = Aim::new(&mesh, 31);
        // As slender as the body, or most would pass it.
        let shape = self.radii / self.radii.max_element();
        let within = |point: Vec3| self.center + (point - self.center) * shape;
        let arrivals: Vec<(Ray, Vec3)> = (0..count)
            .map(|_| (at(aim.away(self.distance), within(aim.within(0.4))), aim.unit()))
            .collect();
        let departures: Vec<Departure<'_>> = arrivals
            .par_iter()
            .filter_map(|&(ray, out)| {
                let hit = Standard::closest_hit(&view, &ray);
                let triangle = hit.is_hit().then(|| &scene.triangles[hit.triangle as usize])?;
                // The sphere's triangles face outwards; some that are hit from outside at a steep angle are not seen so.
                let normal = face_normal(triangle);
                let direction = if out.dot(normal) < 0.0 { -out } else { out };
                // In the plane of the triangle, where there is no outside, f32 cannot tell.
                (direction.dot(normal) > 1e-3).then_some(Departure {
                    triangle,
                    hit,
                    ray,
                    normal,
                    direction,
                })
            })
            .collect();
        let mut base = None;
        let methods = METHODS.map(|(name, role, method)| {
            let returns = |departure: &Departure<'_>| Standard::any_hit(&view, &method(departure));
            let (again, time) = quickest(|| departures.par_iter().map(returns).collect::<Vec<bool>>());
            let seconds = time.as_secs_f64();
            let ratio = seconds / *base.get_or_insert(seconds);
            let wrong = || departures.iter().zip(&again).filter(|(_, again)| **again);
            let failure = |(departure, _): (&Departure<'_>, &bool)| Failure {
                kind: "false",
                corners: vec![
                    [departure.triangle.a, departure.triangle.b, departure.triangle.c]
                        .map(|c| c.to_array())
                        .into(),
                ],
                ..Failure::of_ray(&method(departure)).replayed(&format!("lab:{}", self.id), "")
            };
            MethodReport {
                name: name.into(),
                role,
                device: "CPU".into(),
                counts: Counts {
                    rays: departures.len(),
                    phantom: wrong().count(),
                    ..Counts::default()
                },
                time_ratio: (departures.len() >= 1000).then_some(ratio),
                failures: wrong().take(super::subject::KEPT).map(failure).collect(),
            }
        });
        Ok(RowReport {
            id: self.id,
            family: "rays that leave a surface",
            title: self.title,
            input: self.input,
            remedy: "the point from the barycentric weights, moved by the bound of its rounding error and of \
                     the test's",
            must_fail: self.fails.into(),
            methods: methods.into(),
        })
    }
}
