//! Triangles that need no reference of their own.

use crate::mesh::Mesh;
use glam::Vec3;
use rayon::prelude::*;
use std::sync::atomic::AtomicU64;
use std::sync::atomic::Ordering::Relaxed;

/// The triangles that can be hit, ascending, and how many cannot.
pub(crate) struct Distinct {
    /// Ids of the triangles that have an area and do not lie exactly on one with a lower id.
    pub ids: Vec<u32>,
    /// Triangles without area.
    pub degenerate: u32,
    /// Triangles with the same three corners, in any order, as one with a lower id.
    pub duplicates: u32,
}

/// Where among some ids those of triangles are that lie exactly on one with a lower id.
pub(crate) fn duplicates(mesh: &Mesh, ids: &[u32]) -> Vec<u32> {
    // The same in whatever order the corners come.
    let hash = |id: u32| {
        let [a, b, c] = mesh.triangles[id as usize].map(|index| hash(&mesh.positions[index as usize]));
        a.wrapping_add(b).wrapping_add(c).wrapping_mul(0x9e37_79b1)
    };
    let hashes: Vec<u32> = ids.par_iter().with_min_len(BLOCK).map(|id| hash(*id)).collect();
    // Few triangles share their bit with another one; only those are looked at closely.
    let seen = Marks::new(ids.len());
    let shared: Vec<u32> = hashes
        .par_iter()
        .with_min_len(BLOCK)
        .copied()
        .filter(|hash| seen.mark(*hash))
        .collect();
    let suspect = Marks::new(shared.len());
    for hash in shared {
        suspect.mark(hash);
    }
    let mut suspects: Vec<(u32, u32)> = hashes
        .par_iter()
        .enumerate()
        .with_min_len(BLOCK)
        .filter(|(_, hash)| suspect.is_marked(**hash))
        .map(|(slot, hash)| (*hash, slot as u32))
        .collect();
    suspects.par_sort_unstable_by_key(|(hash, slot)| (*hash, ids[*slot as usize]));
    let mut duplicates = Vec::new();
    for group in suspects.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1) {
        let mut known: Vec<[[u32; 3]; 3]> = Vec::new();
        for (_, slot) in group {
            let corners = mesh.triangles[ids[*slot as usize] as usize].map(|index| mesh.positions[index as usize]);
            let key = sorted(&corners);
            if known.contains(&key) {
                duplicates.push(*slot);
            } else {
                known.push(key);
            }
        }
    }
    duplicates
}

/// Sorts out what no ray can hit, or not first: of coincident triangles the lowest id wins anyway.
pub(crate) fn distinct(mesh: &Mesh, corners: &[[Vec3; 3]]) -> Distinct {
    let mut ids: Vec<u32> = (0..corners.len() as u32)
        .into_par_iter()
        .filter(|id| has_area(&corners[*id as usize]))
        .collect();
    let degenerate = (corners.len() - ids.len()) as u32;
    let mut duplicates = duplicates(mesh, &ids);
    duplicates.sort_unstable();
    let mut slot = 0;
    let mut others = duplicates.iter().peekable();
    ids.retain(|_| {
        let is_other = others.next_if_eq(&&slot).is_some();
        slot += 1;
        !is_other
    });
    Distinct {
        ids,
        degenerate,
        duplicates: duplicates.len() as u32,
    }
}

/// A product of edges, in parts of their sizes, that no rounding in single precision can make of zero.
const SURE: f32 = 1e-4;

/// Whether a ray can hit the triangle at all: edges that f32 holds have an exact enough product in f64.
#[inline]
pub(crate) fn has_area(corners: &[Vec3; 3]) -> bool {
    // Plain where single precision is sure: its edges are right to the last bit, their product to a few.
    let (ab, ac) = (corners[1] - corners[0], corners[2] - corners[0]);
    let size = ab.abs().max_element() * ac.abs().max_element();
    if ab.cross(ac).abs().max_element() > SURE * size && size > f32::MIN_POSITIVE / SURE {
        return true;
    }
    let [a, b, c] = corners.map(|corner| corner.as_dvec3());
    (b - a).cross(c - a).length_squared() > 0.0
}

/// The corners in an order of their own, as bits; adding zero makes the two zeros one.
fn sorted(corners: &[Vec3; 3]) -> [[u32; 3]; 3] {
    let mut bits = corners.map(|corner| corner.to_array().map(|x| (x + 0.0).to_bits()));
    bits.sort_unstable();
    bits
}

/// Of a corner; the two zeros are one. Any even spread will do: triangles of equal hashes are compared in full.
fn hash(corner: &Vec3) -> u32 {
    let hash = corner.to_array().iter().fold(0xcbf2_9ce4_8422_2325_u64, |hash, x| {
        (hash ^ u64::from((x + 0.0).to_bits()))
            .wrapping_mul(0x9e37_79b9_7f4a_7c15)
            .rotate_left(29)
    });
    (hash ^ hash >> 32) as u32
}

/// Triangles that are worth a thread.
const BLOCK: usize = 1 << 13;

/// Bits for the hashes of so many triangles, several for each.
struct Marks {
    words: Vec<AtomicU64>,
    /// Bits of a hash that do not count.
    shift: u32,
}

impl Marks {
    fn new(triangles: usize) -> Self {
        let bits = (32 * triangles).next_power_of_two().clamp(64, 1 << 32);
        let mut words = Vec::new();
        words.resize_with(bits / 64, AtomicU64::default);
        Marks {
            words,
            shift: 32 - bits.ilog2(),
        }
    }

    fn place(&self, hash: u32) -> (&AtomicU64, u64) {
        let place = u64::from(hash) >> self.shift;
        (&self.words[place as usize / 64], 1 << (place % 64))
    }

    /// Marks a hash; whether it or one like it was marked before.
    fn mark(&self, hash: u32) -> bool {
        let (word, bit) = self.place(hash);
        word.fetch_or(bit, Relaxed) & bit != 0
    }

    fn is_marked(&self, hash: u32) -> bool {
        let (word, bit) = self.place(hash);
        word.load(Relaxed) & bit != 0
    }
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
