//! The agreement between kernel and host: which buffers an entry point sees, and what lies in them.

/// Number of the agreement. It rises with every change of what is bound where, of what a structure or an array in a buffer
/// looks like, and of how the host launches an entry point; the host runs only kernels that were compiled with its own.
pub const BINDINGS: u32 = 6;
