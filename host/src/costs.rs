//! What a traversal's work costs.

use serde::Deserialize;

/// What the surface area heuristic counts with, in any unit: only their ratio decides.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Costs {
    /// Cost of a step of the traversal: of a tree of boxes a node with the boxes of its children, of the octree the way from
    /// a leaf to the next.
    pub node: f32,
    /// Cost of testing a triangle.
    pub triangle: f32,
}

impl Costs {
    /// Of the tree of tight boxes whose children lie in the slots of octants. Ylitie et al. 2017 count 0.3 for a triangle;
    /// here leaves that are smaller by that are 1 to 3 % faster on a GPU.
    pub const OCTANTS: Costs = Costs {
        node: 1.0,
        triangle: 0.5,
    };

    /// Of the octree of Revelles.
    pub const OCTREE: Costs = Costs {
        node: 2.0,
        triangle: 1.0,
    };

    /// What so many steps and tests cost.
    pub fn of(&self, nodes: f64, triangles: f64) -> f64 {
        f64::from(self.node) * nodes + f64::from(self.triangle) * triangles
    }
}
