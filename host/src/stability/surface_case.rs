//! Rays that meet surfaces, and what shading makes of them.

use super::LabError;
use super::aim::{Aim, at};
use crate::mesh::Mesh;
use crate::progress::silent;
use crate::scene::Scene;
use crate::shapes;
use crate::structure::StructureOptions;
use bytemuck::Zeroable;
use glam::Vec3;
use oktant_shared::frame::Frame;
use oktant_shared::light::{DIRECTIONAL, Light};
use oktant_shared::material::PHONG_HIGHLIGHTS;
use oktant_shared::medium::Media;
use oktant_shared::normal::interpolated_normal;
use oktant_shared::ray::Ray;
use oktant_shared::shading::{Viewer, shade};
use oktant_shared::surface::Surface;
use oktant_shared::traversal::{Standard, Traversal};
use oktant_shared::variant::PLAIN;
use oktant_shared::whitted::Traced;
use std::sync::Arc;

/// A ray that meets a surface.
pub struct Case {
    /// The mesh.
    pub scene: Arc<Scene>,
    /// The ray.
    pub ray: Ray,
    /// What oktant makes of where it meets the mesh.
    pub surface: Surface,
    /// The normal that is interpolated there; zero where it vanishes.
    pub normal: Vec3,
    /// The unit vector to a light.
    pub light: Vec3,
    /// A highlight's exponent.
    pub exponent: f32,
}

/// A ball of 8 stacks and 16 slices.
pub fn ball() -> Mesh {
    shapes::sphere(1.0, 224)
}

/// That ball, met from outside, and lights at random.
pub fn on_ball(count: usize) -> Result<Vec<Case>, LabError> {
    let mesh = ball();
    let mut aim = Aim::new(&mesh, 43);
    let rays = (0..count).map(|_| at(aim.away(2.0), aim.within(0.4))).collect();
    let mut cases = cases(mesh.clone(), rays)?;
    let mut aim = Aim::new(&mesh, 42);
    for case in &mut cases {
        case.light = aim.unit();
        case.exponent = [0.0, 0.5, 1.0, 20.5][aim.one_of(4)];
    }
    Ok(cases)
}

/// Where the rays meet a mesh, those that do.
pub fn cases(mesh: Mesh, rays: Vec<Ray>) -> Result<Vec<Case>, LabError> {
    let mesh = mesh.with_normals();
    let scene = Arc::new(Scene::new(&mesh, &StructureOptions::default(), &silent)?);
    let (view, world) = (scene.view(), scene.world());
    let case = |ray: Ray| {
        let hit = Standard::closest_hit(&view, &ray);
        let triangle = hit.is_hit().then(|| scene.triangles[hit.triangle as usize])?;
        let corners = [triangle.vertex_a, triangle.vertex_b, triangle.vertex_c].map(|at| scene.vertices[at as usize]);
        Some(Case {
            scene: scene.clone(),
            ray,
            surface: Surface::new::<PLAIN>(&Frame::zeroed(), &world, &ray, &hit),
            normal: interpolated_normal(&corners, &hit, Vec3::ZERO),
            light: Vec3::Z,
            exponent: 0.0,
        })
    };
    Ok(rays.into_iter().filter_map(case).collect())
}

/// A point of a triangle.
pub fn middle(mesh: &Mesh, triangle: usize) -> Vec3 {
    let [a, b, c] = mesh.triangles[triangle].map(|vertex| mesh.positions[vertex as usize]);
    a * 0.4 + b * 0.3 + c * 0.3
}

/// What a directional light makes of a shiny surface.
pub fn shaded(case: &Case) -> Vec3 {
    let mut surface = case.surface;
    surface.material.exponent = case.exponent;
    surface.material.specular = Vec3::ONE;
    surface.material.flags |= PHONG_HIGHLIGHTS;
    let frame = Frame {
        light: Light {
            kind: DIRECTIONAL,
            position: case.light,
            color: Vec3::ONE,
            ..Light::zeroed()
        },
        root: case.scene.root,
        ..Frame::zeroed()
    };
    let viewer = Viewer {
        direction: -case.ray.direction.normalize(),
        weight: Vec3::ONE,
        media: Media::AIR,
        is_seen: false,
    };
    shade::<Standard, PLAIN>(&frame, &case.scene.world(), &surface, &viewer, &mut { Traced::NOTHING })
}

/// What a ray is inside of when it has left a closed body of one material.
pub fn through(scene: &Scene, mut ray: Ray) -> Media {
    let mut media = Media::AIR;
    // A straight way through a convex body has two crossings.
    for _ in 0..4 {
        let hit = Standard::closest_hit(&scene.view(), &ray);
        if !hit.is_hit() {
            break;
        }
        let surface = Surface::new::<PLAIN>(&Frame::zeroed(), &scene.world(), &ray, &hit);
        media = if surface.from_front {
            media.entered(0)
        } else {
            media.left(0)
        };
        ray.origin = surface.back_origin();
    }
    media
}
