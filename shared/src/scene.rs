//! Everything that rays meet.

use crate::octree::{Node, Root};
use crate::triangle::{Triangle, Vertex};

/// The arrays of a scene; on the GPU each is a storage buffer.
#[derive(Clone, Copy)]
pub struct Scene<'a> {
    /// The octree's cube.
    pub root: Root,
    /// The octree's cells, the root first.
    pub nodes: &'a [Node],
    /// Ids of triangles, leaf by leaf.
    pub references: &'a [u32],
    /// The triangles by id.
    pub triangles: &'a [Triangle],
    /// What the triangles' corners carry.
    pub vertices: &'a [Vertex],
}
