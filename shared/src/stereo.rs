//! Two pictures in one, for two eyes.

use crate::frame::Frame;
use glam::{UVec2, Vec3, uvec2};

/// [`Frame::stereo`]: one picture, from the middle between the eyes.
pub const MONO: u32 = 0;
/// [`Frame::stereo`]: the left eye's picture at the left, the right eye's beside it.
pub const SIDE_BY_SIDE: u32 = 1;
/// [`Frame::stereo`]: the rows of the two pictures in turn, the uppermost the left eye's: for screens that polarise them
/// differently.
pub const ROWS: u32 = 2;
/// [`Frame::stereo`]: the left eye's picture above the right eye's, to be shown one after the other: for shutters.
pub const STACKED: u32 = 3;
/// [`Frame::stereo`]: the left eye's picture in red, the right eye's in green and blue: for glasses of two colours.
pub const ANAGLYPH: u32 = 4;

/// What a pixel of a picture shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EyeView {
    /// A pixel of the camera's picture.
    pub pixel: UVec2,
    /// From which eye: -1 the left, 1 the right, 0 the middle between them.
    pub eye: f32,
}

impl EyeView {
    /// What a pixel of a picture shows; of two eyes that share it, the one with this number.
    #[inline]
    pub fn new(frame: &Frame, pixel: UVec2, number: u32) -> Self {
        let size = uvec2(frame.camera.width, frame.camera.height);
        let (pixel, is_right) = match frame.stereo {
            SIDE_BY_SIDE if pixel.x >= size.x => (uvec2(pixel.x - size.x, pixel.y), true),
            STACKED if pixel.y >= size.y => (uvec2(pixel.x, pixel.y - size.y), true),
            ROWS => (pixel, pixel.y % 2 == 1),
            _ => (pixel, number == 1),
        };
        let eye = if frame.stereo == MONO {
            0.0
        } else if is_right {
            1.0
        } else {
            -1.0
        };
        EyeView { pixel, eye }
    }

    /// How many eyes share a pixel.
    pub fn eyes(frame: &Frame) -> u32 {
        if frame.stereo == ANAGLYPH { 2 } else { 1 }
    }

    /// The part of a colour that the eye contributes to the pixel, and of its sample's weight.
    #[inline]
    pub fn share(&self, frame: &Frame, color: Vec3, weight: f32) -> (Vec3, f32) {
        if frame.stereo != ANAGLYPH {
            (color, weight)
        } else if self.eye < 0.0 {
            (Vec3::new(color.x, 0.0, 0.0), weight)
        } else {
            (Vec3::new(0.0, color.y, color.z), 0.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable;

    #[test]
    fn every_eye_sees_its_pixels() {
        let frame = |stereo| {
            let mut frame = Frame {
                stereo,
                ..Frame::zeroed()
            };
            (frame.camera.width, frame.camera.height) = (10, 8);
            frame
        };
        let seen = |stereo, x, y| {
            let view = EyeView::new(&frame(stereo), uvec2(x, y), 0);
            (view.pixel.x, view.pixel.y, view.eye)
        };
        assert_eq!(seen(MONO, 3, 5), (3, 5, 0.0));
        assert_eq!(seen(SIDE_BY_SIDE, 9, 5), (9, 5, -1.0));
        assert_eq!(seen(SIDE_BY_SIDE, 10, 5), (0, 5, 1.0));
        assert_eq!(seen(STACKED, 3, 7), (3, 7, -1.0));
        assert_eq!(seen(STACKED, 3, 8), (3, 0, 1.0));
        assert_eq!(seen(ROWS, 3, 4), (3, 4, -1.0));
        assert_eq!(seen(ROWS, 3, 5), (3, 5, 1.0));
        assert_eq!(frame(SIDE_BY_SIDE).size(), uvec2(20, 8));
        assert_eq!(frame(STACKED).size(), uvec2(10, 16));
        assert_eq!(frame(ROWS).size(), uvec2(10, 8));
    }

    #[test]
    fn an_anaglyph_has_the_colours_of_both() {
        let frame = Frame {
            stereo: ANAGLYPH,
            ..Frame::zeroed()
        };
        let mut sum = (Vec3::ZERO, 0.0);
        for number in 0..EyeView::eyes(&frame) {
            let view = EyeView::new(&frame, UVec2::ZERO, number);
            let color = if view.eye < 0.0 { Vec3::X } else { Vec3::splat(0.5) };
            let share = view.share(&frame, color, 2.0);
            sum = (sum.0 + share.0, sum.1 + share.1);
        }
        assert_eq!(sum, (Vec3::new(1.0, 0.5, 0.5), 2.0));
    }
}
