//! Every combination of parts in one, chosen while it runs.

use crate::aabb::Aabb;
use crate::box_test::{BoxTest, Interval, KayKajiya, Williams};
use crate::buffer::load;
use crate::entered::Entered;
use crate::parts::{BoxKind, TraversalKind, TriangleKind};
use crate::ray::PreparedRay;
use crate::scene::Scene;
use crate::triangle::Triangle;
use crate::triangle_test::{BaldwinWeber, Crossing, MollerTrumbore, Plucker, TriangleTest, Watertight};
use crate::walk::{Along, Leaf, List, Range, Some32, Walk};
use crate::{brute, bvh2, grid, octants, revelles};

/// The parts that [`Scene::parts`] names: slower than the same parts put together at compile time, but a single kernel.
pub type General = Along<AnyWalk, AnyBox, AnyTriangle>;

/// The way through any structure.
pub struct AnyWalk {
    kind: u32,
    octants: octants::Walk,
    octree: revelles::Walk,
    bvh2: bvh2::Walk<AnyBox>,
    grid: grid::Walk,
    brute: brute::Walk,
}

impl AnyWalk {
    fn is(&self, kind: TraversalKind) -> bool {
        self.kind == kind as u32
    }
}

impl Walk for AnyWalk {
    type Leaf = AnyLeaf;

    // It is the largest.
    const SHADOWS_APART: bool = false;

    fn new(scene: &Scene<'_>, entered: &Entered) -> Self {
        AnyWalk {
            // The same way.
            kind: if scene.parts & 7 == TraversalKind::Compact as u32 {
                TraversalKind::Octants as u32
            } else {
                scene.parts & 7
            },
            octants: octants::Walk::new(scene, entered),
            octree: revelles::Walk::new(scene, entered),
            bvh2: bvh2::Walk::new(scene, entered),
            grid: if scene.parts & 7 == TraversalKind::Grid as u32 {
                grid::Walk::new(scene, entered)
            } else {
                grid::Walk::nowhere()
            },
            brute: brute::Walk::new(scene, entered),
        }
    }

    fn goes_on(&self) -> bool {
        if self.is(TraversalKind::Octants) {
            self.octants.goes_on()
        } else if self.is(TraversalKind::Octree) {
            self.octree.goes_on()
        } else if self.is(TraversalKind::Bvh2) {
            self.bvh2.goes_on()
        } else if self.is(TraversalKind::Grid) {
            self.grid.goes_on()
        } else {
            self.brute.goes_on()
        }
    }

    fn leaf(&mut self, scene: &Scene<'_>, limit: f32) -> AnyLeaf {
        if self.is(TraversalKind::Octants) {
            AnyLeaf::of(&self.octants.leaf(scene, limit))
        } else if self.is(TraversalKind::Octree) {
            AnyLeaf::listed(&self.octree.leaf(scene, limit))
        } else if self.is(TraversalKind::Bvh2) {
            AnyLeaf::side_by_side(&self.bvh2.leaf(scene, limit))
        } else if self.is(TraversalKind::Grid) {
            AnyLeaf::listed(&self.grid.leaf(scene, limit))
        } else {
            AnyLeaf::side_by_side(&self.brute.leaf(scene, limit))
        }
    }

    fn leave(&mut self, limit: f32) {
        if self.is(TraversalKind::Octants) {
            self.octants.leave(limit);
        } else if self.is(TraversalKind::Octree) {
            self.octree.leave(limit);
        } else if self.is(TraversalKind::Bvh2) {
            self.bvh2.leave(limit);
        } else if self.is(TraversalKind::Grid) {
            self.grid.leave(limit);
        } else {
            self.brute.leave(limit);
        }
    }
}

/// Any leaf: some of 32 triangles, then a range, whose numbers may be those of references.
pub struct AnyLeaf {
    some: Some32,
    range: Range,
    is_listed: bool,
}

impl AnyLeaf {
    fn of(some: &Some32) -> Self {
        AnyLeaf {
            some: Some32 { ..*some },
            range: Range { next: 0, end: 0 },
            is_listed: false,
        }
    }

    fn side_by_side(range: &Range) -> Self {
        AnyLeaf {
            some: Some32 { first: 0, bits: 0 },
            range: Range { ..*range },
            is_listed: false,
        }
    }

    fn listed(list: &List) -> Self {
        AnyLeaf {
            some: Some32 { first: 0, bits: 0 },
            range: Range {
                next: list.next,
                end: list.end,
            },
            is_listed: true,
        }
    }
}

impl Leaf for AnyLeaf {
    fn remains(&self) -> bool {
        self.some.remains() | self.range.remains()
    }

    fn take(&mut self, scene: &Scene<'_>) -> u32 {
        if self.some.remains() {
            self.some.take(scene)
        } else {
            let at = self.range.take(scene);
            if self.is_listed { load(scene.references, at) } else { at }
        }
    }
}

/// Any triangle test; prepares anew for each triangle.
#[derive(Clone, Copy)]
pub struct AnyTriangle {
    kind: u32,
    ray: PreparedRay,
}

impl TriangleTest for AnyTriangle {
    #[inline(always)]
    fn prepare(ray: &PreparedRay) -> Self {
        AnyTriangle { kind: 0, ray: *ray }
    }

    #[inline(always)]
    fn prepare_in(scene: &Scene<'_>, ray: &PreparedRay) -> Self {
        AnyTriangle {
            kind: scene.parts >> 3 & 3,
            ray: *ray,
        }
    }

    #[inline(always)]
    fn crossing(&self, triangle: &Triangle) -> Crossing {
        crossing(self.kind, self.ray, *triangle)
    }

    #[inline(always)]
    fn crossing_at(&self, scene: &Scene<'_>, slot: u32) -> Crossing {
        self.crossing(&scene.triangle(slot))
    }
}

/// In the kernel once, not wherever a ray is traced.
#[cfg_attr(target_arch = "spirv", inline(never))]
fn crossing(kind: u32, ray: PreparedRay, triangle: Triangle) -> Crossing {
    if kind == TriangleKind::Watertight as u32 {
        Watertight::prepare(&ray).crossing(&triangle)
    } else if kind == TriangleKind::MollerTrumbore as u32 {
        MollerTrumbore::prepare(&ray).crossing(&triangle)
    } else if kind == TriangleKind::BaldwinWeber as u32 {
        BaldwinWeber::prepare(&ray).crossing(&triangle)
    } else {
        Plucker::prepare(&ray).crossing(&triangle)
    }
}

/// Any box test.
#[derive(Clone, Copy)]
pub struct AnyBox {
    kind: u32,
    ray: PreparedRay,
}

impl BoxTest for AnyBox {
    #[inline(always)]
    fn prepare(ray: &PreparedRay) -> Self {
        AnyBox { kind: 0, ray: *ray }
    }

    #[inline(always)]
    fn prepare_in(scene: &Scene<'_>, ray: &PreparedRay) -> Self {
        AnyBox {
            kind: scene.parts >> 5,
            ray: *ray,
        }
    }

    #[inline(always)]
    fn interval(&self, aabb: &Aabb) -> Interval {
        if self.kind == BoxKind::KayKajiya as u32 {
            KayKajiya::prepare(&self.ray).interval(aabb)
        } else {
            Williams::prepare(&self.ray).interval(aabb)
        }
    }
}
