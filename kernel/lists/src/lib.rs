//! Entry points of oktant's GPU kernel that render the pixels of a list, each with as many samples as it is to have.
//!
//! A module of its own: most pictures have no list, and whoever renders all pixels does not wait for it. Its descriptor sets are
//! those of `kernel`. A workgroup takes a stretch of the list, and its invocations the samples of those pixels as they come, so
//! that none waits for one that has more. What they found meets in the workgroup's memory, from where it is added pixel by pixel in
//! the order of the samples: the same sums as those of a pixel on its own.
#![cfg_attr(target_arch = "spirv", no_std)]
#![expect(
    clippy::too_many_arguments,
    reason = "each buffer and each built-in of an entry point is an argument of its own"
)]

pub mod group;
pub mod render;
