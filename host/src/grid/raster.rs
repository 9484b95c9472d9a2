//! How fine a grid is, and where its planes lie.

use glam::{DVec3, UVec3, Vec3};
use oktant_shared::grid::{MAX_CELLS, Raster};

/// Of a flat mesh's width, the part that counts as its thickness.
const LEAST_THICKNESS: f64 = 1.0 / 64.0;
/// Significant bits of a cell's edge: its multiples are exact in f32 as long as the mesh is not far from the origin.
const EDGE_BITS: i32 = 8;

/// About `cells` cubic cells around everything between two corners, with room for `margin`, scene units, on every side.
///
/// The edge is the cube root of a cell's share of the volume (J. G. Cleary and G. Wyvill, "Analysis of an algorithm for
/// fast ray tracing using uniform space subdivision", The Visual Computer 4, 1988), rounded up to a number of few bits.
pub(super) fn raster(low: Vec3, high: Vec3, margin: f32, cells: f64) -> Raster {
    let margin = f64::from(margin);
    let low = low.as_dvec3() - 2.0 * margin;
    let high = high.as_dvec3() + 2.0 * margin;
    let extent = high - low;
    let widest = extent.max_element();
    let volume = extent.max(DVec3::splat(widest * LEAST_THICKNESS)).element_product();
    // One cell less along an axis leaves room for the one that rounding adds.
    let edge = (volume / cells).cbrt().max(widest / f64::from(MAX_CELLS - 1));
    let unit = 2.0_f64.powi(edge.log2().floor() as i32 - (EDGE_BITS - 1));
    let edge = (edge / unit).ceil() * unit;
    let low = ((low / unit).floor() * unit).as_vec3();
    let counts = ((high - low.as_dvec3()) / edge).floor();
    Raster {
        cells: UVec3::new(counts.x as u32, counts.y as u32, counts.z as u32) + 1,
        low,
        cell: edge as f32,
    }
}
