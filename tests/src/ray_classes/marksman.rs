//! How rays of each class are aimed.

use glam::Vec3;
use oktant::mesh::Mesh;
use oktant_shared::ray::Ray;

use super::{CellGrid, RayClass};
use crate::meshes::bounds;

/// Makes rays at random.
pub(super) struct Marksman<'a> {
    mesh: &'a Mesh,
    low: Vec3,
    high: Vec3,
    cells: &'a CellGrid,
    random: fastrand::Rng,
}

impl<'a> Marksman<'a> {
    /// For a mesh with triangles.
    pub fn new(mesh: &'a Mesh, cells: &'a CellGrid, seed: u64) -> Self {
        let (low, high) = bounds(mesh);
        Marksman {
            mesh,
            low,
            high,
            cells,
            random: fastrand::Rng::with_seed(seed),
        }
    }

    /// A ray of a class.
    pub fn ray(&mut self, class: RayClass) -> Ray {
        match class {
            RayClass::AimedNear => self.aimed_from(2.0),
            RayClass::AimedFar => self.aimed_from(1e3),
            RayClass::AimedVeryFar => self.aimed_from(1e5),
            RayClass::AxisParallel => {
                let target = self.target();
                self.axis_parallel(target, [0.0; 2])
            }
            RayClass::NegativeZero => {
                let target = self.target();
                let zeros = [[-0.0, -0.0], [-0.0, 0.0], [0.0, -0.0]][self.random.usize(..3)];
                self.axis_parallel(target, zeros)
            }
            RayClass::AxisParallelInCellPlane => {
                let target = self.target_in_cell_plane();
                let zeros = [self.zero(), self.zero()];
                self.axis_parallel(target, zeros)
            }
            RayClass::ZeroComponentInCellPlane => self.zero_component_in_cell_plane(),
            RayClass::DiagonalThroughCorner => self.diagonal_through_corner(),
            RayClass::AimedAtCorner => {
                let (level, corner) = self.corner();
                let target = self.corner_point(level, corner);
                let origin = self.origin_at(2.0);
                self.aimed(origin, target)
            }
            RayClass::FromInside => {
                let origin = self.point_inside();
                Ray::new(origin, self.unit_vector())
            }
            RayClass::AxisParallelFromInside => {
                let origin = self.point_inside();
                let mut direction = Vec3::ZERO;
                direction[self.random.usize(..3)] = self.sign();
                Ray::new(origin, direction)
            }
            RayClass::TinyComponents => self.small_components(&[1e-20, 1e-30]),
            RayClass::DenormalComponents => self.small_components(&[1e-39]),
        }
    }

    fn size(&self) -> f32 {
        self.low.distance(self.high)
    }

    fn sign(&mut self) -> f32 {
        if self.random.bool() { 1.0 } else { -1.0 }
    }

    fn zero(&mut self) -> f32 {
        0.0 * self.sign()
    }

    fn unit_vector(&mut self) -> Vec3 {
        loop {
            let point = Vec3::from_array([(); 3].map(|()| 2.0 * self.random.f32() - 1.0));
            let length = point.length();
            if (0.1..=1.0).contains(&length) {
                return point / length;
            }
        }
    }

    fn point_in_bounds(&mut self) -> Vec3 {
        let weight = Vec3::from_array([(); 3].map(|()| self.random.f32()));
        self.low + weight * (self.high - self.low)
    }

    /// As before, but off the plane of a flat mesh: on it, rounding decides whether `t` is 0 or just below.
    fn point_inside(&mut self) -> Vec3 {
        let thickness = Vec3::splat(0.1 * self.size());
        let flat = (self.high - self.low).cmpeq(Vec3::ZERO);
        let offset = thickness * Vec3::from_array([(); 3].map(|()| self.random.f32() - 0.5));
        self.point_in_bounds() + Vec3::select(flat, offset, Vec3::ZERO)
    }

    fn target(&mut self) -> Vec3 {
        if self.random.bool() {
            return self.point_in_bounds();
        }
        let triangle = self.mesh.triangles[self.random.usize(..self.mesh.triangles.len())];
        let [a, b, c] = triangle.map(|vertex| self.mesh.positions[vertex as usize]);
        let (u, v) = (self.random.f32(), self.random.f32());
        // The other half of the parallelogram is turned over.
        let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
        a + u * (b - a) + v * (c - a)
    }

    fn origin_at(&mut self, sizes: f32) -> Vec3 {
        0.5 * (self.low + self.high) + self.unit_vector() * (sizes * self.size())
    }

    fn aimed(&mut self, origin: Vec3, target: Vec3) -> Ray {
        let direction = target - origin;
        Ray::new(
            origin,
            if self.random.bool() {
                direction
            } else {
                direction.normalize()
            },
        )
    }

    fn aimed_from(&mut self, sizes: f32) -> Ray {
        let target = self.target();
        let origin = self.origin_at(sizes);
        self.aimed(origin, target)
    }

    /// Through `target` from outside of the bounds, along any axis; `zeros` are the other two components.
    fn axis_parallel(&mut self, target: Vec3, zeros: [f32; 2]) -> Ray {
        let axis = self.random.usize(..3);
        let sign = self.sign();
        let mut origin = target;
        let away = self.size() * (0.01 + 2.0 * self.random.f32());
        origin[axis] = if sign > 0.0 {
            self.low[axis] - away
        } else {
            self.high[axis] + away
        };
        let mut direction = Vec3::ZERO;
        direction[axis] = sign
            * if self.random.bool() {
                1.0
            } else {
                0.1 + 10.0 * self.random.f32()
            };
        direction[(axis + 1) % 3] = zeros[0];
        direction[(axis + 2) % 3] = zeros[1];
        Ray::new(origin, direction)
    }

    /// A plane index of an axis at any level, within the mesh's bounds where there is one.
    fn plane_index(&mut self, axis: usize, level: u32) -> i64 {
        let (first, last) = self.cells.between(axis, level, self.low[axis], self.high[axis]);
        if first <= last {
            self.random.i64(first..=last)
        } else {
            self.random.i64(0..=1 << level)
        }
    }

    fn level(&mut self) -> u32 {
        self.random.u32(0..=self.cells.depth)
    }

    fn plane(&mut self, axis: usize) -> f32 {
        let level = self.level();
        let index = self.plane_index(axis, level);
        self.cells.exact_plane(axis, level, index)
    }

    /// A target, moved into cell planes of two axes, or of all three: a ray along any axis lies in one or two.
    fn target_in_cell_plane(&mut self) -> Vec3 {
        let mut target = self.target();
        let free = self.random.usize(..4);
        for axis in (0..3).filter(|&axis| axis != free) {
            target[axis] = self.plane(axis);
        }
        target
    }

    fn zero_component_in_cell_plane(&mut self) -> Ray {
        let axis = self.random.usize(..3);
        let mut target = self.target();
        target[axis] = self.plane(axis);
        let mut ray = self.aimed_across(target, &[axis]);
        ray.direction[axis] = self.zero();
        ray
    }

    /// At `target` from 2 mesh sizes away, perpendicular to some axes.
    fn aimed_across(&mut self, target: Vec3, axes: &[usize]) -> Ray {
        let mut away = self.unit_vector();
        for &axis in axes {
            away[axis] = 0.0;
        }
        let mut origin = 0.5 * (self.low + self.high) + away.normalize() * (2.0 * self.size());
        for &axis in axes {
            origin[axis] = target[axis];
        }
        self.aimed(origin, target)
    }

    /// A level and the indices of three planes of it.
    fn corner(&mut self) -> (u32, [i64; 3]) {
        let level = self.level();
        (level, [0, 1, 2].map(|axis| self.plane_index(axis, level)))
    }

    fn corner_point(&self, level: u32, corner: [i64; 3]) -> Vec3 {
        Vec3::from_array([0, 1, 2].map(|axis| self.cells.exact_plane(axis, level, corner[axis])))
    }

    fn diagonal_through_corner(&mut self) -> Ray {
        let (level, corner) = self.corner();
        let signs = [(); 3].map(|()| self.sign());
        let direction = Vec3::from_array(signs) * if self.random.bool() { 1.0 } else { 0.375 };
        // From outside of the root cube where that is an f32, else from as far away as is one.
        let mut steps = 2 << level;
        loop {
            let start = [0, 1, 2].map(|axis| {
                let index = corner[axis] - signs[axis] as i64 * steps;
                self.cells.plane(axis, level, index)
            });
            if start
                .iter()
                .all(|&coordinate| f64::from(coordinate as f32) == coordinate)
            {
                return Ray::new(Vec3::from_array(start.map(|coordinate| coordinate as f32)), direction);
            }
            steps /= 2;
        }
    }

    /// At a target from outside, with one or two components of one of the sizes. Half of these rays lie in cell planes
    /// of these axes, but for what the components make of it.
    fn small_components(&mut self, sizes: &[f32]) -> Ray {
        let first = self.random.usize(..3);
        let both = [first, (first + 1) % 3];
        let axes = &both[..self.random.usize(1..=2)];
        let mut target = self.target();
        if self.random.bool() {
            for &axis in axes {
                target[axis] = self.plane(axis);
            }
        }
        let mut ray = self.aimed_across(target, axes);
        for &axis in axes {
            ray.direction[axis] = self.sign() * sizes[self.random.usize(..sizes.len())];
        }
        ray
    }
}
