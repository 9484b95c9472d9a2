//! The cube around a mesh, with cell planes that f32 holds exactly.

use crate::build_error::BuildError;
use glam::Vec3;
use oktant_shared::octree::{MAX_DEPTH, Root};

/// Smallest width, scene units, of a mesh: products of its coordinates must not underflow.
pub const SMALLEST_EXTENT: f32 = 1e-12;
/// Largest width, scene units, of a mesh: products of its coordinates must not overflow.
pub const LARGEST_EXTENT: f32 = 1e12;

/// The cube is measured in units of this part of the smallest power of two above the mesh's width.
const UNITS: f64 = 64.0;

/// The root for everything between two corners, at most `depth` levels deep.
///
/// The cube's corner is a multiple of a unit and its edge an odd number of units, so that all cell planes are integers
/// times a power of two; odd, because the planes of axis-aligned meshes then seldom coincide with those of cells, which
/// would put their triangles into the cells of both sides. There is at least a unit of room on every side. Where the
/// mesh lies so far from the origin that f32 could not hold the planes of small cells, the depth is less.
pub(crate) fn root(low: Vec3, high: Vec3, depth: u32) -> Result<Root, BuildError> {
    let (low, high) = (low.as_dvec3(), high.as_dvec3());
    let extent = (high - low).max_element();
    if !(f64::from(SMALLEST_EXTENT)..=f64::from(LARGEST_EXTENT)).contains(&extent) {
        return Err(BuildError::Extent(extent as f32));
    }
    let unit = 2.0_f64.powi(extent.log2().ceil() as i32) / UNITS;
    let first = (low / unit).floor() - 1.0;
    let last = (high / unit).ceil() + 1.0;
    let edge = ((last - first).max_element() as u64 | 1) as f64;
    let largest = first.abs().max_element().max((first + edge).abs().max_element());
    // Planes are integers of up to largest * 2^depth; f32 holds 24 bits.
    let exact = 24 - (largest as u64).ilog2().min(23) - 1;
    let depth = depth.min(MAX_DEPTH).min(exact);
    Ok(Root {
        low: (first * unit).as_vec3(),
        cell: (edge * unit / f64::from(1_u32 << depth)) as f32,
        high: ((first + edge) * unit).as_vec3(),
        depth,
    })
}

/// The same cube, whose smallest cells are those of a level that is not below its own.
pub(crate) fn no_deeper(root: Root, depth: u32) -> Root {
    Root {
        // A power of two: as exact as before.
        cell: root.cell * (1_u32 << (root.depth - depth)) as f32,
        depth,
        ..root
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    #[test]
    fn all_planes_are_exact_and_the_mesh_is_well_inside() {
        // With the least depth; the loader keeps meshes as near as the first five.
        let cases = [
            (Vec3::ZERO, Vec3::ONE, 13),
            (vec3(-0.0947, 0.0330, -0.0619), vec3(0.0610, 0.1873, 0.0588), 13),
            (vec3(-1.0, -1.0, 0.0), vec3(1.0, 1.0, 0.0), 13),
            (vec3(3e-7, 3e-7, 3e-7), vec3(4e-7, 4e-7, 4e-7), 13),
            (vec3(1e6, -1.5e6, 1.5e6), vec3(1.1e6, -1.4e6, 1.6e6), 12),
            (vec3(1e5, 1e5, 1e5), vec3(1e5 + 1.0, 1e5 + 1.0, 1e5 + 1.0), 1),
        ];
        for (low, high, least) in cases {
            let root = root(low, high, MAX_DEPTH).unwrap();
            let extent = (high - low).max_element();
            for axis in 0..3 {
                for i in 0..=1_u32 << root.depth {
                    let exact = f64::from(root.low[axis]) + f64::from(root.cell) * f64::from(i);
                    let computed = root.low[axis] + root.cell * i as f32;
                    assert_eq!(f64::from(computed), exact, "{low} plane {i}");
                    let downwards = root.high[axis] - root.cell * i as f32;
                    let exact = f64::from(root.high[axis]) - f64::from(root.cell) * f64::from(i);
                    assert_eq!(f64::from(downwards), exact, "{low} plane {i} from above");
                }
                assert!(low[axis] - root.low[axis] > 0.005 * extent);
                assert!(root.high[axis] - high[axis] > 0.005 * extent);
            }
            assert!(root.size() < 1.2 * extent, "not much larger than needed");
            assert!(root.depth >= least, "{low} depth {}", root.depth);
        }
    }

    #[test]
    fn meshes_beyond_single_precision_are_refused() {
        assert!(matches!(root(Vec3::ZERO, Vec3::ZERO, 8), Err(BuildError::Extent(_))));
        assert!(matches!(
            root(Vec3::ZERO, Vec3::splat(1e13), 8),
            Err(BuildError::Extent(_))
        ));
    }
}
