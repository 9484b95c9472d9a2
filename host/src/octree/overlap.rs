//! Which of a cell's eight children a triangle belongs to.

use glam::{DVec3, Vec3};

/// Children in the lower half along x, y and z; the others are in the upper.
const LOWER: [u8; 3] = [0x55, 0x33, 0x0f];

/// The children (bit `i` for child `i`) that a triangle overlaps, out of a cell that it overlaps.
///
/// The cell is the cube about `center` with edges of `2 * half`; children are closed and widened by `margin` on all
/// sides. Separating axes: the three of the cell, the triangle's normal, and the nine products of edges and cell axes
/// (T. Akenine-Moller, "Fast 3D triangle-box overlap testing", JGT 6(1), 2001), here for the eight children at once and
/// in f64, in which the products of f32 differences lose nothing that matters beside the margin, even for slivers.
pub(crate) fn overlapped_children(corners: &[Vec3; 3], center: Vec3, half: f32, margin: f32) -> u8 {
    let low = corners[0].min(corners[1]).min(corners[2]);
    let high = corners[0].max(corners[1]).max(corners[2]);
    let mut children = 0xff;
    for axis in 0..3 {
        if low[axis] > center[axis] + margin {
            children &= !LOWER[axis];
        }
        if high[axis] < center[axis] - margin {
            children &= LOWER[axis];
        }
    }
    if children.is_power_of_two() {
        return children;
    }

    let center = center.as_dvec3();
    let [a, b, c] = corners.map(|corner| corner.as_dvec3() - center);
    // From the cell's centre to a child's, and half the child's widened edge, along each axis.
    let offset = f64::from(half) / 2.0;
    let reach = offset + f64::from(margin);

    let normal = (b - a).cross(c - a);
    let plane = normal.dot(a);
    let radius = reach * normal.abs().element_sum();
    for child in 0..8 {
        let towards = |bit: u32| if child >> bit & 1 == 1 { offset } else { -offset };
        let distance = normal.dot(DVec3::new(towards(0), towards(1), towards(2))) - plane;
        if distance.abs() > radius {
            children &= !(1 << child);
        }
    }

    for (from, to, third) in [(a, b, c), (b, c, a), (c, a, b)] {
        let edge = to - from;
        // For each cell axis, the product of edge and axis lies in the plane of the other two (first, second). Both ends
        // of the edge project to the same point of it.
        for (first, second) in [(1, 2), (2, 0), (0, 1)] {
            let project = |v: DVec3| edge[first] * v[second] - edge[second] * v[first];
            let (p, q) = (project(from), project(third));
            let (least, greatest) = (p.min(q), p.max(q));
            let radius = reach * (edge[first].abs() + edge[second].abs());
            for (upper_first, upper_second) in [(false, false), (true, false), (false, true), (true, true)] {
                let sign = |upper: bool| if upper { offset } else { -offset };
                let middle = edge[first] * sign(upper_second) - edge[second] * sign(upper_first);
                if least > middle + radius || greatest < middle - radius {
                    children &= !(half_of(first, upper_first) & half_of(second, upper_second));
                }
            }
        }
    }
    children
}

/// The children in one half of the cell.
fn half_of(axis: usize, upper: bool) -> u8 {
    if upper { !LOWER[axis] } else { LOWER[axis] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    /// Clips the triangle to the box and sees whether anything is left (Sutherland-Hodgman, f64).
    fn clipped_remains(corners: &[Vec3; 3], low: DVec3, high: DVec3) -> bool {
        let mut polygon: Vec<DVec3> = corners.iter().map(|c| c.as_dvec3()).collect();
        for axis in 0..3 {
            for (bound, sign) in [(low[axis], 1.0), (high[axis], -1.0)] {
                let inside = |v: &DVec3| (v[axis] - bound) * sign >= 0.0;
                let mut kept = Vec::new();
                for (i, v) in polygon.iter().enumerate() {
                    let w = &polygon[(i + 1) % polygon.len()];
                    if inside(v) {
                        kept.push(*v);
                    }
                    if inside(v) != inside(w) {
                        kept.push(*v + (*w - *v) * ((bound - v[axis]) / (w[axis] - v[axis])));
                    }
                }
                polygon = kept;
                if polygon.is_empty() {
                    return false;
                }
            }
        }
        true
    }

    #[test]
    fn agrees_with_clipping() {
        let mut state = 7_u32;
        let mut next = |size: f32| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            ((state >> 8) as f32 / (1 << 23) as f32 - 1.0) * size
        };
        let (half, margin) = (0.75_f32, 1e-6_f32);
        let center = vec3(0.5, -0.25, 0.125);
        let mut tested = 0;
        let mut several = 0;
        for round in 0..60_000 {
            let size = [0.2, 1.0, 5.0][round % 3];
            let about = vec3(next(1.0), next(1.0), next(1.0));
            let corners = [(); 3].map(|()| about + vec3(next(size), next(size), next(size)));
            let cell_low = (center - half).as_dvec3();
            if !clipped_remains(&corners, cell_low, (center + half).as_dvec3()) {
                continue;
            }
            tested += 1;
            let found = overlapped_children(&corners, center, half, margin);
            several += u32::from(!found.is_power_of_two());
            for child in 0..8 {
                let low = cell_low
                    + DVec3::from([0, 1, 2].map(|bit| if child >> bit & 1 == 1 { f64::from(half) } else { 0.0 }));
                let high = low + f64::from(half);
                let is = found >> child & 1 == 1;
                if clipped_remains(&corners, low, high) {
                    assert!(is, "round {round}: child {child} is overlapped");
                }
                let wide = f64::from(margin) * 1.01;
                if !clipped_remains(&corners, low - wide, high + wide) {
                    assert!(!is, "round {round}: child {child} is not overlapped");
                }
            }
        }
        assert!(
            tested > 20_000 && several > 5_000,
            "{tested} tested, {several} in several children"
        );
    }

    #[test]
    fn triangles_in_the_middle_plane_belong_to_both_sides() {
        let flat = [vec3(0.1, 0.1, 0.0), vec3(0.2, 0.1, 0.0), vec3(0.1, 0.2, 0.0)];
        assert_eq!(overlapped_children(&flat, Vec3::ZERO, 1.0, 1e-6), 0b1000_1000);
    }
}
