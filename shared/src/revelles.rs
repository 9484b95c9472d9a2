//! The parametric octree traversal.

use crate::arithmetic::{fused_multiply_add_vector, max, max_component, min_component};
use crate::box_test::{BoxTest, Interval};
use crate::buffer::load;
use crate::hit::{Hit, NO_TRIANGLE};
use crate::octree::{MAX_DEPTH, Node};
use crate::ray::{PreparedRay, Ray};
use crate::scene::Scene;
use crate::traversal::Traversal;
use crate::triangle_test::TriangleTest;
use core::marker::PhantomData;
use glam::{UVec3, Vec3};

/// J. Revelles, C. Urena, M. Lastra, "An efficient parametric algorithm for octree traversal", WSCG 2000, with the box
/// test `B` at the root and the triangle test `T` in the leaves.
///
/// A cell is entered and left where the ray crosses the planes of its faces. Which child comes first follows from the
/// order of the entry and the middle planes, which comes next from the plane through which the ray leaves.
///
/// Deviations, each for a failure of the published form:
/// - Planes are mirrored instead of the ray, and middle planes are crossed where they are, not half-way between the
///   parent's: nothing is rounded in the cells' places and no error adds up over levels.
/// - A zero direction component counts as a tiny positive one for finding cells. Cells are closed and widened by
///   [`crate::octree::CELL_MARGIN`], so it does not matter which of two neighbours a ray in their common plane visits.
/// - The search ends only when the nearest hit lies before the exit of the cell, for triangles reach beyond it.
/// - A ray from afar is traced from shortly before the root, so that `t` resolves the cells.
/// - No recursion: the path is the integer place of the cell, and the stack holds just the children's indices.
pub struct Revelles<B, T>(PhantomData<(B, T)>);

impl<B: BoxTest, T: TriangleTest> Traversal for Revelles<B, T> {
    fn closest_hit(scene: &Scene<'_>, ray: &Ray) -> Hit {
        let entered = Entered::new::<B>(scene, ray);
        let mut best = Hit::miss(entered.ray.t_max);
        if entered.inside {
            let test = T::prepare(&entered.ray);
            let mut walk = Walk::new(scene, &entered);
            while walk.inside {
                let node = walk.leaf(scene);
                for i in node.first..node.first + node.count {
                    let id = load(scene.references, i);
                    let crossing = test.crossing(&load(scene.triangles, id));
                    let nearer = crossing.t < best.t || (crossing.t == best.t && id < best.triangle);
                    if crossing.crosses && crossing.t >= entered.ray.t_min && nearer {
                        best = Hit {
                            t: crossing.t,
                            triangle: id,
                            u: crossing.u,
                            v: crossing.v,
                        };
                    }
                }
                walk.leave(best.t);
            }
        }
        if best.triangle == NO_TRIANGLE {
            Hit::miss(ray.t_max)
        } else {
            Hit {
                t: (best.t + entered.advance) * entered.ray.scale,
                ..best
            }
        }
    }

    fn any_hit(scene: &Scene<'_>, ray: &Ray) -> bool {
        let entered = Entered::new::<B>(scene, ray);
        let mut found = false;
        if entered.inside {
            let test = T::prepare(&entered.ray);
            let mut walk = Walk::new(scene, &entered);
            while walk.inside && !found {
                let node = walk.leaf(scene);
                for i in node.first..node.first + node.count {
                    let id = load(scene.references, i);
                    let crossing = test.crossing(&load(scene.triangles, id));
                    found = found
                        || (crossing.crosses && crossing.t >= entered.ray.t_min && crossing.t <= entered.ray.t_max);
                }
                walk.leave(entered.ray.t_max);
            }
        }
        found
    }
}

/// A ray at the root's face.
struct Entered {
    /// The prepared ray, its origin advanced to shortly before the root.
    ray: PreparedRay,
    /// By how much the origin was advanced, in the prepared `t`.
    advance: f32,
    /// Whether the ray meets the root within its limits.
    inside: bool,
}

/// Of the way to the root, the part that is not advanced: above the rounding error of the root's entry.
const KEPT_BACK: f32 = 1.0 / (1 << 20) as f32;

/// A ray that reaches the root within so many of its edge lengths is not advanced: its `t` resolves the cells anyway,
/// and a ray exactly through an edge stays so, where an advanced origin would be rounded off it.
const NEARBY: f32 = 4.0;

impl Entered {
    #[inline(always)]
    fn new<B: BoxTest>(scene: &Scene<'_>, ray: &Ray) -> Self {
        let mut ray = PreparedRay::new(ray);
        let Interval { enter, exit } = B::prepare(&ray).interval(&scene.root.aabb());
        let inside = ray.valid && enter <= exit && exit >= ray.t_min && enter * (1.0 - KEPT_BACK) <= ray.t_max;
        // The prepared direction is 1 to 2 long along its main axis.
        let advance = if inside && enter > NEARBY * (scene.root.high.x - scene.root.low.x) {
            enter * (1.0 - KEPT_BACK)
        } else {
            0.0
        };
        // Rounded once, the new origin is on the ray to the last place even if the old one is far away.
        ray.origin = fused_multiply_add_vector(advance, ray.direction, ray.origin);
        ray.t_min = max(ray.t_min - advance, 0.0);
        ray.t_max -= advance;
        Entered { ray, advance, inside }
    }
}

/// Direction components smaller than this count as this for finding cells.
const LEAST_SLOPE: f32 = 7.888_609e-31; // 2^-100

/// The walk of a ray from leaf to leaf.
///
/// Places are counted in smallest cells from the corner of the root that the ray moves away from, so that along every
/// axis places and `t` grow together.
struct Walk {
    origin: Vec3,
    reciprocal: Vec3,
    /// Where place 0 is, scene units.
    start: Vec3,
    /// From a place to the next, scene units, signed.
    step: Vec3,
    /// Axes along which places run against the coordinates; bits as in the index of a child.
    mirrored: u32,
    /// Low corner of the cell, in places.
    place: UVec3,
    /// The cell's edge length is 2^size places.
    size: u32,
    depth: u32,
    /// The cell's index.
    node: u32,
    /// Where the ray enters the cell.
    enter: f32,
    /// Index of the first child of the cell on the path that has size 2^(i + 1).
    stack: [u32; MAX_DEPTH as usize],
    /// False when the ray has left the root, or needs to look no further.
    inside: bool,
}

impl Walk {
    #[inline(always)]
    fn new(scene: &Scene<'_>, entered: &Entered) -> Self {
        let root = &scene.root;
        let direction = entered.ray.direction;
        let mirrored = bits(direction.x < 0.0, direction.y < 0.0, direction.z < 0.0);
        let mut walk = Walk {
            origin: entered.ray.origin,
            reciprocal: Vec3::new(
                reciprocal(direction.x),
                reciprocal(direction.y),
                reciprocal(direction.z),
            ),
            start: Vec3::new(
                if direction.x < 0.0 { root.high.x } else { root.low.x },
                if direction.y < 0.0 { root.high.y } else { root.low.y },
                if direction.z < 0.0 { root.high.z } else { root.low.z },
            ),
            step: Vec3::new(
                if direction.x < 0.0 { -root.cell } else { root.cell },
                if direction.y < 0.0 { -root.cell } else { root.cell },
                if direction.z < 0.0 { -root.cell } else { root.cell },
            ),
            mirrored,
            place: UVec3::ZERO,
            size: root.depth,
            depth: root.depth,
            node: 0,
            enter: 0.0,
            stack: [0; MAX_DEPTH as usize],
            inside: true,
        };
        walk.enter = max(max_component(walk.crossings(UVec3::ZERO)), entered.ray.t_min);
        walk
    }

    /// Where the ray crosses the three planes through a place.
    #[inline(always)]
    fn crossings(&self, place: UVec3) -> Vec3 {
        // Exact: the planes of all cells are (see `Root`).
        let plane = self.start + self.step * Vec3::new(place.x as f32, place.y as f32, place.z as f32);
        (plane - self.origin) * self.reciprocal
    }

    /// Goes down to the leaf at the place where the ray enters the current cell.
    #[inline(always)]
    fn leaf(&mut self, scene: &Scene<'_>) -> Node {
        let mut node = load(scene.nodes, self.node);
        while node.is_inner() {
            self.size -= 1;
            self.stack[self.size as usize] = node.first;
            let half = 1 << self.size;
            let middle = self.crossings(self.place + UVec3::splat(half));
            let x = middle.x <= self.enter;
            let y = middle.y <= self.enter;
            let z = middle.z <= self.enter;
            self.place += UVec3::new(
                if x { half } else { 0 },
                if y { half } else { 0 },
                if z { half } else { 0 },
            );
            self.node = node.first + (bits(x, y, z) ^ self.mirrored);
            node = load(scene.nodes, self.node);
        }
        node
    }

    /// Leaves the current leaf for the next cell on the way, unless the ray ends before at `limit`.
    #[inline(always)]
    fn leave(&mut self, limit: f32) {
        let length = 1 << self.size;
        let exits = self.crossings(self.place + UVec3::splat(length));
        let exit = min_component(exits);
        let before = self.place;
        let changed = if exits.x <= exit {
            self.place.x += length;
            before.x ^ self.place.x
        } else if exits.y <= exit {
            self.place.y += length;
            before.y ^ self.place.y
        } else {
            self.place.z += length;
            before.z ^ self.place.z
        };
        // The highest bit that changed is the size of the largest cell that was left.
        let size = 31 - changed.leading_zeros();
        self.inside = size < self.depth && exit < limit;
        if self.inside {
            self.size = size;
            self.enter = exit;
            let lower = (1 << size) - 1;
            self.place = UVec3::new(self.place.x & !lower, self.place.y & !lower, self.place.z & !lower);
            let child = bits(
                self.place.x >> size & 1 == 1,
                self.place.y >> size & 1 == 1,
                self.place.z >> size & 1 == 1,
            );
            self.node = self.stack[size as usize] + (child ^ self.mirrored);
        }
    }
}

/// The index of a child, from whether it is the upper one along each axis.
#[inline]
fn bits(x: bool, y: bool, z: bool) -> u32 {
    (if x { 1 } else { 0 }) | (if y { 2 } else { 0 }) | (if z { 4 } else { 0 })
}

#[inline]
fn reciprocal(component: f32) -> f32 {
    if component.abs() < LEAST_SLOPE {
        1.0 / LEAST_SLOPE
    } else {
        1.0 / component
    }
}
