//! The walk through a uniform grid as it was published, and with its failures.

use super::cells::{Extent, Faces};
use crate::mesh::Mesh;
use glam::{UVec3, Vec3};
use oktant_shared::hit::Hit;
use oktant_shared::ray::{PreparedRay, Ray};
use oktant_shared::triangle::Triangle;
use oktant_shared::triangle_test::{TriangleTest, Watertight};

/// A form of the walk (J. Amanatides, A. Woo, "A fast voxel traversal algorithm for ray tracing", Eurographics 1987).
#[derive(Clone, Copy, Debug)]
pub struct GridForm {
    /// Whether the next plane's distance is that of the last plus a step, as published; else it is where the plane is.
    pub summed: bool,
    /// Whether the first cell with a hit ends the search, wherever in the triangle the hit is.
    pub first_cell: bool,
}

/// Cells along each axis.
const CELLS: u32 = 64;

/// A grid over a mesh's box, and a form of the walk.
pub struct CellGrid {
    form: GridForm,
    low: Vec3,
    cell: Vec3,
    cells: Vec<Vec<u32>>,
    triangles: Vec<Triangle>,
}

impl CellGrid {
    /// Sorts the triangles' boxes into the cells.
    pub fn new(mesh: &Mesh, form: GridForm) -> Self {
        let extents = Extent::of_triangles(mesh);
        let all = Extent::of_all(&extents);
        // A little wider, so that flat meshes have cells and none ends at the last plane.
        let room = 1e-3 * (all.high - all.low).max_element();
        let (low, high) = (all.low - room, all.high + room);
        let cell = (high - low) / CELLS as f32;
        let mut cells = vec![Vec::new(); (CELLS * CELLS * CELLS) as usize];
        for (id, extent) in extents.iter().enumerate() {
            let [first, last] =
                [extent.low - 0.01 * cell, extent.high + 0.01 * cell].map(|corner| place(corner, low, cell));
            for z in first.z..=last.z {
                for y in first.y..=last.y {
                    for x in first.x..=last.x {
                        let corner = low + UVec3::new(x, y, z).as_vec3() * cell;
                        if extent.overlaps(Faces::Closed, corner - 0.01 * cell, corner + 1.01 * cell) {
                            cells[index(UVec3::new(x, y, z))].push(id as u32);
                        }
                    }
                }
            }
        }
        CellGrid {
            form,
            low,
            cell,
            cells,
            triangles: super::super::subject::triangles(mesh),
        }
    }

    /// The closest hit, with the triangle's id.
    pub fn closest_hit(&self, ray: &Ray) -> Hit {
        let prepared = PreparedRay::new(ray);
        let mut best = Hit::miss(ray.t_max);
        let (origin, direction) = (prepared.origin, prepared.direction);
        let high = self.low + self.cell * CELLS as f32;
        let (mut enter, mut exit) = (0.0_f32, f32::INFINITY);
        for axis in 0..3 {
            if direction[axis] != 0.0 {
                let a = (self.low[axis] - origin[axis]) / direction[axis];
                let b = (high[axis] - origin[axis]) / direction[axis];
                enter = enter.max(a.min(b));
                exit = exit.min(a.max(b));
            } else if origin[axis] < self.low[axis] || origin[axis] > high[axis] {
                return best;
            }
        }
        if !prepared.valid || enter > exit {
            return best;
        }
        let test = Watertight::prepare(&prepared);
        let mut at = place(origin + direction * enter, self.low, self.cell);
        let plane = |at: UVec3, axis: usize| {
            let ahead = u32::from(direction[axis] > 0.0);
            let plane = self.low[axis] + (at[axis] + ahead) as f32 * self.cell[axis];
            if direction[axis] == 0.0 {
                f32::INFINITY
            } else {
                (plane - origin[axis]) / direction[axis]
            }
        };
        let mut next = Vec3::from_array([0, 1, 2].map(|axis| plane(at, axis)));
        let step = self.cell / direction.abs();
        loop {
            for id in &self.cells[index(at)] {
                let crossing = test.crossing(&self.triangles[*id as usize]);
                let t = crossing.t * prepared.scale;
                if crossing.crosses && crossing.t >= prepared.t_min && t < best.t {
                    best = Hit {
                        t,
                        triangle: *id,
                        u: crossing.u,
                        v: crossing.v,
                    };
                }
            }
            let axis = next.min_position();
            let leaves = self.form.first_cell || best.t <= next[axis] * prepared.scale;
            let is_last = at[axis] == if direction[axis] > 0.0 { CELLS - 1 } else { 0 };
            if best.is_hit() && leaves || is_last || next[axis] == f32::INFINITY {
                return best;
            }
            at[axis] = if direction[axis] > 0.0 {
                at[axis] + 1
            } else {
                at[axis] - 1
            };
            next[axis] = if self.form.summed {
                next[axis] + step[axis]
            } else {
                plane(at, axis)
            };
        }
    }
}

/// The cell of a point, or the one that is nearest to it.
fn place(point: Vec3, low: Vec3, cell: Vec3) -> UVec3 {
    ((point - low) / cell)
        .clamp(Vec3::ZERO, Vec3::splat(CELLS as f32 - 1.0))
        .as_uvec3()
}

fn index(at: UVec3) -> usize {
    (at.x + CELLS * (at.y + CELLS * at.z)) as usize
}
