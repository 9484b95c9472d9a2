//! Cutting polygons into triangles.
//!
//! A polygon of n corners always gives n - 2 triangles of its own corners, so that triangle ids are known before the
//! vertices are, and no corner is lost: the neighbours' edges end there.

use earcut::Earcut;
use glam::{DVec2, DVec3};

/// Corners that a polygon with a reflex corner may have: ear cutting takes time quadratic in them, some 2 s here in
/// the worst case known (a polygon that crosses itself everywhere), 50 ms in that of a spiral.
pub(crate) const MOST_CORNERS: usize = 16_384;

/// Cuts a quadrilateral from its first corner to the third, except where only the other diagonal lies inside.
fn cut_quad([a, b, c, d]: [u32; 4], position: impl Fn(u32) -> DVec3) -> [[u32; 3]; 2] {
    let [pa, pb, pc, pd] = [a, b, c, d].map(position);
    // Newell's normal of a quadrilateral.
    let normal = (pc - pa).cross(pd - pb);
    let is_proper = |p: DVec3, q: DVec3, r: DVec3| (q - p).cross(r - p).dot(normal) > 0.0;
    let first = is_proper(pa, pb, pc) && is_proper(pa, pc, pd);
    if !first && is_proper(pb, pc, pd) && is_proper(pb, pd, pa) {
        [[a, b, d], [b, c, d]]
    } else {
        [[a, b, c], [a, c, d]]
    }
}

/// A polygon that would take too long.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TooLarge;

/// Cuts larger polygons by ear cutting, as the crate earcut does it, in the plane across the polygon's Newell normal
/// (Sutherland, Sproull and Schumacker 1974).
#[derive(Default)]
pub(crate) struct Cutter {
    earcut: Earcut<f64>,
    /// The corners in the polygon's plane, where they run counter-clockwise.
    points: Vec<[f64; 2]>,
    /// Three corners for each triangle, as indices into [`Self::points`].
    ears: Vec<u32>,
}

impl Cutter {
    /// Cuts a polygon of at least three corners, whose positions `position` knows, into as many triangles as there is
    /// room for: two fewer than corners.
    pub(crate) fn cut(
        &mut self,
        ring: &[u32],
        position: impl Fn(u32) -> DVec3,
        triangles: &mut [[u32; 3]],
    ) -> Result<(), TooLarge> {
        match *ring {
            [a, b, c] => triangles.copy_from_slice(&[[a, b, c]]),
            [a, b, c, d] => triangles.copy_from_slice(&cut_quad([a, b, c, d], position)),
            _ => return self.cut_ring(ring, position, triangles),
        }
        Ok(())
    }

    fn cut_ring(
        &mut self,
        ring: &[u32],
        position: impl Fn(u32) -> DVec3,
        triangles: &mut [[u32; 3]],
    ) -> Result<(), TooLarge> {
        self.ears.clear();
        if self.project(ring, position) {
            if ring.len() <= MOST_CORNERS {
                self.earcut.earcut_slice(&self.points, &[], &mut self.ears);
            } else if !covers_by_fan(&self.points) {
                return Err(TooLarge);
            }
        }
        if self.ears.is_empty() {
            for (triangle, corners) in triangles.iter_mut().zip(ring[1..].windows(2)) {
                *triangle = [ring[0], corners[0], corners[1]];
            }
            return Ok(());
        }
        // Only a polygon that crosses or repeats itself has fewer ears; triangles without area keep the number.
        triangles.fill([ring[0]; 3]);
        for (triangle, ear) in triangles.iter_mut().zip(self.ears.chunks_exact(3)) {
            *triangle = [ring[ear[0] as usize], ring[ear[1] as usize], ring[ear[2] as usize]];
        }
        Ok(())
    }

    /// Fills [`Self::points`]; false where the polygon has no area that a normal could be told from.
    fn project(&mut self, ring: &[u32], position: impl Fn(u32) -> DVec3) -> bool {
        let origin = position(ring[0]);
        let mut normal = DVec3::ZERO;
        for pair in ring[1..].windows(2) {
            let (p, q) = (position(pair[0]), position(pair[1]));
            normal += (p - origin).cross(q - origin);
        }
        let Some(normal) = normal.try_normalize() else {
            return false;
        };
        let right = normal.any_orthonormal_vector();
        let up = normal.cross(right);
        self.points.clear();
        self.points.extend(ring.iter().map(|&corner| {
            let point = position(corner) - origin;
            [point.dot(right), point.dot(up)]
        }));
        true
    }
}

/// Whether the fan of triangles round the first corner covers the polygon once, but for a millionth of its area.
///
/// True for convex polygons, whose many corners seem to turn both ways when they are rounded to f32.
fn covers_by_fan(points: &[[f64; 2]]) -> bool {
    let origin = DVec2::from(points[0]);
    let (mut area, mut absolute_area, mut angle) = (0.0, 0.0, 0.0);
    for pair in points[1..].windows(2) {
        let (p, q) = (DVec2::from(pair[0]) - origin, DVec2::from(pair[1]) - origin);
        let twice = p.perp_dot(q);
        area += twice;
        absolute_area += twice.abs();
        angle += twice.atan2(p.dot(q));
    }
    absolute_area <= area * (1.0 + 1e-6) && angle < std::f64::consts::TAU
}
