//! What surfaces are made of.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

/// Bit of [`Material::flags`]: the base colour is multiplied with the colours of the vertices.
pub const VERTEX_COLORS: u32 = 1;
/// Bit of [`Material::flags`]: normals are interpolated between the vertices.
pub const SMOOTH_NORMALS: u32 = 2;
/// Bit of [`Material::flags`]: highlights are Phong's, about the reflected direction, instead of Blinn's.
pub const PHONG_HIGHLIGHTS: u32 = 4;
/// Bit of [`Material::flags`]: the angle decides how much is reflected (see [`crate::whitted`]).
pub const FRESNEL: u32 = 8;

/// A material. All colours are linear RGB, 0 to 1 unless said otherwise.
///
/// What a surface sends to the eye is `ambient + diffuse + specular + mirror + transmission`; whoever makes a material
/// sees to it that `diffuse * base + mirror + transmission` does not exceed 1. Highlights stand for the image of a light
/// that is too small to be met by rays, and come on top.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Material {
    /// Colour of the surface under white light.
    pub base: Vec3,
    /// Part of the base colour that answers the scene's ambient light, 0 to 1.
    pub ambient: f32,
    /// Colour of the highlight.
    pub specular: Vec3,
    /// Exponent of the highlight, 0 (none) or 1 (wide) and up.
    pub exponent: f32,
    /// Weight of the reflected ray.
    pub mirror: Vec3,
    /// Part of the base colour that reflects light evenly, 0 to 1.
    pub diffuse: f32,
    /// Weight of the transmitted ray; zero for an opaque surface.
    pub transmission: Vec3,
    /// Index of refraction of what the surface encloses; 1 in the air.
    pub ior: f32,
    /// What the enclosed medium absorbs, per scene unit: after a way `s` a part `exp(-absorption * s)` is left.
    pub absorption: Vec3,
    /// Where media overlap, the one with the highest priority is what is there.
    pub priority: u32,
    /// Index of the texture that the base colour is multiplied with, or [`crate::texture::NO_TEXTURE`].
    pub texture: u32,
    /// Index of the texture whose brightness is the height of the surface, or [`crate::texture::NO_TEXTURE`].
    pub bump: u32,
    /// Height that white stands for in the bump texture, scene units; negative turns bumps into dents.
    pub bump_height: f32,
    /// [`VERTEX_COLORS`], [`SMOOTH_NORMALS`], [`PHONG_HIGHLIGHTS`], [`FRESNEL`].
    pub flags: u32,
}

const _: () = assert!(size_of::<Material>() == 96);

impl Material {
    /// Whether light goes through.
    #[inline]
    pub fn is_transmissive(&self) -> bool {
        self.transmission != Vec3::ZERO
    }
}
