//! Entry points of oktant's GPU kernel, compiled to SPIR-V by rust-gpu.
//!
//! An entry point guards against invocations beyond the end of its buffers, calls a function of `oktant-shared` and
//! stores the result. Descriptor set 0 holds what rays meet, set 1 the frame, set 2 what is read and
//! written per invocation, set 3 what surfaces look like. Where triangles are indexed, the references are the corners of
//! triangles, and the triangles rows of vertices. What renders the pixels of a list is in the module
//! of `kernel/lists`, what casts rays with other parts than the default ones in that of `kernel/parts`.
#![cfg_attr(target_arch = "spirv", no_std)]
#![expect(
    clippy::too_many_arguments,
    reason = "each buffer and each built-in of an entry point is an argument of its own"
)]

pub mod choose;
pub mod present;
pub mod probe;
pub mod render;

oktant_shared::offered_parts!(oktant_shared::cast_standard);
