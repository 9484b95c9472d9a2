//! Reading and writing arrays without the checks that cost a GPU a tenth of its time.
//!
//! A check that fails ends the invocation, which rust-gpu can do only by leaving every loop and branch about it in turn.

/// The element at `index`.
///
/// Natively an index out of range panics, as usual. On the GPU there is no check: the host's `validate()` has made sure
/// that every index in the arrays is in range.
#[inline(always)]
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

/// The place of the element at `index`, as unchecked as for [`load`].
#[inline(always)]
pub fn place<T>(elements: &mut [T], index: u32) -> &mut T {
    #[cfg(target_arch = "spirv")]
    {
        use spirv_std::arch::IndexUnchecked;
        // SAFETY: the host binds a buffer that has it.
        unsafe { elements.index_unchecked_mut(index as usize) }
    }
    #[cfg(not(target_arch = "spirv"))]
    {
        &mut elements[index as usize]
    }
}

/// Writes the element at `index`, which the caller has compared with the length.
#[inline(always)]
pub fn store<T: Copy>(elements: &mut [T], index: u32, value: T) {
    #[cfg(target_arch = "spirv")]
    {
        use spirv_std::arch::IndexUnchecked;
        // SAFETY: the entry points ask before whether the index is in range.
        unsafe { *elements.index_unchecked_mut(index as usize) = value };
    }
    #[cfg(not(target_arch = "spirv"))]
    {
        elements[index as usize] = value;
    }
}

/// The entry at `index` of an array of the invocation's own or of its workgroup's, which the caller knows to be in range.
#[inline(always)]
pub fn get<T: Copy, const N: usize>(entries: &[T; N], index: u32) -> T {
    #[cfg(target_arch = "spirv")]
    {
        use spirv_std::arch::IndexUnchecked;
        // SAFETY: the host lets no structure pass that is deeper than the arrays of its traversal; a workgroup's have an entry
        // for each invocation.
        unsafe { *entries.index_unchecked(index as usize) }
    }
    #[cfg(not(target_arch = "spirv"))]
    {
        entries[index as usize]
    }
}

/// Writes such an entry.
#[inline(always)]
pub fn put<T: Copy, const N: usize>(entries: &mut [T; N], index: u32, entry: T) {
    #[cfg(target_arch = "spirv")]
    {
        use spirv_std::arch::IndexUnchecked;
        // SAFETY: as for `get`.
        unsafe { *entries.index_unchecked_mut(index as usize) = entry };
    }
    #[cfg(not(target_arch = "spirv"))]
    {
        entries[index as usize] = entry;
    }
}

/// A stack of so many entries; that it is deep enough is the caller's business, natively it panics where it is not.
#[derive(Clone, Copy)]
pub struct Stack<T, const N: usize> {
    entries: [T; N],
    /// How many there are.
    pub waiting: u32,
}

impl<T: Copy, const N: usize> Stack<T, N> {
    /// Without entries; `filler` is any value.
    #[inline(always)]
    pub fn new(filler: T) -> Self {
        Stack {
            entries: blank(filler),
            waiting: 0,
        }
    }

    /// Puts an entry on top.
    #[inline(always)]
    pub fn push(&mut self, entry: T) {
        put(&mut self.entries, self.waiting, entry);
        self.waiting += 1;
    }

    /// Takes the entry on top, of which there must be one.
    #[inline(always)]
    pub fn pop(&mut self) -> T {
        self.waiting -= 1;
        get(&self.entries, self.waiting)
    }
}

/// Entries that must be written before they are read; `filler` is any value. A GPU would write the fillers to memory, for every ray.
#[inline(always)]
pub fn blank<T: Copy, const N: usize>(filler: T) -> [T; N] {
    #[cfg(target_arch = "spirv")]
    {
        let _ = filler;
        // SAFETY: numbers without a value, which nobody reads.
        unsafe { core::mem::MaybeUninit::uninit().assume_init() }
    }
    #[cfg(not(target_arch = "spirv"))]
    {
        [filler; N]
    }
}
