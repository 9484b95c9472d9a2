//! Closing the holes of a mesh.

use std::collections::HashMap;

use glam::DVec3;
use oktant::mesh::Mesh;

/// An edge without its direction.
fn undirected(a: u32, b: u32) -> (u32, u32) {
    (a.min(b), a.max(b))
}

fn edges([a, b, c]: [u32; 3]) -> [(u32, u32); 3] {
    [(a, b), (b, c), (c, a)]
}

/// How many triangles meet at each edge.
fn edge_uses(mesh: &Mesh) -> HashMap<(u32, u32), u32> {
    let mut uses = HashMap::new();
    for (a, b) in mesh.triangles.iter().copied().flat_map(edges) {
        *uses.entry(undirected(a, b)).or_insert(0) += 1;
    }
    uses
}

/// Whether exactly two triangles meet at every edge, so that the surface has an inside.
pub fn is_closed(mesh: &Mesh) -> bool {
    edge_uses(mesh).values().all(|&uses| uses == 2)
}

/// The same mesh with a fan of triangles from the edges of every hole to a new vertex at the hole's centroid. Closed,
/// unless more than two triangles meet at an edge. Without normals and colours.
///
/// # Panics
/// If the edges of the holes do not form loops, which takes an edge with three triangles.
pub fn with_holes_fanned(mesh: &Mesh) -> Mesh {
    let uses = edge_uses(mesh);
    // Against the direction of the triangle at the edge, so that the fan faces the same way; in file order, so that
    // the outcome is the same every time.
    let boundary: Vec<(u32, u32)> = mesh
        .triangles
        .iter()
        .copied()
        .flat_map(edges)
        .filter(|&(a, b)| uses[&undirected(a, b)] == 1)
        .map(|(a, b)| (b, a))
        .collect();
    let mut closed = Mesh {
        positions: mesh.positions.clone(),
        triangles: mesh.triangles.clone(),
        shift: mesh.shift,
        ..Mesh::default()
    };
    for hole in loops(&boundary) {
        let sum: DVec3 = hole.iter().map(|&(a, _)| mesh.positions[a as usize].as_dvec3()).sum();
        let hub = closed.positions.len() as u32;
        closed.positions.push((sum / hole.len() as f64).as_vec3());
        closed.triangles.extend(hole.into_iter().map(|(a, b)| [a, b, hub]));
    }
    closed
}

/// Takes the edges apart into loops that pass no vertex twice: a fan over one that does would have edges with four
/// triangles.
fn loops(edges: &[(u32, u32)]) -> Vec<Vec<(u32, u32)>> {
    let mut leaving: HashMap<u32, Vec<(u32, u32)>> = HashMap::new();
    for &edge in edges {
        leaving.entry(edge.0).or_default().push(edge);
    }
    let mut loops = Vec::new();
    for &(start, _) in edges {
        let mut path: Vec<(u32, u32)> = Vec::new();
        let mut vertex = start;
        while let Some(edge) = leaving.get_mut(&vertex).and_then(Vec::pop) {
            path.push(edge);
            vertex = edge.1;
            if let Some(first) = path.iter().position(|&(from, _)| from == vertex) {
                loops.push(path.split_off(first));
            }
        }
        assert!(
            path.is_empty(),
            "the edges of the holes form no loops at vertex {vertex}"
        );
    }
    loops
}

#[cfg(test)]
mod tests {
    use super::super::{fan_64, flat_grid, icosphere};
    use super::*;

    #[test]
    fn a_closed_mesh_stays_as_it_is() {
        let sphere = icosphere(1);
        assert_eq!(with_holes_fanned(&sphere), sphere);
    }

    #[test]
    fn one_hole_gets_one_fan() {
        for (open, boundary) in [(fan_64(), 64), (flat_grid(4), 16)] {
            assert!(!is_closed(&open));
            let closed = with_holes_fanned(&open);
            assert!(is_closed(&closed));
            assert_eq!(closed.triangles.len(), open.triangles.len() + boundary);
            assert_eq!(closed.positions.len(), open.positions.len() + 1);
        }
    }

    /// Two opposite triangles of an icosphere, and two that share a corner, leave holes that touch in a vertex.
    #[test]
    fn holes_that_touch_get_a_fan_each() {
        let whole = icosphere(1);
        let corner = whole.triangles[0][0];
        let round: Vec<usize> = (0..whole.triangles.len())
            .filter(|&id| whole.triangles[id].contains(&corner))
            .collect();
        let shares_edge = |a: usize, b: usize| {
            let common = whole.triangles[a]
                .iter()
                .filter(|vertex| whole.triangles[b].contains(vertex));
            common.count() == 2
        };
        let opposite = *round[1..].iter().find(|&&id| !shares_edge(round[0], id)).unwrap();
        let mut open = whole.clone();
        for id in [opposite, round[0]] {
            open.triangles.remove(id);
        }
        let closed = with_holes_fanned(&open);
        assert!(is_closed(&closed));
        assert_eq!(closed.positions.len(), whole.positions.len() + 2);
        // Facing the same way: every edge is passed once in each direction.
        let mut directed: Vec<_> = closed.triangles.iter().copied().flat_map(edges).collect();
        directed.sort_unstable();
        directed.dedup();
        assert_eq!(directed.len(), 3 * closed.triangles.len());
    }
}
