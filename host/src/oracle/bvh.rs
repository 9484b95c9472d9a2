//! A bounding volume hierarchy in f64 that never loses a hit of [`Triangle::meet`](super::triangle::Triangle::meet).

use glam::DVec3;

use super::ray::OracleRay;

/// Buckets of the binned surface area heuristic (Wald, "On fast Construction of SAH-based BVHs", 2007).
const BINS: usize = 16;
/// No leaf is split that has this few triangles.
const SMALL_LEAF: usize = 2;
/// No leaf that has more triangles than this is left unsplit.
const LARGE_LEAF: usize = 8;
/// Below this depth the triangles are halved instead, so that the depth stays below [`MAX_DEPTH`].
const HALVING_DEPTH: usize = 64;
/// 32 halvings reach one triangle, as ids have 32 bits.
const MAX_DEPTH: usize = HALVING_DEPTH + 32;
/// From this many triangles on, both halves are built at the same time.
const PARALLEL: usize = 4096;
/// How far boxes are widened for a ray, relative to the distance of its origin from the scene's farthest corner:
/// 32 times the sum of the roundings (about four of 2^-53) by which the triangle test displaces a corner, and more
/// than those of the slab test itself.
const WIDENING: f64 = 1.0 / (1_u64 << 46) as f64;

/// An axis-aligned box, scene units.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub low: DVec3,
    pub high: DVec3,
}

/// A triangle while the hierarchy is built.
pub(super) struct Item {
    pub bounds: Bounds,
    pub triangle: u32,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Bounds,
    /// Leaf: the first of its triangles in `Bvh::order`. Else: how far behind this node its second child lies; the
    /// first lies right behind it.
    start: u32,
    /// How many triangles; 0 unless a leaf.
    count: u32,
}

/// The hierarchy: nodes in depth-first order, triangle ids in leaf order.
#[derive(Debug, Default)]
pub(super) struct Bvh {
    nodes: Vec<Node>,
    order: Vec<u32>,
}

impl Bounds {
    pub const EMPTY: Bounds = Bounds {
        low: DVec3::INFINITY,
        high: DVec3::NEG_INFINITY,
    };

    pub fn of(points: &[DVec3]) -> Self {
        points.iter().fold(Bounds::EMPTY, |bounds, &point| {
            bounds.union(Bounds {
                low: point,
                high: point,
            })
        })
    }

    fn union(self, other: Bounds) -> Bounds {
        Bounds {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    fn centre(&self) -> DVec3 {
        0.5 * (self.low + self.high)
    }

    fn half_area(&self) -> f64 {
        let size = (self.high - self.low).max(DVec3::ZERO);
        size.x * size.y + size.y * size.z + size.z * size.x
    }

    /// Largest distance along an axis of a point from this box.
    fn reach(&self, point: DVec3) -> f64 {
        (self.low - point).abs().max((self.high - point).abs()).max_element()
    }

    /// Where the line of `ray` enters this box, widened by `margin`, along the ray's dominant axis; `None` if it
    /// passes by or if that entry and exit lie outside the `t` from `ray.t_min` to `t_max`.
    ///
    /// Only the dominant axis is held against the `t` limits: a computed `t` of a triangle lies between those of its
    /// corners along that axis, whereas along the others a grazing triangle's rounding may carry it out of the box.
    fn entry(&self, ray: &OracleRay, dominant_axis: usize, margin: f64, t_max: f64) -> Option<f64> {
        let (mut enter, mut exit) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut dominant_enter = f64::NEG_INFINITY;
        for axis in 0..3 {
            let low = self.low[axis] - margin - ray.origin[axis];
            let high = self.high[axis] + margin - ray.origin[axis];
            let speed = ray.direction[axis];
            // Also -0.0. Divisions, not a reciprocal: 0 times its infinity would be NaN.
            if speed == 0.0 {
                if low > 0.0 || high < 0.0 {
                    return None;
                }
                continue;
            }
            let (low, high) = (low / speed, high / speed);
            let (near, far) = if speed < 0.0 { (high, low) } else { (low, high) };
            enter = enter.max(near);
            exit = exit.min(far);
            if axis == dominant_axis {
                if near > t_max || far < ray.t_min {
                    return None;
                }
                dominant_enter = near;
            }
        }
        (enter <= exit).then_some(dominant_enter)
    }
}

impl Bvh {
    pub fn new(mut items: Vec<Item>) -> Self {
        let mut nodes = Vec::with_capacity(items.len());
        if !items.is_empty() {
            build(&mut items, 0, 0, &mut nodes);
        }
        Bvh {
            nodes,
            order: items.iter().map(|item| item.triangle).collect(),
        }
    }

    /// The box round everything.
    pub fn bounds(&self) -> Bounds {
        self.nodes.first().map_or(Bounds::EMPTY, |root| root.bounds)
    }

    /// Calls `visit` for every triangle that the ray may meet at a `t` up to a limit, those near the origin
    /// approximately first. The limit starts as the ray's `t_max` and becomes what `visit` returns; negative infinity
    /// ends the search.
    ///
    /// With `margin` 0 no hit is lost; a positive `margin` (scene units) also visits every triangle that the ray's
    /// line passes within that distance.
    pub fn visit(&self, ray: &OracleRay, margin: f64, mut visit: impl FnMut(u32) -> f64) {
        let Some(root) = self.nodes.first() else {
            return;
        };
        if !ray.is_valid() {
            return;
        }
        let axis = ray.dominant_axis();
        let margin = margin + WIDENING * root.bounds.reach(ray.origin);
        let mut limit = ray.t_max;
        // Each level leaves at most one node waiting.
        let mut waiting = [(0_u32, 0.0_f64); MAX_DEPTH + 1];
        let mut count = 0;
        if let Some(entry) = root.bounds.entry(ray, axis, margin, limit) {
            waiting[0] = (0, entry);
            count = 1;
        }
        while count > 0 {
            count -= 1;
            let (index, entry) = waiting[count];
            if entry > limit {
                continue;
            }
            let node = &self.nodes[index as usize];
            if node.count > 0 {
                for &triangle in &self.order[node.start as usize..(node.start + node.count) as usize] {
                    limit = visit(triangle);
                    if limit == f64::NEG_INFINITY {
                        return;
                    }
                }
                continue;
            }
            let children = [index + 1, index + node.start];
            let entries = children.map(|child| self.nodes[child as usize].bounds.entry(ray, axis, margin, limit));
            let near_first = match entries {
                [Some(first), Some(second)] if second < first => [1, 0],
                _ => [0, 1],
            };
            for side in near_first.into_iter().rev() {
                if let Some(entry) = entries[side] {
                    waiting[count] = (children[side], entry);
                    count += 1;
                }
            }
        }
    }
}

/// Appends the subtree of `items`, which are reordered; `first` is the index of the first of them in the final order.
fn build(items: &mut [Item], first: usize, depth: usize, nodes: &mut Vec<Node>) {
    let bounds = items
        .iter()
        .fold(Bounds::EMPTY, |bounds, item| bounds.union(item.bounds));
    let index = nodes.len();
    nodes.push(Node {
        bounds,
        start: first as u32,
        count: items.len() as u32,
    });
    let Some(split) = split(items, &bounds, depth) else {
        return;
    };
    let parallel = items.len() >= PARALLEL;
    let (left, right) = items.split_at_mut(split);
    if parallel {
        let (mut left_nodes, mut right_nodes) = (Vec::new(), Vec::new());
        rayon::join(
            || build(left, first, depth + 1, &mut left_nodes),
            || build(right, first + split, depth + 1, &mut right_nodes),
        );
        nodes[index].start = left_nodes.len() as u32 + 1;
        nodes.append(&mut left_nodes);
        nodes.append(&mut right_nodes);
    } else {
        build(left, first, depth + 1, nodes);
        nodes[index].start = (nodes.len() - index) as u32;
        build(right, first + split, depth + 1, nodes);
    }
    nodes[index].count = 0;
}

/// Puts the triangles of the first child first and returns how many they are; `None` where a leaf is better.
fn split(items: &mut [Item], bounds: &Bounds, depth: usize) -> Option<usize> {
    let total = items.len();
    if total <= SMALL_LEAF {
        return None;
    }
    let centres = items.iter().fold(Bounds::EMPTY, |centres, item| {
        let centre = item.bounds.centre();
        centres.union(Bounds {
            low: centre,
            high: centre,
        })
    });
    let extent = centres.high - centres.low;
    let axis = extent.max_position();
    let count = if depth >= HALVING_DEPTH {
        total / 2
    } else {
        match cheapest_plane(items, bounds, axis, centres.low[axis], extent[axis]) {
            Some((count, cost)) if cost < total as f64 || total > LARGE_LEAF => count,
            None if total > LARGE_LEAF => total / 2,
            _ => return None,
        }
    };
    // Bins are monotonic in the centre, so the first `count` centres are those of the bins before the plane.
    items.select_nth_unstable_by(count, |a, b| {
        a.bounds.centre()[axis].total_cmp(&b.bounds.centre()[axis])
    });
    Some(count)
}

/// How many triangles lie before the best plane between two bins, and what the split costs in triangle tests; `None`
/// if no plane has triangles on both sides.
fn cheapest_plane(items: &[Item], bounds: &Bounds, axis: usize, low: f64, extent: f64) -> Option<(usize, f64)> {
    let mut bins = [(0_usize, Bounds::EMPTY); BINS];
    let scale = BINS as f64 / extent;
    for item in items {
        // An extent of 0 makes this NaN, which becomes bin 0.
        let bin = (((item.bounds.centre()[axis] - low) * scale) as usize).min(BINS - 1);
        bins[bin].0 += 1;
        bins[bin].1 = bins[bin].1.union(item.bounds);
    }
    let mut after = [(0_usize, 0.0_f64); BINS];
    let (mut count, mut joined) = (0, Bounds::EMPTY);
    for bin in (1..BINS).rev() {
        count += bins[bin].0;
        joined = joined.union(bins[bin].1);
        after[bin] = (count, joined.half_area());
    }
    let whole = bounds.half_area();
    let mut best: Option<(usize, f64)> = None;
    (count, joined) = (0, Bounds::EMPTY);
    for bin in 1..BINS {
        count += bins[bin - 1].0;
        joined = joined.union(bins[bin - 1].1);
        let (rest, rest_area) = after[bin];
        if count == 0 || rest == 0 {
            continue;
        }
        // A step costs about as much as one triangle test.
        let cost = 1.0 + (count as f64 * joined.half_area() + rest as f64 * rest_area) / whole;
        if best.is_none_or(|(_, cheapest)| cost < cheapest) {
            best = Some((count, cost));
        }
    }
    best
}
