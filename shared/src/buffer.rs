//! Reading the flat arrays.

/// The element at `index`.
///
/// Natively an index out of range panics, as usual. On the GPU there is no check: the host's `validate()` has made sure
/// that every index in the arrays is in range, and the check costs a tenth of the frame.
#[inline]
pub fn load<T: Copy>(elements: &[T], index: u32) -> T {
    #[cfg(target_arch = "spirv")]
    {
        use spirv_std::arch::IndexUnchecked;
        // SAFETY: the host uploads arrays only after it has validated every index in them.
        unsafe { *elements.index_unchecked(index as usize) }
    }
    #[cfg(not(target_arch = "spirv"))]
    {
        elements[index as usize]
    }
}
