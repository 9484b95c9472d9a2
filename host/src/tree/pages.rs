//! Large arrays that begin as zeros.

use bytemuck::Pod;
use memmap2::MmapMut;
use std::fmt;
use std::ops::{Deref, DerefMut};

/// A large array. The system is asked for huge pages, which it is much quicker to hand out: a build touches all of its
/// arrays for the first time.
pub struct Pages<T> {
    memory: Memory<T>,
    length: usize,
}

enum Memory<T> {
    Map(MmapMut),
    /// Where the system maps nothing.
    Vec(Vec<T>),
}

impl<T: Pod> Pages<T> {
    /// So many zeros.
    pub fn zeroed(length: usize) -> Self {
        let memory = MmapMut::map_anon((length * size_of::<T>()).max(1)).map_or_else(
            |_| Memory::Vec(bytemuck::zeroed_vec(length)),
            |map| {
                #[cfg(target_os = "linux")]
                // Refused, the pages are small.
                let _ = map.advise(memmap2::Advice::HugePage);
                Memory::Map(map)
            },
        );
        Pages { memory, length }
    }

    /// Leaves out all from `length` on.
    pub fn truncate(&mut self, length: usize) {
        self.length = self.length.min(length);
    }
}

impl<T: Pod> Deref for Pages<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        match &self.memory {
            Memory::Map(map) => bytemuck::cast_slice(&map[..self.length * size_of::<T>()]),
            Memory::Vec(all) => &all[..self.length],
        }
    }
}

impl<T: Pod> DerefMut for Pages<T> {
    fn deref_mut(&mut self) -> &mut [T] {
        match &mut self.memory {
            Memory::Map(map) => bytemuck::cast_slice_mut(&mut map[..self.length * size_of::<T>()]),
            Memory::Vec(all) => &mut all[..self.length],
        }
    }
}

impl<T: Pod + fmt::Debug> fmt::Debug for Pages<T> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_list().entries(self.iter()).finish()
    }
}
