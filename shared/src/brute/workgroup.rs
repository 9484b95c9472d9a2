//! All triangles, read by the rays of a workgroup together.

use super::Walk;
use crate::box_test::BoxTest;
use crate::buffer::{get, load, put};
use crate::candidate::{is_within, nearer_of};
use crate::entered::Entered;
use crate::hit::Hit;
use crate::ray::Ray;
use crate::scene::Scene;
use crate::triangle::Triangle;
use crate::triangle_test::TriangleTest;
use crate::walk::Along;
use glam::Vec4;

/// Triangles of a tile.
pub const TILE: u32 = 64;

/// The rows of a tile's triangles (see [`Triangle::at`]), in memory that a workgroup has in common.
pub type Tile = [Vec4; 3 * TILE as usize];

/// A workgroup of `N` invocations as one of them sees it. They read the triangles tile by tile, each row once for the rays of
/// all.
///
/// Natively nobody waits for others: there `N` is 1.
pub struct Workgroup<'a, const N: u32> {
    /// What they have in common.
    pub tile: &'a mut Tile,
    /// Which of them this one is.
    pub invocation: u32,
}

impl<const N: u32> Workgroup<'_, N> {
    /// Reads the tile from slot `first` on, with the others; returns how many triangles it has.
    #[inline(always)]
    fn read(&mut self, scene: &Scene<'_>, first: u32, count: u32) -> u32 {
        let remaining = count - first;
        let held = if remaining < TILE { remaining } else { TILE };
        let mut row = self.invocation;
        while row < 3 * held {
            put(self.tile, row, load(scene.triangles, 3 * first + row));
            row += N;
        }
        Self::wait();
        held
    }

    /// A triangle of the tile.
    #[inline(always)]
    fn triangle(&self, place: u32) -> Triangle {
        let row = |k: u32| get(self.tile, 3 * place + k);
        Triangle::of_rows(row(0), row(1), row(2))
    }

    /// Waits until all have written what they read, or have tested what was written.
    #[inline(always)]
    fn wait() {
        #[cfg(target_arch = "spirv")]
        spirv_std::arch::workgroup_memory_barrier_with_group_sync();
    }
}

/// A traversal for the rays of a workgroup. All of its invocations must ask, the same of the same scene: those whose rays have
/// nothing more to find still read and wait.
pub trait Together {
    /// [`crate::traversal::Traversal::closest_hit`] of this invocation's ray.
    fn closest_hit_together<const N: u32>(scene: &Scene<'_>, ray: &Ray, group: Workgroup<'_, N>) -> Hit;

    /// [`crate::traversal::Traversal::any_hit`] of this invocation's ray.
    fn any_hit_together<const N: u32>(scene: &Scene<'_>, ray: &Ray, group: Workgroup<'_, N>) -> bool;
}

impl<B: BoxTest, T: TriangleTest> Together for Along<Walk, B, T> {
    #[inline(always)]
    fn closest_hit_together<const N: u32>(scene: &Scene<'_>, ray: &Ray, mut group: Workgroup<'_, N>) -> Hit {
        let entered = Entered::new::<B>(scene, ray);
        let test = T::prepare_in(scene, &entered.ray);
        let mut best = Hit::miss(entered.ray.t_max);
        let count = load(scene.nodes, 0).x;
        let mut first = 0;
        loop {
            let held = group.read(scene, first, count);
            if entered.inside & (held != 0) {
                let mut place = 0;
                loop {
                    let crossing = test.crossing(&group.triangle(place));
                    nearer_of(scene, crossing, first + place, entered.ray.t_min, &mut best);
                    place += 1;
                    if place == held {
                        break;
                    }
                }
            }
            Workgroup::<N>::wait();
            first += held;
            if first == count {
                break;
            }
        }
        entered.left(ray, best)
    }

    #[inline(always)]
    fn any_hit_together<const N: u32>(scene: &Scene<'_>, ray: &Ray, mut group: Workgroup<'_, N>) -> bool {
        let entered = Entered::new::<B>(scene, ray);
        let test = T::prepare_in(scene, &entered.ray);
        let mut found = false;
        let count = load(scene.nodes, 0).x;
        let mut first = 0;
        loop {
            let held = group.read(scene, first, count);
            if entered.inside & !found & (held != 0) {
                let mut place = 0;
                loop {
                    found = is_within(test.crossing(&group.triangle(place)), &entered.ray);
                    place += 1;
                    if found | (place == held) {
                        break;
                    }
                }
            }
            Workgroup::<N>::wait();
            first += held;
            if first == count {
                break;
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brute::Brute;
    use crate::octree::Root;
    use crate::traversal::Traversal;
    use crate::triangle_test::Watertight;
    use glam::{Vec3, uvec4};
    use std::vec::Vec;

    type Subject = Brute<Watertight>;

    /// Triangles one behind the other, the odd ones exactly where the even ones before them are; ids run against slots.
    fn rows(count: u32) -> Vec<Vec4> {
        let corners = [
            Vec3::new(-1.0, -1.0, 0.0),
            Vec3::new(2.0, -1.0, 0.0),
            Vec3::new(-1.0, 2.0, 0.0),
        ];
        let at = |slot: u32| corners.map(|corner| (corner - Vec3::Z * (slot / 2) as f32).extend(0.0));
        (0..count).flat_map(at).collect()
    }

    fn alone(tile: &mut Tile) -> Workgroup<'_, 1> {
        Workgroup { tile, invocation: 0 }
    }

    /// Tiles that are missing, half full, full, and more than one; the closest hit in every place.
    #[test]
    fn tiles_hide_no_triangle() {
        for count in [0, 1, TILE - 1, TILE, TILE + 1, 3 * TILE] {
            let triangles = rows(count);
            let ids: Vec<u32> = (0..count).rev().collect();
            let scene = Scene {
                root: Root {
                    low: Vec3::splat(-100.0),
                    cell: 200.0,
                    high: Vec3::splat(100.0),
                    depth: 0,
                },
                nodes: &[uvec4(count, 0, 0, 0)],
                references: &[],
                triangles: &triangles,
                ids: &ids,
                parts: 0,
            };
            for from in 0..=count / 2 {
                let origin = Vec3::new(0.1, 0.2, 0.5 - from as f32);
                let limited = Ray {
                    t_max: 0.25,
                    ..Ray::new(origin, Vec3::NEG_Z)
                };
                for ray in [Ray::new(origin, Vec3::NEG_Z), Ray::new(origin, Vec3::Y), limited] {
                    let mut tile = [Vec4::NAN; 3 * TILE as usize];
                    let expected = Subject::closest_hit(&scene, &ray);
                    assert_eq!(
                        expected.is_hit(),
                        ray.direction.z < 0.0 && ray.t_max > 1.0 && 2 * from < count
                    );
                    assert_eq!(Subject::closest_hit_together(&scene, &ray, alone(&mut tile)), expected);
                    assert_eq!(
                        Subject::any_hit_together(&scene, &ray, alone(&mut tile)),
                        expected.is_hit()
                    );
                }
            }
        }
    }
}
