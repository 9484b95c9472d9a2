//! Whitted's ray tree against what optics says: every effect has an oracle of its own, and no picture takes part that
//! was rendered before.

#![cfg(test)]

mod absorption;
mod furnace;
mod layers;
mod mirror;
mod refraction;
mod slab;
