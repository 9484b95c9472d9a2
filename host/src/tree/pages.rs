//! Large arrays that begin as zeros.

use bytemuck::Zeroable;

/// So many zeros. The system is asked for huge pages, which it is much quicker to hand out: a build touches all of its
/// arrays for the first time, each part in the thread that fills it.
pub fn zeroed<T: Zeroable>(length: usize) -> Vec<T> {
    let mut all = bytemuck::zeroed_vec(length);
    in_huge_pages(&mut all);
    all
}

#[cfg(target_os = "linux")]
fn in_huge_pages<T>(all: &mut [T]) {
    use rustix::mm::{Advice, madvise};
    const PAGE: usize = 1 << 21;
    let bytes = all.as_mut_ptr_range();
    let first = (bytes.start as usize).next_multiple_of(PAGE);
    let end = bytes.end as usize / PAGE * PAGE;
    if first < end {
        // SAFETY: The pages lie within the array, and which pages they are in changes nothing of it. Refused, they are
        // small.
        let _ = unsafe { madvise(first as *mut core::ffi::c_void, end - first, Advice::LinuxHugepage) };
    }
}

#[cfg(not(target_os = "linux"))]
fn in_huge_pages<T>(_: &mut [T]) {}
