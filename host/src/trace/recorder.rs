//! What a traversal reads and tests, written down while it runs.
//!
//! The nodes that the traversal is given differ from the scene's in one word: where its leaf begins, each has its own
//! number, from which the recorder around the walk knows the node; it hands on where the leaf begins indeed.

use crate::scene::Scene;
use glam::UVec4;
use oktant_shared::aabb::Aabb;
use oktant_shared::box_test::{BoxTest, Interval, KayKajiya, Williams};
use oktant_shared::entered::Entered;
use oktant_shared::general::AnyTriangle;
use oktant_shared::grid::FIRST_CELL;
use oktant_shared::hit::Hit;
use oktant_shared::octree::Node;
use oktant_shared::parts::{BoxKind, TraversalKind};
use oktant_shared::ray::{PreparedRay, Ray};
use oktant_shared::scene::Scene as View;
use oktant_shared::traversal::Traversal;
use oktant_shared::triangle::Triangle;
use oktant_shared::triangle_test::{Crossing, TriangleTest};
use oktant_shared::walk::{Along, Leaf, List, Range, Some32, Walk};
use oktant_shared::{brute, bvh2, grid, octants, revelles};
use std::cell::RefCell;
use std::sync::Arc;

/// What was written down.
pub struct Record {
    /// What was found, with the triangle's slot.
    pub hit: Hit,
    /// The ray as it was traced.
    pub ray: PreparedRay,
    /// What was visited.
    pub events: Vec<Event>,
    /// Slots of the triangles that were tested.
    pub tests: Vec<u32>,
}

/// Something on the ray's way.
#[derive(Clone, Copy, Debug)]
pub enum Event {
    /// A leaf of the walk, by its number, or by the slot of its first triangle; hits behind the limit, in the prepared `t`,
    /// are not wanted any more.
    Leaf {
        /// Number or slot.
        number: u32,
        /// The nearest hit so far.
        limit: f32,
        /// Of up to 32 triangles of a node those whose leaves were met; else how many there are.
        bits: u32,
    },
    /// A box that was tested.
    Box(Aabb),
}

thread_local! {
    static NOTES: RefCell<Notes> = const {
        RefCell::new(Notes { firsts: None, ray: None, events: Vec::new(), tests: Vec::new() })
    };
}

struct Notes {
    /// Where the leaf begins that has a number; leaves without one begin at it.
    firsts: Option<Arc<[u32]>>,
    ray: Option<PreparedRay>,
    events: Vec<Event>,
    tests: Vec<u32>,
}

/// Writes down rays through one scene; it is made once for any number of them.
pub struct Recorder {
    nodes: Vec<UVec4>,
    firsts: Arc<[u32]>,
}

impl Recorder {
    /// The recorder of a scene.
    pub fn new(scene: &Scene) -> Self {
        let (nodes, firsts) = numbered(scene);
        Recorder {
            nodes,
            firsts: firsts.into(),
        }
    }

    /// Traces a ray for its closest hit with the parts that the scene was built for: the one of [`Recorder::new`].
    pub fn record(&self, scene: &Scene, ray: &Ray) -> Record {
        NOTES.set(Notes {
            firsts: Some(self.firsts.clone()),
            ray: None,
            events: Vec::new(),
            tests: Vec::new(),
        });
        let view = View {
            nodes: &self.nodes,
            ..scene.view()
        };
        let hit = match scene.parts.box_test {
            BoxKind::KayKajiya => with_box::<KayKajiya>(scene, &view, ray),
            BoxKind::Williams => with_box::<Williams>(scene, &view, ray),
        };
        NOTES.with_borrow_mut(|notes| Record {
            hit,
            ray: notes.ray.unwrap_or_else(|| PreparedRay::new(ray)),
            events: std::mem::take(&mut notes.events),
            tests: std::mem::take(&mut notes.tests),
        })
    }
}

fn with_box<B: BoxTest>(scene: &Scene, view: &View<'_>, ray: &Ray) -> Hit {
    // Any triangle test, chosen while it runs, so that a new one needs nothing here.
    type T = Tests<AnyTriangle>;
    match scene.parts.traversal {
        TraversalKind::Octants | TraversalKind::Compact => {
            Along::<Recorded<octants::Walk>, B, T>::closest_hit(view, ray)
        }
        TraversalKind::Octree => Along::<Recorded<revelles::Walk>, B, T>::closest_hit(view, ray),
        TraversalKind::Grid => Along::<Recorded<grid::Walk>, B, T>::closest_hit(view, ray),
        TraversalKind::Bvh2 => Along::<Recorded<bvh2::Walk<Boxes<B>>>, B, T>::closest_hit(view, ray),
        TraversalKind::Brute => Along::<Recorded<brute::Walk>, B, T>::closest_hit(view, ray),
    }
}

/// The nodes with numbers in the places of the leaves' beginnings, and those; none where slots tell the leaves apart.
fn numbered(scene: &Scene) -> (Vec<UVec4>, Vec<u32>) {
    let mut nodes = scene.nodes.to_vec();
    let mut firsts = Vec::new();
    match scene.parts.traversal {
        TraversalKind::Octants | TraversalKind::Compact => {
            for (number, node) in nodes.chunks_exact_mut(octants::NODE_VECTORS as usize).enumerate() {
                firsts.push(node[1].y);
                node[1].y = number as u32;
            }
        }
        TraversalKind::Octree | TraversalKind::Grid => {
            let is_grid = scene.parts.traversal == TraversalKind::Grid;
            let before = if is_grid { FIRST_CELL as usize } else { 0 };
            let words: &mut [Node] = bytemuck::cast_slice_mut(&mut nodes);
            for (number, node) in words[before..].iter_mut().enumerate() {
                firsts.push(node.first);
                if !node.is_inner() {
                    node.first = number as u32;
                }
            }
        }
        TraversalKind::Bvh2 | TraversalKind::Brute => {}
    }
    (nodes, firsts)
}

/// A leaf whose beginning is a number.
trait Numbered: Leaf + Sized {
    /// The number.
    fn number(&self) -> u32;

    /// See [`Event::Leaf`].
    fn bits(&self) -> u32;

    /// The leaf that begins where it does.
    fn beginning(self, first: u32) -> Self;
}

impl Numbered for Some32 {
    fn number(&self) -> u32 {
        self.first
    }

    fn bits(&self) -> u32 {
        self.bits
    }

    fn beginning(self, first: u32) -> Self {
        Some32 { first, ..self }
    }
}

macro_rules! numbered {
    ($($leaf:ident)+) => {$(
        impl Numbered for $leaf {
            fn number(&self) -> u32 {
                self.next
            }

            fn bits(&self) -> u32 {
                self.end - self.next
            }

            fn beginning(self, first: u32) -> Self {
                $leaf {
                    next: first,
                    end: first + (self.end - self.next),
                }
            }
        }
    )+};
}

numbered!(List Range);

/// The way `W`, whose leaves are written down.
struct Recorded<W>(W);

impl<W: Walk<Leaf: Numbered>> Walk for Recorded<W> {
    type Leaf = W::Leaf;

    fn enter<B: BoxTest>(scene: &View<'_>, ray: &Ray) -> Entered {
        let entered = W::enter::<B>(scene, ray);
        NOTES.with_borrow_mut(|notes| notes.ray = Some(entered.ray));
        entered
    }

    fn new(scene: &View<'_>, entered: &Entered) -> Self {
        Recorded(W::new(scene, entered))
    }

    fn goes_on(&self) -> bool {
        self.0.goes_on()
    }

    fn leaf(&mut self, scene: &View<'_>, limit: f32) -> W::Leaf {
        let leaf = self.0.leaf(scene, limit);
        // A walk that came to its end has no leaf.
        if !self.0.goes_on() {
            return leaf;
        }
        NOTES.with_borrow_mut(|notes| {
            let number = leaf.number();
            notes.events.push(Event::Leaf {
                number,
                limit,
                bits: leaf.bits(),
            });
            let firsts = notes.firsts.as_deref().unwrap_or_default();
            leaf.beginning(firsts.get(number as usize).copied().unwrap_or(number))
        })
    }

    fn leave(&mut self, limit: f32) {
        self.0.leave(limit);
    }
}

/// The box test `B`, whose boxes are written down.
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
        NOTES.with_borrow_mut(|notes| notes.events.push(Event::Box(*aabb)));
        self.0.interval(aabb)
    }
}

/// The triangle test `T`, whose triangles are written down.
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
        self.0.crossing(triangle)
    }

    fn crossing_at(&self, scene: &View<'_>, slot: u32) -> Crossing {
        NOTES.with_borrow_mut(|notes| notes.tests.push(slot));
        self.0.crossing_at(scene, slot)
    }
}
