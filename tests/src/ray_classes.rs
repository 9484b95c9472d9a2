//! The thirteen classes of rays by which traversals are held against the oracle.

mod cell_grid;
mod marksman;

use oktant::mesh::Mesh;
use oktant::oracle::OracleRay;
use oktant_shared::ray::Ray;

pub use cell_grid::CellGrid;
use marksman::Marksman;

/// A way to make rays that some traversal has failed on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RayClass {
    /// Aimed at the mesh from 2 mesh sizes away.
    AimedNear,
    /// Aimed at the mesh from 10^3 mesh sizes away.
    AimedFar,
    /// Aimed at the mesh from 10^5 mesh sizes away.
    AimedVeryFar,
    /// Parallel to an axis.
    AxisParallel,
    /// Parallel to an axis, with one or two components -0.0.
    NegativeZero,
    /// Parallel to an axis, in one or two cell planes.
    AxisParallelInCellPlane,
    /// One component is zero, and the origin lies in a cell plane of that axis.
    ZeroComponentInCellPlane,
    /// All components of one size, exactly through a corner of a cell.
    DiagonalThroughCorner,
    /// Aimed at a corner of a cell from 2 mesh sizes away.
    AimedAtCorner,
    /// From within the mesh's bounds, or from close to the plane of a flat mesh.
    FromInside,
    /// As before, parallel to an axis.
    AxisParallelFromInside,
    /// One or two components are 1e-20 or 1e-30 in size.
    TinyComponents,
    /// One or two components are 1e-39 in size, which is denormal.
    DenormalComponents,
}

impl RayClass {
    /// All classes, in the order of their numbers.
    pub const ALL: [RayClass; 13] = [
        RayClass::AimedNear,
        RayClass::AimedFar,
        RayClass::AimedVeryFar,
        RayClass::AxisParallel,
        RayClass::NegativeZero,
        RayClass::AxisParallelInCellPlane,
        RayClass::ZeroComponentInCellPlane,
        RayClass::DiagonalThroughCorner,
        RayClass::AimedAtCorner,
        RayClass::FromInside,
        RayClass::AxisParallelFromInside,
        RayClass::TinyComponents,
        RayClass::DenormalComponents,
    ];

    /// 1 to 13.
    pub fn number(self) -> u32 {
        self as u32 + 1
    }

    /// What a table calls it.
    pub fn name(self) -> &'static str {
        match self {
            RayClass::AimedNear => "aimed from 2 sizes",
            RayClass::AimedFar => "aimed from 10^3 sizes",
            RayClass::AimedVeryFar => "aimed from 10^5 sizes",
            RayClass::AxisParallel => "axis-parallel",
            RayClass::NegativeZero => "axis-parallel, -0.0",
            RayClass::AxisParallelInCellPlane => "axis-parallel in a cell plane",
            RayClass::ZeroComponentInCellPlane => "zero component in a cell plane",
            RayClass::DiagonalThroughCorner => "diagonal through a cell corner",
            RayClass::AimedAtCorner => "aimed at a cell corner",
            RayClass::FromInside => "from inside",
            RayClass::AxisParallelFromInside => "axis-parallel from inside",
            RayClass::TinyComponents => "components 1e-20, 1e-30",
            RayClass::DenormalComponents => "components 1e-39",
        }
    }
}

/// The ray as the oracle takes it. A tracer counts hits at `t >= 0` only, whatever the ray's `t_min`.
pub fn for_oracle(ray: &Ray) -> OracleRay {
    OracleRay::new(ray.origin, ray.direction, ray.t_min.max(0.0), ray.t_max)
}

/// `count` rays of one class for a mesh in an octree; the same for the same `seed`.
///
/// Half of the targets are points on the mesh's triangles, half points in its bounds. Half of the directions of rays
/// that are aimed at a target have length 1, of the others the target is at `t` = 1.
///
/// # Panics
/// If the mesh has no triangles, or if a plane of `cells` is no f32.
pub fn rays(class: RayClass, mesh: &Mesh, cells: &CellGrid, count: usize, seed: u64) -> Vec<Ray> {
    assert!(
        !mesh.triangles.is_empty(),
        "rays cannot be aimed at a mesh without triangles"
    );
    let seed = seed.wrapping_mul(16).wrapping_add(u64::from(class.number()));
    let mut marksman = Marksman::new(mesh, cells, seed);
    (0..count).map(|_| marksman.ray(class)).collect()
}

#[cfg(test)]
mod tests;
