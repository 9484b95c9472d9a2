//! Triangles that need no reference of their own.

use crate::mesh::Mesh;
use glam::Vec3;
use rayon::prelude::*;

/// The triangles that can be hit, ascending, and how many cannot.
pub(crate) struct Distinct {
    /// Ids of the triangles that have an area and do not lie exactly on one with a lower id.
    pub ids: Vec<u32>,
    /// Triangles without area.
    pub degenerate: u32,
    /// Triangles with the same three corners, in any order, as one with a lower id.
    pub duplicates: u32,
}

/// The slots of triangles that lie exactly on one with a lower id; `ids` are the triangles' by slot.
pub(crate) fn duplicates(mesh: &Mesh, ids: &[u32]) -> Vec<u32> {
    let corners = |id: u32| mesh.triangles[id as usize].map(|index| mesh.positions[index as usize]);
    let mut hashed: Vec<(u64, u32)> = ids
        .par_iter()
        .enumerate()
        .map(|(slot, id)| (hash(&corners(*id)), slot as u32))
        .collect();
    hashed.par_sort_unstable();
    let mut duplicates = Vec::new();
    for group in hashed.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1) {
        let mut known: Vec<[[u32; 3]; 3]> = Vec::new();
        let mut slots: Vec<u32> = group.iter().map(|(_, slot)| *slot).collect();
        slots.sort_unstable_by_key(|slot| ids[*slot as usize]);
        for slot in slots {
            let key = sorted(&corners(ids[slot as usize]));
            if known.contains(&key) {
                duplicates.push(slot);
            } else {
                known.push(key);
            }
        }
    }
    duplicates
}

/// Sorts out what no ray can hit, or not first: of coincident triangles the lowest id wins anyway.
pub(crate) fn distinct(mesh: &Mesh, corners: &[[Vec3; 3]]) -> Distinct {
    // Sorted by a hash of the corners, equal triangles are neighbours.
    let mut hashed: Vec<(u64, u32)> = corners
        .par_iter()
        .enumerate()
        .filter(|(_, corners)| has_area(corners))
        .map(|(id, corners)| (hash(corners), id as u32))
        .collect();
    let degenerate = (mesh.triangles.len() - hashed.len()) as u32;
    hashed.par_sort_unstable();
    let mut ids = Vec::with_capacity(hashed.len());
    for group in hashed.chunk_by(|a, b| a.0 == b.0) {
        let first = ids.len();
        for (_, id) in group {
            let key = sorted(&corners[*id as usize]);
            let known = ids[first..]
                .iter()
                .any(|other: &u32| sorted(&corners[*other as usize]) == key);
            if !known {
                ids.push(*id);
            }
        }
    }
    let duplicates = (hashed.len() - ids.len()) as u32;
    ids.par_sort_unstable();
    Distinct {
        ids,
        degenerate,
        duplicates,
    }
}

/// Whether a ray can hit the triangle at all: edges that f32 holds have an exact enough product in f64.
pub(crate) fn has_area(corners: &[Vec3; 3]) -> bool {
    let [a, b, c] = corners.map(|corner| corner.as_dvec3());
    (b - a).cross(c - a).length_squared() > 0.0
}

/// The corners in an order of their own, as bits; adding zero makes the two zeros one.
fn sorted(corners: &[Vec3; 3]) -> [[u32; 3]; 3] {
    let mut bits = corners.map(|corner| corner.to_array().map(|x| (x + 0.0).to_bits()));
    bits.sort_unstable();
    bits
}

/// Any even spread will do: equal hashes are compared in full.
fn hash(corners: &[Vec3; 3]) -> u64 {
    sorted(corners)
        .as_flattened()
        .iter()
        .fold(0xcbf2_9ce4_8422_2325, |hash, word| {
            (hash ^ u64::from(*word))
                .wrapping_mul(0x9e37_79b9_7f4a_7c15)
                .rotate_left(29)
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    #[test]
    fn equal_and_empty_triangles_are_left_out() {
        let positions = vec![
            Vec3::ZERO,
            Vec3::X,
            Vec3::Y,
            vec3(-0.0, 0.0, -0.0),
            vec3(2.0, 0.0, 0.0),
            vec3(0.5, 0.0, 0.0),
        ];
        let mesh = Mesh {
            positions,
            triangles: vec![
                [0, 1, 2],
                [1, 0, 2],
                [0, 1, 4],
                [2, 3, 1],
                [0, 0, 0],
                [0, 4, 2],
                [0, 5, 2],
            ],
            ..Mesh::default()
        };
        let corners: Vec<_> = mesh
            .triangles
            .iter()
            .map(|t| t.map(|i| mesh.positions[i as usize]))
            .collect();
        let distinct = distinct(&mesh, &corners);
        assert_eq!(distinct.ids, [0, 5, 6]);
        assert_eq!((distinct.degenerate, distinct.duplicates), (2, 2));
    }
}
