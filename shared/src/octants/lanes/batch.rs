//! Triangles that are tested together.

use core::arch::x86_64::*;
use core::hint::select_unpredictable;

/// Up to four triangles of a node's leaves, that there are.
pub(super) struct Batch {
    /// Their slots; beyond `count` that of the first.
    pub slots: [u32; 4],
    /// How many they are, 1 to 4.
    pub count: u32,
}

impl Batch {
    /// Takes triangles of a node out of the bits of those that remain, of which there must be one.
    #[inline(always)]
    pub fn next(triangles: &mut u32, first: u32) -> Self {
        let nearest = first + triangles.trailing_zeros();
        let mut batch = Batch {
            slots: [nearest; 4],
            count: triangles.count_ones().min(4),
        };
        *triangles &= *triangles - 1;
        for slot in &mut batch.slots[1..] {
            *slot = select_unpredictable(*triangles == 0, nearest, first.wrapping_add(triangles.trailing_zeros()));
            *triangles &= triangles.wrapping_sub(1);
        }
        batch
    }

    /// Bit for each triangle whose `t` is between two limits.
    #[inline(always)]
    pub fn within(&self, t: &[f32; 4], t_min: f32, limit: f32) -> u32 {
        // SAFETY: SSE is always there, and the array has four elements.
        let lanes = unsafe {
            let t = _mm_loadu_ps(t.as_ptr());
            let within = _mm_and_ps(_mm_cmpge_ps(t, _mm_set1_ps(t_min)), _mm_cmple_ps(t, _mm_set1_ps(limit)));
            _mm_movemask_ps(within) as u32
        };
        lanes & ((1 << self.count) - 1)
    }
}
