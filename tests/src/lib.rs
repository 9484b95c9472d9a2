//! Tests of oktant across its crates.
