//! A ray against the nodes, eight boxes at a time.

use crate::octants::{NODE_VECTORS, toward};
use crate::ray::PreparedRay;
use crate::slabs::Slabs;
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

/// The nodes as a ray sees them.
pub(super) struct Nodes<'a> {
    nodes: &'a [UVec4],
    t_min: __m256,
    /// Of the direction, and minus the origin times it (see [`Slabs`]); the last lanes are zero.
    reciprocal: __m128,
    offset: __m128,
    octant: u32,
    /// Row of [`TOWARD`].
    toward: &'static [u8; 256],
    /// Bytes before the nearer and the farther faces of an axis.
    near: [usize; 3],
    far: [usize; 3],
}

/// What a ray meets of a node.
pub(super) struct Met {
    /// Where it enters the children's boxes.
    pub enters: __m256,
    /// Leaves that it meets, by slot.
    pub leaves: u32,
    /// Inner children that it meets, bit `slot XOR octant`; from bit 8 the slots with inner nodes.
    pub group: u32,
    /// Index of the first inner child.
    pub base: u32,
    /// Slot of the first triangle.
    pub first: u32,
}

impl<'a> Nodes<'a> {
    /// # Safety
    /// The processor has AVX2, here and below.
    #[inline(always)]
    pub unsafe fn new(nodes: &'a [UVec4], ray: &PreparedRay) -> Self {
        let slabs = Slabs::new(ray);
        let (reciprocal, offset) = (slabs.reciprocal, slabs.offset);
        let near = [0, 1, 2].map(|axis| 32 + 16 * axis + 8 * (slabs.octant as usize >> axis & 1));
        // SAFETY: the caller's.
        unsafe {
            Nodes {
                nodes,
                t_min: _mm256_set1_ps(ray.t_min),
                reciprocal: _mm_setr_ps(reciprocal.x, reciprocal.y, reciprocal.z, 0.0),
                offset: _mm_setr_ps(offset.x, offset.y, offset.z, 0.0),
                octant: slabs.octant,
                toward: &TOWARD[slabs.octant as usize & 7],
                near,
                far: near.map(|at| at ^ 8),
            }
        }
    }

    /// First byte of a node.
    #[inline(always)]
    fn at(&self, node: u32) -> *const u8 {
        self.nodes.as_ptr().wrapping_add((node * NODE_VECTORS) as usize).cast()
    }

    /// The lanes of [`super::super::boxes::met`], operation by operation the same.
    ///
    /// # Safety
    /// There is such a node.
    #[inline(always)]
    pub unsafe fn meet(&self, node: u32, limit: f32) -> Met {
        let node = self.at(node);
        // SAFETY: nodes are 80 bytes, of which all that is read here lies in the first 80 and can be read from anywhere.
        unsafe {
            let words = node.cast::<u32>();
            let frame = words.add(3).read();
            let exponents = _mm_cvtepu8_epi32(_mm_cvtsi32_si128(frame as i32));
            let step = _mm_mul_ps(_mm_castsi128_ps(_mm_slli_epi32::<23>(exponents)), self.reciprocal);
            let start = _mm_add_ps(_mm_mul_ps(_mm_loadu_ps(words.cast()), self.reciprocal), self.offset);
            let lane = |lanes, axis| _mm256_permutevar8x32_ps(_mm256_castps128_ps256(lanes), _mm256_set1_epi32(axis));
            let steps = [lane(step, 0), lane(step, 1), lane(step, 2)];
            let starts = [lane(start, 0), lane(start, 1), lane(start, 2)];
            let crossed = |at: usize, axis: usize| {
                let faces = _mm256_cvtepu8_epi32(_mm_loadl_epi64(node.add(at).cast()));
                _mm256_add_ps(_mm256_mul_ps(_mm256_cvtepi32_ps(faces), steps[axis]), starts[axis])
            };
            // These prefer the second operand where numbers are equal or cannot be ordered, as `greater` and `lesser` do.
            let enters = _mm256_max_ps(
                _mm256_max_ps(crossed(self.near[0], 0), crossed(self.near[1], 1)),
                _mm256_max_ps(crossed(self.near[2], 2), self.t_min),
            );
            let exits = _mm256_min_ps(
                _mm256_min_ps(crossed(self.far[0], 0), crossed(self.far[1], 1)),
                _mm256_min_ps(crossed(self.far[2], 2), _mm256_set1_ps(limit)),
            );
            let hits = _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(enters, exits)) as u32;
            let inner = frame >> 24;
            Met {
                enters,
                leaves: hits & !inner,
                group: self.toward(hits & inner) | inner << 8,
                base: words.add(4).read(),
                first: words.add(5).read(),
            }
        }
    }

    /// Bit for each triangle of these leaves of a node, by its place among the node's.
    ///
    /// # Safety
    /// There is such a node.
    #[inline(always)]
    pub unsafe fn triangles(&self, node: u32, leaves: u32) -> u32 {
        // SAFETY: as above.
        unsafe {
            let bytes = _mm256_cvtepu8_epi32(_mm_loadl_epi64(self.at(node).add(24).cast()));
            let one = _mm256_set1_epi32(1);
            let counted = _mm256_sub_epi32(_mm256_sllv_epi32(one, _mm256_srli_epi32::<5>(bytes)), one);
            let placed = _mm256_sllv_epi32(counted, _mm256_and_si256(bytes, _mm256_set1_epi32(31)));
            let bits = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
            let is_met = _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32(leaves as i32), bits), bits);
            let eight = _mm256_and_si256(placed, is_met);
            let four = _mm_or_si128(_mm256_castsi256_si128(eight), _mm256_extracti128_si256::<1>(eight));
            let two = _mm_or_si128(four, _mm_shuffle_epi32::<0b01_00_11_10>(four));
            let all = _mm_or_si128(two, _mm_shuffle_epi32::<0b10_11_00_01>(two));
            _mm_cvtsi128_si32(all) as u32
        }
    }

    /// The group bits that remain of a level whose boxes are entered at `enters`: children not beyond `limit`, and all slots
    /// with inner nodes.
    ///
    /// # Safety
    /// See [`Nodes::new`].
    #[inline(always)]
    pub unsafe fn before(&self, enters: __m256, limit: f32) -> u32 {
        // SAFETY: the caller's.
        let slots = unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(enters, _mm256_set1_ps(limit))) };
        self.toward(slots as u32) | !0xff
    }

    /// Place of a group's front child among the inner ones.
    #[inline(always)]
    pub fn place(&self, group: u32) -> u32 {
        let slot = (group.trailing_zeros() ^ self.octant) & 7;
        ((group >> 8) & ((1 << slot) - 1)).count_ones()
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

    #[inline(always)]
    fn toward(&self, slots: u32) -> u32 {
        u32::from(self.toward[slots as usize & 0xff])
    }
}
