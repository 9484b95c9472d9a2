//! Rays, always the same ones.

use crate::mesh::Mesh;
use glam::Vec3;
use oktant_shared::ray::Ray;

/// Aims rays at a mesh.
pub struct Aim<'a> {
    mesh: &'a Mesh,
    center: Vec3,
    /// Half the diagonal of the mesh's box.
    radius: f32,
    random: fastrand::Rng,
}

impl<'a> Aim<'a> {
    /// At a mesh with triangles; other rays for another seed.
    pub fn new(mesh: &'a Mesh, seed: u64) -> Self {
        let (low, high) = mesh.bounds().unwrap_or_default();
        Aim {
            mesh,
            center: 0.5 * (low + high),
            radius: 0.5 * (high - low).length(),
            random: fastrand::Rng::with_seed(seed),
        }
    }

    /// A number from -1 to 1.
    pub fn signed(&mut self) -> f32 {
        2.0 * self.random.f32() - 1.0
    }

    /// A unit vector.
    pub fn unit(&mut self) -> Vec3 {
        loop {
            let point = Vec3::from_array([(); 3].map(|()| self.signed()));
            if (0.01..=1.0).contains(&point.length_squared()) {
                return point.normalize();
            }
        }
    }

    /// One of so many.
    pub fn one_of(&mut self, count: usize) -> usize {
        self.random.usize(..count)
    }

    /// A point within so many radii of the middle.
    pub fn within(&mut self, radii: f32) -> Vec3 {
        let away = self.random.f32() * radii * self.radius;
        self.center + self.unit() * away
    }

    /// A point so many radii from the middle.
    pub fn away(&mut self, radii: f32) -> Vec3 {
        self.center + self.unit() * (radii * self.radius)
    }

    /// The point so many radii from the middle in a direction.
    pub fn outward(&self, direction: Vec3, radii: f32) -> Vec3 {
        self.center + direction.normalize() * (radii * self.radius)
    }

    /// The corners of one of the triangles.
    pub fn triangle(&mut self) -> [Vec3; 3] {
        let triangle = self.mesh.triangles[self.random.usize(..self.mesh.triangles.len())];
        triangle.map(|vertex| self.mesh.positions[vertex as usize])
    }

    /// A point on one of the edges.
    pub fn on_edge(&mut self) -> Vec3 {
        let corners = self.triangle();
        let first = self.random.usize(..3);
        corners[first].lerp(corners[(first + 1) % 3], self.random.f32())
    }

    /// A vertex that some triangle uses.
    pub fn vertex(&mut self) -> Vec3 {
        let corners = self.triangle();
        corners[self.random.usize(..3)]
    }

    /// A point inside one of the triangles.
    pub fn in_triangle(&mut self) -> Vec3 {
        let [a, b, c] = self.triangle();
        let (u, v) = (self.random.f32(), self.random.f32());
        let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
        a + (b - a) * u + (c - a) * v
    }
}

/// From one point at another.
pub fn at(origin: Vec3, target: Vec3) -> Ray {
    Ray::new(origin, target - origin)
}
