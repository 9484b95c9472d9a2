//! How much work rays are, counted.

use crate::backend::Query;
use crate::scene::Scene;
use oktant_shared::aabb::Aabb;
use oktant_shared::box_test::{BoxTest, Interval, KayKajiya, Williams};
use oktant_shared::entered::Entered;
use oktant_shared::general::AnyTriangle;
use oktant_shared::parts::{BoxKind, Parts, TraversalKind};
use oktant_shared::ray::{PreparedRay, Ray};
use oktant_shared::scene::Scene as View;
use oktant_shared::traversal::Traversal;
use oktant_shared::triangle::Triangle;
use oktant_shared::triangle_test::{Crossing, TriangleTest};
use oktant_shared::walk::{Along, Walk};
use oktant_shared::{brute, bvh2, grid, octants, revelles};
use rayon::prelude::*;
use serde::Serialize;
use std::cell::Cell;
use std::iter::Sum;

/// What rays read: the same for the same scene and rays, whatever the number of threads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Nodes; of the octree its leaves, of the grid its cells.
    pub nodes: u64,
    /// Triangles that were tested.
    pub triangle_tests: u64,
}

impl Sum for Counts {
    fn sum<I: Iterator<Item = Counts>>(counts: I) -> Counts {
        counts.fold(Counts::default(), |sum, counts| Counts {
            nodes: sum.nodes + counts.nodes,
            triangle_tests: sum.triangle_tests + counts.triangle_tests,
        })
    }
}

thread_local! {
    /// What the rays of this thread have read since it was last taken.
    static READ: Cell<Counts> = const { Cell::new(Counts { nodes: 0, triangle_tests: 0 }) };
}

/// Rays that a thread takes at least.
const CHUNK: usize = 256;

/// Traces rays with any combination of parts, also of those that are not offered, and counts what they read. The scene's
/// structure must be the one that the traversal reads.
///
/// It is the code of the traversals that is measured, with parts put in that count: around the triangle test, around the way
/// through the structure, and, where that reads more than a node at a time, around the box test.
pub fn count(scene: &Scene, parts: Parts, query: Query, rays: &[Ray]) -> Counts {
    count_each(scene, parts, query, rays).into_iter().sum()
}

/// As [`count`], each ray by itself.
pub fn count_each(scene: &Scene, parts: Parts, query: Query, rays: &[Ray]) -> Vec<Counts> {
    match parts.box_test {
        BoxKind::KayKajiya => with_box::<KayKajiya>(scene, parts, query, rays),
        BoxKind::Williams => with_box::<Williams>(scene, parts, query, rays),
    }
}

fn with_box<B: BoxTest>(scene: &Scene, parts: Parts, query: Query, rays: &[Ray]) -> Vec<Counts> {
    // Any triangle test, chosen while it runs, so that a new one needs nothing here.
    type T = Tests<AnyTriangle>;
    let scene = View {
        parts: parts.number(),
        ..scene.view()
    };
    let scene = &scene;
    match parts.traversal {
        TraversalKind::Octants | TraversalKind::Compact => {
            trace::<Along<Steps<octants::Walk>, B, T>>(scene, query, rays)
        }
        TraversalKind::Octree => trace::<Along<Steps<revelles::Walk>, B, T>>(scene, query, rays),
        TraversalKind::Grid => trace::<Along<Steps<grid::Walk>, B, T>>(scene, query, rays),
        TraversalKind::Bvh2 => {
            let mut counts = trace::<Along<bvh2::Walk<Boxes<B>>, B, T>>(scene, query, rays);
            for counts in &mut counts {
                // Two boxes a node.
                counts.nodes /= 2;
            }
            counts
        }
        TraversalKind::Brute => trace::<Along<brute::Walk, B, T>>(scene, query, rays),
    }
}

fn trace<V: Traversal>(scene: &View<'_>, query: Query, rays: &[Ray]) -> Vec<Counts> {
    let counts = rays.par_iter().with_min_len(CHUNK).map(|ray| {
        READ.take();
        match query {
            Query::Closest => {
                V::closest_hit(scene, ray);
            }
            Query::Any => {
                V::any_hit(scene, ray);
            }
        }
        READ.take()
    });
    counts.collect()
}

/// Counts one more node.
fn read_node() {
    READ.set(Counts {
        nodes: READ.get().nodes + 1,
        ..READ.get()
    });
}

/// Counts one more triangle.
fn tested() {
    READ.set(Counts {
        triangle_tests: READ.get().triangle_tests + 1,
        ..READ.get()
    });
}

/// The way `W`, each of whose steps counts as a node.
struct Steps<W>(W);

impl<W: Walk> Walk for Steps<W> {
    type Leaf = W::Leaf;

    fn enter<B: BoxTest>(scene: &View<'_>, ray: &Ray) -> Entered {
        W::enter::<B>(scene, ray)
    }

    fn new(scene: &View<'_>, entered: &Entered) -> Self {
        Steps(W::new(scene, entered))
    }

    fn goes_on(&self) -> bool {
        self.0.goes_on()
    }

    fn leaf(&mut self, scene: &View<'_>, limit: f32) -> W::Leaf {
        read_node();
        self.0.leaf(scene, limit)
    }

    fn leave(&mut self, limit: f32) {
        self.0.leave(limit);
    }
}

/// The box test `B`, each of whose boxes counts as a node.
#[derive(Clone, Copy)]
struct Boxes<B>(B);

impl<B: BoxTest> BoxTest for Boxes<B> {
    fn prepare(ray: &PreparedRay) -> Self {
        Boxes(B::prepare(ray))
    }

    fn prepare_in(scene: &View<'_>, ray: &PreparedRay) -> Self {
        Boxes(B::prepare_in(scene, ray))
    }

    fn interval(&self, aabb: &Aabb) -> Interval {
        read_node();
        self.0.interval(aabb)
    }
}

/// The triangle test `T`, counted.
#[derive(Clone, Copy)]
struct Tests<T>(T);

impl<T: TriangleTest> TriangleTest for Tests<T> {
    fn prepare(ray: &PreparedRay) -> Self {
        Tests(T::prepare(ray))
    }

    fn prepare_in(scene: &View<'_>, ray: &PreparedRay) -> Self {
        Tests(T::prepare_in(scene, ray))
    }

    fn crossing(&self, triangle: &Triangle) -> Crossing {
        tested();
        self.0.crossing(triangle)
    }

    fn crossing_at(&self, scene: &View<'_>, slot: u32) -> Crossing {
        tested();
        self.0.crossing_at(scene, slot)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generated::soup;
    use crate::progress::silent;
    use crate::structure::StructureOptions;
    use glam::{Vec3, vec3};

    fn scene(traversal: TraversalKind) -> Scene {
        let options = StructureOptions::of(traversal);
        Scene::new(&soup(500), &options, &silent).unwrap()
    }

    fn rays() -> Vec<Ray> {
        let place = |i: usize| vec3((i % 50) as f32 / 25.0 - 1.0, (i / 50) as f32 / 25.0 - 1.0, -3.0);
        (0..2_500).map(|i| Ray::new(place(i), Vec3::Z)).collect()
    }

    #[test]
    fn brute_force_tests_all_triangles_of_rays_that_meet_the_cube() {
        let brute = scene(TraversalKind::Brute);
        let counts = count(&brute, brute.parts, Query::Closest, &rays());
        assert_eq!((counts.nodes, counts.triangle_tests), (0, 2_500 * 500));
    }

    /// A tree reads a root for every ray, and must spare most triangles; any hits read no more than closest ones.
    #[test]
    fn structures_spare_triangles() {
        for traversal in [
            TraversalKind::Octants,
            TraversalKind::Octree,
            TraversalKind::Bvh2,
            TraversalKind::Grid,
        ] {
            let scene = scene(traversal);
            let [closest, any] = [Query::Closest, Query::Any].map(|query| count(&scene, scene.parts, query, &rays()));
            assert!(closest.nodes > 2_000, "{traversal}: {closest:?}");
            assert!(closest.triangle_tests < 2_500 * 500 / 4, "{traversal}: {closest:?}");
            assert!(
                any.triangle_tests < closest.triangle_tests && any.nodes <= closest.nodes,
                "{traversal}"
            );
        }
    }

    #[test]
    fn counts_are_the_same_on_any_number_of_threads() {
        let scene = scene(TraversalKind::Bvh2);
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| count(&scene, scene.parts, Query::Closest, &rays()))
        };
        let one = on(1);
        assert!(one.nodes >= 2_500);
        assert_eq!(one, on(3));
    }
}
