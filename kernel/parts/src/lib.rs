//! Entry points of oktant's GPU kernel that cast rays with other parts than the default ones.
//!
//! A module of its own: whoever traces with the default parts does not wait for it. Its descriptor sets are those of
//! `kernel`; memory of the workgroup is used by `brute` alone.
#![cfg_attr(target_arch = "spirv", no_std)]
#![expect(
    clippy::too_many_arguments,
    reason = "each buffer and each built-in of an entry point is an argument of its own"
)]

oktant_shared::offered_parts!(oktant_shared::cast_others);
