//! What is to be rendered, apart from the scene.

use crate::camera::Camera;
use crate::environment::Environment;
use crate::light::Light;
use crate::octree::Root;
use crate::stereo::{SIDE_BY_SIDE, STACKED};
use bytemuck::{Pod, Zeroable};
use glam::{UVec2, UVec4, Vec3, uvec2};

/// Bit of [`Frame::features`]: all triangles are flat, whatever their materials say.
pub const FLAT: u32 = 1;
/// Bit of [`Frame::features`]: some material transmits light, so shadow rays must look at what they hit.
pub const TRANSPARENT: u32 = 2;

/// One pass over a picture: the uniform buffer of the kernel.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Frame {
    /// Where the picture is taken from.
    pub camera: Camera,
    /// The octree's cube.
    pub root: Root,
    /// The first light; the scene has the others.
    pub light: Light,
    /// What rays see that leave the scene.
    pub environment: Environment,
    /// Ambient light, linear RGB: what every surface gets from everywhere.
    pub ambient: Vec3,
    /// [`FLAT`], [`TRANSPARENT`].
    pub features: u32,
    /// Samples of a pixel in all: 1, 4, 16 or 64.
    pub samples: u32,
    /// Where they lie: one of [`crate::sampling`].
    pub pattern: u32,
    /// How they are weighted: one of [`crate::sampling`].
    pub filter: u32,
    /// Samples of a pixel along each side, if they lie in a regular grid.
    pub samples_per_side: u32,
    /// First sample of this pass.
    pub first_sample: u32,
    /// Samples in this pass.
    pub sample_count: u32,
    /// Lights beside the first.
    pub light_count: u32,
    /// Planes of the scene.
    pub plane_count: u32,
    /// How many times a ray may be reflected or refracted, at most [`crate::whitted::MAX_DEPTH`].
    pub depth: u32,
    /// Rays are not followed as long as all that is left out can change no channel of the output by more than so many
    /// steps of 8 bits (see [`crate::display`]); 0: all are.
    pub cutoff: f32,
    /// How two eyes share the picture: one of [`crate::stereo`].
    pub stereo: u32,
    /// First row of the picture that this pass renders: devices may not take all of it at once.
    pub first_row: u32,
    /// What the camera is inside of: see [`crate::medium::Media::of_eye`].
    pub media: UVec4,
    /// The brightest that a ray can see, linear RGB.
    pub brightest: Vec3,
    /// What colours are multiplied with before they are shown.
    pub exposure: f32,
    /// How they are made to fit the output: one of [`crate::tone`].
    pub curve: u32,
    /// How far a pixel may be off, as a part of the output's range, before [`crate::adaptive`] gives it more samples.
    pub tolerance: f32,
    /// Edge of the blocks of pixels that may be interpolated, a power of two; 1 where none may (see [`crate::adaptive`]).
    pub block: u32,
    /// Samples that a pixel may get, 1, 4, 16 or 64, where each gets as many as it needs; 0 where all get
    /// [`Frame::samples`].
    pub most_samples: u32,
    /// If this pass renders the pixels of a list, the number of the round that makes the list, from 1 on (see
    /// [`crate::adaptive`]); 0 if it renders all.
    pub is_listed: u32,
    /// First place in that list.
    pub first_listed: u32,
    /// Fills the rows; fields of their own because an array in a uniform buffer needs 16 bytes an element.
    pub reserved_a: u32,
    /// Fills the rows.
    pub reserved_b: u32,
}

const _: () = assert!(size_of::<Frame>() == 368);

/// From this bit on, [`Frame::features`] holds the number of the parts that rays are traced with.
pub const PARTS_SHIFT: u32 = 24;

impl Frame {
    /// What [`crate::general::General`] is to be, see [`crate::parts::Parts::number`].
    #[inline]
    pub fn parts(&self) -> u32 {
        self.features >> PARTS_SHIFT
    }

    /// Width and height of the picture in pixels: the camera's, or twice as wide or high where the eyes have a half each.
    #[inline]
    pub fn size(&self) -> UVec2 {
        let (width, height) = (self.camera.width, self.camera.height);
        if self.stereo == SIDE_BY_SIDE {
            uvec2(2 * width, height)
        } else if self.stereo == STACKED {
            uvec2(width, 2 * height)
        } else {
            uvec2(width, height)
        }
    }
}
