//! A ray against the nodes, eight boxes at a time.

use super::start::Start;
use crate::octants::{NODE_VECTORS, toward};
use core::arch::x86_64::*;
use glam::UVec4;

/// [`toward`] for every octant and every set of slots.
static TOWARD: [[u8; 256]; 8] = {
    let mut all = [[0; 256]; 8];
    let mut octant = 0;
    while octant < 8 {
        let mut slots = 0;
        while slots < 256 {
            all[octant][slots] = toward(slots as u32, octant as u32) as u8;
            slots += 1;
        }
        octant += 1;
    }
    all
};

/// For every octant where the words of eight lanes come from, lane `slot XOR octant`: the two numbers of a word as
/// [`crate::arithmetic::halves`] makes them.
static HALVES: [[u8; 32]; 8] = {
    let mut all = [[ZERO; 32]; 8];
    let mut place = 0;
    while place < 8 * 8 * 4 {
        let (octant, slot, byte) = (place / 32, place / 4 % 8, place % 4);
        let first = if slot % 2 == 0 { 2 } else { 0 };
        if byte >= first {
            all[octant][4 * (slot ^ octant) + byte] = (4 * (slot / 2) + byte - first) as u8;
        }
        place += 1;
    }
    all
};

/// The same of a byte of each slot.
static BYTES: [[u8; 32]; 8] = {
    let mut all = [[ZERO; 32]; 8];
    let mut place = 0;
    while place < 8 * 8 {
        let (octant, slot) = (place / 8, place % 8);
        all[octant][4 * (slot ^ octant)] = slot as u8;
        place += 1;
    }
    all
};

/// Makes a byte zero.
const ZERO: u8 = 0x80;

/// The nodes as a ray sees them. Lanes are children, lane `slot XOR octant`.
pub(super) struct Nodes<'a> {
    nodes: &'a [UVec4],
    /// How many there are.
    count: u32,
    t_min: __m256,
    /// Of the direction, an axis a lane.
    reciprocal: __m128,
    /// The same; the bits of a power of two are to be added.
    unscaled: __m128i,
    offset: __m128,
    octant: u32,
    /// Row of [`TOWARD`].
    toward: &'static [u8; 256],
    /// Bytes before the nearer and the farther faces of an axis.
    near: [usize; 3],
    far: [usize; 3],
    /// Row of [`HALVES`].
    halves: __m256i,
    /// Row of [`BYTES`].
    bytes: &'static [u8; 32],
}

/// What a ray meets of a node.
pub(super) struct Met {
    /// Where it enters the children's boxes.
    pub enters: __m256,
    /// Leaves that it meets.
    pub leaves: u32,
    /// What it meets of the others.
    pub group: Group,
    /// First byte of the node.
    at: *const u8,
}

/// Children of a node that are nodes.
#[derive(Clone, Copy)]
pub(super) struct Group(u64);

impl Group {
    /// Of no node.
    pub const EMPTY: Group = Group(0);

    /// Those that remain from bit 0, bit `slot XOR octant`; from bit 8 all slots with inner nodes.
    #[inline(always)]
    fn new(remain: u32, inner: u32, first: u32) -> Self {
        Group(u64::from(remain | inner << 8) | u64::from(first) << 32)
    }

    /// Whether none remains.
    #[inline(always)]
    pub fn is_empty(self) -> bool {
        self.0 & 0xff == 0
    }

    /// Without the front one, of which there must be one.
    #[inline(always)]
    pub fn rest(self) -> Self {
        Group(self.0 & self.0.wrapping_sub(1))
    }

    /// Of those that remain the ones that are in a set.
    #[inline(always)]
    pub fn within(self, set: u32) -> Self {
        Group(self.0 & (u64::from(set) | !0xff))
    }

    /// This one, or another where it is empty: a choice that no processor foresees.
    #[inline(always)]
    pub fn or(self, other: Group) -> Self {
        Group(core::hint::select_unpredictable(self.is_empty(), other.0, self.0))
    }
}

impl<'a> Nodes<'a> {
    /// For a ray.
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    #[inline]
    pub fn new(nodes: &'a [UVec4], start: &Start) -> Self {
        let octant = _mm_movemask_ps(start.reciprocal) as usize & 7;
        let near = [0, 1, 2].map(|axis| 32 + 32 * axis + 16 * (octant >> axis & 1));
        let one = _mm_set1_epi32(127 << 23);
        Nodes {
            nodes,
            count: nodes.len() as u32 / NODE_VECTORS,
            t_min: _mm256_set1_ps(start.ray.t_min),
            reciprocal: start.reciprocal,
            unscaled: _mm_sub_epi32(_mm_castps_si128(start.reciprocal), one),
            offset: start.offset,
            octant: octant as u32,
            toward: &TOWARD[octant],
            near,
            far: near.map(|at| at ^ 16),
            halves: in_lanes(&HALVES[octant]),
            bytes: &BYTES[octant],
        }
    }

    /// First byte of a node.
    #[inline(always)]
    fn at(&self, node: u32) -> *const u8 {
        self.nodes
            .as_ptr()
            .wrapping_add(node.wrapping_mul(NODE_VECTORS) as usize)
            .cast()
    }

    /// What is met of a node between `t_min` and `limit`: as [`super::super::boxes::met`] finds, but that products and sums
    /// are rounded once. Boxes are wide enough for either.
    ///
    /// # Panics
    /// If there is no such node.
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    #[inline]
    pub fn meet(&self, node: u32, limit: __m256) -> Met {
        assert!(node < self.count, "there is no such node");
        let at = self.at(node);
        // SAFETY: nodes are 128 bytes, of which all that is read here is some and can be read from anywhere.
        unsafe {
            let words = at.cast::<f32>();
            let (corner, exponents) = raster(_mm_loadu_ps(words));
            let starts = _mm_fmadd_ps(corner, self.reciprocal, self.offset);
            let steps = _mm_castsi128_ps(_mm_add_epi32(exponents, self.unscaled));
            let lanes = |v: __m128, axis: usize| match axis {
                0 => _mm256_broadcastss_ps(v),
                1 => _mm256_broadcastss_ps(_mm_movehdup_ps(v)),
                _ => _mm256_broadcastss_ps(_mm_movehl_ps(v, v)),
            };
            let crossed = |axis: usize| {
                let (start, step) = (lanes(starts, axis), lanes(steps, axis));
                let crossed = |faces: usize| {
                    let faces = _mm256_broadcastsi128_si256(_mm_loadu_si128(at.add(faces).cast()));
                    let faces = _mm256_castsi256_ps(_mm256_shuffle_epi8(faces, self.halves));
                    _mm256_fmadd_ps(faces, step, start)
                };
                (crossed(self.near[axis]), crossed(self.far[axis]))
            };
            let (x, y, z) = (crossed(0), crossed(1), crossed(2));
            let enters = _mm256_max_ps(_mm256_max_ps(x.0, y.0), _mm256_max_ps(z.0, self.t_min));
            let exits = _mm256_min_ps(_mm256_min_ps(x.1, y.1), _mm256_min_ps(z.1, limit));
            let hits = _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(enters, exits)) as u32;
            let inner = at.add(15).read();
            let turned = u32::from(self.toward[usize::from(inner)]);
            Met {
                enters,
                leaves: hits & !turned,
                group: Group::new(hits & turned, u32::from(inner), words.add(4).cast::<u32>().read()),
                at,
            }
        }
    }

    /// The triangles of the leaves that are met of a node: the slot of the first of the node's, and a bit for each, by its
    /// place among the node's.
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    #[inline]
    pub fn triangles(&self, met: &Met) -> (u32, u32) {
        // SAFETY: it is a node that was met.
        unsafe {
            let bytes = _mm_loadl_epi64(met.at.add(24).cast());
            let bytes = _mm256_shuffle_epi8(_mm256_broadcastsi128_si256(bytes), in_lanes(self.bytes));
            let one = _mm256_set1_epi32(1);
            let counted = _mm256_sub_epi32(_mm256_sllv_epi32(one, _mm256_srli_epi32::<5>(bytes)), one);
            let placed = _mm256_sllv_epi32(counted, _mm256_and_si256(bytes, _mm256_set1_epi32(31)));
            let bits = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
            let is_met = _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32(met.leaves as i32), bits), bits);
            let eight = _mm256_and_si256(placed, is_met);
            let four = _mm_or_si128(_mm256_castsi256_si128(eight), _mm256_extracti128_si256::<1>(eight));
            let two = _mm_or_si128(four, _mm_shuffle_epi32::<0b01_00_11_10>(four));
            let all = _mm_or_si128(two, _mm_shuffle_epi32::<0b10_11_00_01>(two));
            (
                met.at.add(20).cast::<u32>().read_unaligned(),
                _mm_cvtsi128_si32(all) as u32,
            )
        }
    }

    /// Children whose boxes, entered at `enters`, are not entered beyond `limit`.
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    #[inline]
    pub fn before(&self, enters: __m256, limit: __m256) -> u32 {
        _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(enters, limit)) as u32
    }

    /// A group's front child.
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    #[inline]
    pub fn front(&self, group: Group) -> u32 {
        let group = group.0;
        let slot = (group.trailing_zeros() ^ self.octant) & 7;
        let before = (group >> 8) as u32 & ((1 << slot) - 1);
        ((group >> 32) as u32).wrapping_add(before.count_ones())
    }

    /// Has a node brought from memory.
    #[inline(always)]
    pub fn prefetch(&self, node: u32) {
        let node = self.at(node);
        // SAFETY: this reads nothing.
        unsafe {
            _mm_prefetch::<_MM_HINT_T0>(node.cast());
            _mm_prefetch::<_MM_HINT_T0>(node.wrapping_add(64).cast());
        }
    }
}

/// The children of a node as a packet sees them, in the order in which its rays meet them: child `slot XOR octant`.
pub(super) struct Children {
    /// Of the node's raster, by axis.
    pub corner: [f32; 4],
    /// The axes' exponents; added to those of the reciprocals they make their products.
    pub exponents: [i32; 4],
    /// Nearer faces of the children, by axis.
    pub near: [[f32; 8]; 3],
    /// Farther faces of the children, by axis.
    pub far: [[f32; 8]; 3],
    /// Children that are leaves.
    pub leaves: u32,
    /// Children that are nodes.
    pub inner: u32,
    octant: usize,
    /// Slots with children that are nodes.
    inner_slots: u8,
    /// Index of the first of those.
    first_node: u32,
    /// First slot of the leaves' triangles.
    first_triangle: u32,
    /// Of each octant's leaf the count times 32 plus its first triangle's place among the node's.
    places: [u8; 8],
}

impl Children {
    /// Of a node, for rays of an octant, 0 to 7.
    ///
    /// # Safety
    /// There is such a node.
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    #[inline]
    pub unsafe fn new(nodes: &[UVec4], node: u32, octant: usize) -> Children {
        // SAFETY: a node is 128 bytes, which can be read from anywhere.
        let (at, frame, links) = unsafe {
            let at = nodes.as_ptr().add((node * NODE_VECTORS) as usize);
            (at.cast::<u8>(), _mm_loadu_ps(at.cast()), *at.add(1))
        };
        let (corner, exponents) = raster(frame);
        let places = [links.z, links.w];
        let none = _mm_cmpeq_epi8(
            _mm_set_epi64x(0, (u64::from(places[0]) | u64::from(places[1]) << 32) as i64),
            _mm_setzero_si128(),
        );
        let leaves = !_mm_movemask_epi8(none) as u8;
        let inner_slots = (_mm_extract_epi32::<3>(_mm_castps_si128(frame)) as u32 >> 24) as u8;
        let mut children = Children {
            corner: [0.0; 4],
            exponents: [0; 4],
            near: [[0.0; 8]; 3],
            far: [[0.0; 8]; 3],
            leaves: u32::from(TOWARD[octant][usize::from(leaves)]),
            inner: u32::from(TOWARD[octant][usize::from(inner_slots)]),
            octant,
            inner_slots,
            first_node: links.x,
            first_triangle: links.y,
            places: bytemuck::cast(places),
        };
        let halves = in_lanes(&HALVES[octant]);
        // SAFETY: there is room for as many words as are stored, and all that is read is the node's.
        unsafe {
            _mm_storeu_ps(children.corner.as_mut_ptr(), corner);
            _mm_storeu_si128(children.exponents.as_mut_ptr().cast(), exponents);
            for axis in 0..3 {
                let faces = |side: usize| {
                    let faces = _mm_loadu_si128(at.add(32 + 32 * axis + 16 * side).cast());
                    _mm256_castsi256_ps(_mm256_shuffle_epi8(_mm256_broadcastsi128_si256(faces), halves))
                };
                let is_against = octant >> axis & 1;
                _mm256_storeu_ps(children.near[axis].as_mut_ptr(), faces(is_against));
                _mm256_storeu_ps(children.far[axis].as_mut_ptr(), faces(1 - is_against));
            }
        }
        children
    }

    /// First slot and number of the triangles of a child that is a leaf.
    #[inline(always)]
    pub fn leaf(&self, child: usize) -> (u32, u32) {
        let place = u32::from(self.places[(child ^ self.octant) & 7]);
        (self.first_triangle.wrapping_add(place & 31), place >> 5)
    }

    /// A child that is a node.
    #[inline(always)]
    pub fn node(&self, child: usize) -> u32 {
        let before = u32::from(self.inner_slots) & ((1 << ((child ^ self.octant) & 7)) - 1);
        self.first_node.wrapping_add(before.count_ones())
    }
}

/// Corner of a node's raster, and the axes' exponents; added to those of the reciprocals they make their products.
#[target_feature(enable = "avx2")]
#[inline]
fn raster(frame: __m128) -> (__m128, __m128i) {
    // The last lane is no number and may look like one that takes long to compute with.
    let corner = _mm_blend_ps::<0b1000>(frame, _mm_setzero_ps());
    let highest = _mm_set_epi32(-1, 0x0e80_8080, 0x0d80_8080, 0x0c80_8080);
    let exponents = _mm_srli_epi32::<1>(_mm_shuffle_epi8(_mm_castps_si128(frame), highest));
    (corner, exponents)
}

/// Which bytes go where, in a register.
#[target_feature(enable = "avx2")]
#[inline]
fn in_lanes(bytes: &[u8; 32]) -> __m256i {
    // SAFETY: there are 32 bytes.
    unsafe { _mm256_loadu_si256(bytes.as_ptr().cast()) }
}
