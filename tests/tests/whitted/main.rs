//! Whitted's ray tree against what optics says: every effect has an oracle of its own, and no picture takes part that
//! was rendered before.

#![cfg(test)]

mod absorption;
mod culling;
mod depth;
mod falloff;
mod furnace;
mod layers;
mod lights;
mod mirror;
mod normals;
mod origins;
mod random;
mod refraction;
mod shadows;
mod slab;
mod stereo;
mod water;
