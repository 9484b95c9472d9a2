//! What is to be rendered, apart from the scene.

use crate::camera::Camera;
use crate::octree::Root;
use bytemuck::{Pod, Zeroable};
use glam::Vec3;

/// Bit of [`Frame::features`]: interpolate the vertex normals.
pub const SMOOTH_NORMALS: u32 = 1;
/// Bit of [`Frame::features`]: take the base colour from the vertices.
pub const VERTEX_COLORS: u32 = 2;

/// One pass over a picture: the uniform buffer of the kernel.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Frame {
    /// Where the picture is taken from.
    pub camera: Camera,
    /// The octree's cube.
    pub root: Root,
    /// Colour of rays that leave the scene, linear RGB.
    pub background: Vec3,
    /// Samples along each side of a pixel: 1, 2 or 4 for 1, 4 or 16 samples.
    pub samples_per_side: u32,
    /// Place of the point light, scene units.
    pub light: Vec3,
    /// First sample of this pass, counted row by row in the pixel.
    pub first_sample: u32,
    /// Colour of the light, linear RGB; it does not fall off with the distance.
    pub light_color: Vec3,
    /// Samples in this pass.
    pub sample_count: u32,
    /// Colour of the surface where the mesh has none, linear RGB, 0 to 1.
    pub base_color: Vec3,
    /// [`SMOOTH_NORMALS`], [`VERTEX_COLORS`].
    pub features: u32,
    /// Part of the base colour that is seen without any light, 0 to 1.
    pub ambient: f32,
    /// Part of the base colour that reflects the light evenly, 0 to 1.
    pub diffuse: f32,
    /// Strength of the highlight, 0 to 1, in the colour of the light.
    pub specular: f32,
    /// Exponent of the highlight, 1 (wide) and up.
    pub exponent: f32,
}

const _: () = assert!(size_of::<Frame>() == 176);
