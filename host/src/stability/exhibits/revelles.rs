//! The parametric octree traversal as it was published, and with each of its failures.

use super::cells::{Extent, Faces};
use crate::mesh::Mesh;
use glam::Vec3;
use oktant_shared::hit::Hit;
use oktant_shared::ray::{PreparedRay, Ray};
use oktant_shared::triangle::Triangle;
use oktant_shared::triangle_test::{TriangleTest, Watertight};

/// What is done about components of the direction that are zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Zeros {
    /// Nothing.
    Published,
    /// They are made 10^-7.
    Tiny,
    /// Entry and exit are infinite, middles are told by the origin.
    Ruled,
}

/// A form of the traversal.
#[derive(Clone, Copy, Debug)]
pub struct Form {
    /// Zero components.
    pub zeros: Zeros,
    /// Whether middle planes are crossed half-way between the outer ones; else where they are.
    pub averaged: bool,
    /// Whether Table 1 has the bits of x and z swapped, as in the paper and the thesis.
    pub swapped: bool,
    /// Whether the first leaf with a hit ends the search, as in the thesis.
    pub first_leaf: bool,
    /// Whether a ray must be inside for more than a moment.
    pub strict: bool,
    /// What belongs to a cell.
    pub faces: Faces,
    /// Whether the ray's origin is mirrored, as published; else the planes are met in the other order.
    pub mirrors_origin: bool,
}

impl Form {
    /// As published, with the authors' erratum to Table 1.
    pub const PUBLISHED: Form = Form {
        zeros: Zeros::Published,
        averaged: true,
        swapped: false,
        first_leaf: false,
        strict: true,
        faces: Faces::Closed,
        mirrors_origin: true,
    };

    /// Without the failures of the others.
    pub const MENDED: Form = Form {
        zeros: Zeros::Ruled,
        averaged: false,
        strict: false,
        mirrors_origin: false,
        ..Form::PUBLISHED
    };
}

/// No cell is split that has so few triangles, or is this deep.
const LEAF: usize = 4;
const DEPTH: u32 = 7;

enum Node {
    Leaf(Vec<u32>),
    /// Child `x + 2 y + 4 z`.
    Inner(Box<[Node; 8]>),
}

/// An octree of a mesh whose root is the mesh's box, and a form of the traversal.
pub struct Revelles {
    form: Form,
    low: Vec3,
    high: Vec3,
    root: Node,
    triangles: Vec<Triangle>,
}

/// A ray on its way.
struct Search<'a> {
    tree: &'a Revelles,
    /// Mirrored where the form says so, so that no component of the direction is negative.
    origin: Vec3,
    direction: Vec3,
    /// Axes that were mirrored.
    mirrored: usize,
    test: Watertight,
    ray: PreparedRay,
    best: Hit,
}

impl Revelles {
    /// Builds the octree.
    pub fn new(mesh: &Mesh, form: Form) -> Self {
        let extents = Extent::of_triangles(mesh);
        let all = Extent::of_all(&extents);
        let ids = (0..extents.len() as u32).collect();
        Revelles {
            form,
            low: all.low,
            high: all.high,
            root: build(&extents, ids, all.low, all.high, form.faces, 0),
            triangles: super::super::subject::triangles(mesh),
        }
    }

    /// The closest hit, with the triangle's id.
    pub fn closest_hit(&self, ray: &Ray) -> Hit {
        let prepared = PreparedRay::new(ray);
        let mut search = Search {
            tree: self,
            origin: ray.origin,
            direction: ray.direction,
            mirrored: 0,
            test: Watertight::prepare(&prepared),
            best: Hit::miss(ray.t_max),
            ray: prepared,
        };
        let (mut low, mut high) = (self.low, self.high);
        for axis in 0..3 {
            if self.form.zeros == Zeros::Tiny && search.direction[axis] == 0.0 {
                search.direction[axis] = 1e-7;
            }
            if search.direction[axis] < 0.0 {
                search.mirrored |= 1 << axis;
                if self.form.mirrors_origin {
                    search.origin[axis] = self.low[axis] + self.high[axis] - search.origin[axis];
                    search.direction[axis] = -search.direction[axis];
                } else {
                    (low[axis], high[axis]) = (self.high[axis], self.low[axis]);
                }
            }
        }
        let [enter, exit] = [low, high].map(|plane| (plane - search.origin) / search.direction);
        let (mut enter, mut exit) = (enter, exit);
        for axis in 0..3 {
            if self.form.zeros == Zeros::Ruled && search.direction[axis] == 0.0 {
                if search.origin[axis] < self.low[axis] || search.origin[axis] > self.high[axis] {
                    return search.best;
                }
                (enter[axis], exit[axis]) = (f32::NEG_INFINITY, f32::INFINITY);
            }
        }
        let (first, last) = (greatest(enter), least(exit));
        if first < last || (!self.form.strict && first <= last) {
            search.visit(&self.root, enter, exit, low, high);
        }
        search.best
    }
}

impl Search<'_> {
    /// Visits a cell; returns whether the search is at its end. Its corners are those that the ray moves away from and
    /// towards, of the mirrored root where that is mirrored.
    fn visit(&mut self, node: &Node, enter: Vec3, exit: Vec3, low: Vec3, high: Vec3) -> bool {
        if exit.cmplt(Vec3::ZERO).any() {
            return false;
        }
        let children = match node {
            Node::Leaf(ids) => return self.test_all(ids, least(exit)),
            Node::Inner(children) => children,
        };
        let center = 0.5 * (low + high);
        let mut middle = 0.5 * (enter + exit);
        for axis in 0..3 {
            if self.tree.form.zeros == Zeros::Ruled && self.direction[axis] == 0.0 {
                let before = self.origin[axis] < center[axis];
                middle[axis] = if before { f32::INFINITY } else { f32::NEG_INFINITY };
            } else if !self.tree.form.averaged {
                middle[axis] = (center[axis] - self.origin[axis]) / self.direction[axis];
            }
        }
        let mut place = self.first_child(enter, middle);
        loop {
            let (mut from, mut to) = (enter, middle);
            let (mut child_low, mut child_high) = (low, center);
            for axis in 0..3 {
                if place >> axis & 1 == 1 {
                    (from[axis], to[axis]) = (middle[axis], exit[axis]);
                    (child_low[axis], child_high[axis]) = (center[axis], high[axis]);
                }
            }
            if self.visit(&children[place ^ self.mirrored], from, to, child_low, child_high) {
                return true;
            }
            // Through which plane the ray leaves.
            let axis = if to.x < to.y && to.x < to.z {
                0
            } else if to.y < to.z {
                1
            } else {
                2
            };
            if place >> axis & 1 == 1 {
                return false;
            }
            place |= 1 << axis;
        }
    }

    /// By the entry plane (Table 1).
    fn first_child(&self, enter: Vec3, middle: Vec3) -> usize {
        let axis = if enter.x > enter.y && enter.x > enter.z {
            0
        } else if enter.y > enter.z {
            1
        } else {
            2
        };
        let mut place = 0;
        for other in (0..3).filter(|other| *other != axis) {
            if middle[other] < enter[axis] {
                place |= 1 << other;
            }
        }
        // Where the cell is entered through the middle plane, or the ray begins behind it.
        if middle[axis] < enter[axis] {
            place |= 1 << axis;
        }
        if self.tree.form.swapped {
            place = place & 2 | (place & 1) << 2 | place >> 2;
        }
        place
    }

    fn test_all(&mut self, ids: &[u32], exit: f32) -> bool {
        let mut found = false;
        for id in ids {
            let crossing = self.test.crossing(&self.tree.triangles[*id as usize]);
            let t = crossing.t * self.ray.scale;
            if self.ray.valid && crossing.crosses && crossing.t >= self.ray.t_min && t <= self.best.t {
                found = true;
                if t < self.best.t || *id < self.best.triangle {
                    self.best = Hit {
                        t,
                        triangle: *id,
                        u: crossing.u,
                        v: crossing.v,
                    };
                }
            }
        }
        if self.tree.form.first_leaf {
            found
        } else {
            self.best.is_hit() && self.best.t <= exit
        }
    }
}

fn build(extents: &[Extent], ids: Vec<u32>, low: Vec3, high: Vec3, faces: Faces, depth: u32) -> Node {
    if ids.len() <= LEAF || depth == DEPTH {
        return Node::Leaf(ids);
    }
    let center = 0.5 * (low + high);
    Node::Inner(Box::new(std::array::from_fn(|child| {
        let (mut child_low, mut child_high) = (low, center);
        for axis in 0..3 {
            if child >> axis & 1 == 1 {
                (child_low[axis], child_high[axis]) = (center[axis], high[axis]);
            }
        }
        let inside = |id: &u32| extents[*id as usize].overlaps(faces, child_low, child_high);
        let ids = ids.iter().copied().filter(inside).collect();
        build(extents, ids, child_low, child_high, faces, depth + 1)
    })))
}

fn greatest(v: Vec3) -> f32 {
    let two = if v.x > v.y { v.x } else { v.y };
    if two > v.z { two } else { v.z }
}

fn least(v: Vec3) -> f32 {
    let two = if v.x < v.y { v.x } else { v.y };
    if two < v.z { two } else { v.z }
}
