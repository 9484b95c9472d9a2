//! What of the light an output of 8 bits shows.
//!
//! How much more light it takes to be seen depends on how much there is: near black a step of sRGB is 1/3,295 of the
//! brightest, near white 1/112. So what may be left out is judged where it is shown, after exposure, tone curve and
//! encoding.

use crate::arithmetic::greater;
use crate::color::srgb_from_linear;
use crate::frame::Frame;
use crate::tone::{ACES, tone_mapped};
use glam::Vec3;
#[cfg(target_arch = "spirv")]
use num_traits::Float;

/// Steps of an output between black and white.
pub const STEPS: f32 = 255.0;

/// A linear colour, 0 and up, as the output encodes it, each channel 0 to 1.
#[inline(always)]
pub fn encoded(frame: &Frame, color: Vec3) -> Vec3 {
    let shown = tone_mapped(color, frame.exposure, frame.curve);
    Vec3::new(
        srgb_from_linear(shown.x),
        srgb_from_linear(shown.y),
        srgb_from_linear(shown.z),
    )
}

/// The most steps by which light of `doubt` in either direction can change a channel of `color`, both linear RGB, 0 and up.
///
/// The sRGB curve is the less steep the brighter, and no tone curve is steeper than is said below: the steepness at the
/// darkest that the colour can be bounds that of the whole way.
pub fn steps(frame: &Frame, color: Vec3, doubt: Vec3) -> f32 {
    let darkest = Vec3::new(
        greater(color.x - doubt.x, 0.0),
        greater(color.y - doubt.y, 0.0),
        greater(color.z - doubt.z, 0.0),
    );
    let shown = tone_mapped(darkest, frame.exposure, frame.curve);
    let most = greater(
        greater(steepness(shown.x) * doubt.x, steepness(shown.y) * doubt.y),
        steepness(shown.z) * doubt.z,
    );
    most * frame.exposure * steepest(frame.curve) * STEPS
}

/// How much a channel of the output rises with its linear value: the derivative of the sRGB transfer function.
fn steepness(linear: f32) -> f32 {
    if linear <= 0.003_130_8 {
        12.92
    } else {
        (1.055 / 2.4) * linear.powf(1.0 / 2.4 - 1.0)
    }
}

/// How steep a tone curve is at most, above which a channel rises no faster with the exposed light.
fn steepest(curve: u32) -> f32 {
    // Narkowicz's fit rises fastest at 0.13, by 1.79.
    if curve == ACES { 1.8 } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tone::{CLIPPED, REINHARD};
    use bytemuck::Zeroable;

    #[test]
    fn doubt_never_shows_more_than_it_is_said_to() {
        for curve in [CLIPPED, REINHARD, ACES] {
            for exposure in [0.25, 1.0, 8.0] {
                let frame = Frame {
                    exposure,
                    curve,
                    ..Frame::zeroed()
                };
                for i in 0..400 {
                    let value = 1.5e-5 * 1.04_f32.powi(i);
                    for doubt in [1e-5, 3e-4, 1e-2, 0.3].map(|part| part * (value + 1e-3)) {
                        let bound = steps(&frame, Vec3::splat(value), Vec3::splat(doubt));
                        let at = |value: f32| STEPS * encoded(&frame, Vec3::splat(value.max(0.0))).x;
                        let change = (at(value + doubt) - at(value)).max(at(value) - at(value - doubt));
                        assert!(
                            change <= bound * 1.0001 + 2e-4,
                            "curve {curve}, {value} +- {doubt}: {change} > {bound}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn the_bound_is_near_where_the_curve_is_straight() {
        let frame = Frame {
            exposure: 1.0,
            curve: CLIPPED,
            ..Frame::zeroed()
        };
        // Near black a step is 1/3295 of the brightest; at 0.5 1/390 or so.
        assert!((steps(&frame, Vec3::splat(1e-3), Vec3::splat(1.0 / 3294.6)) - 1.0).abs() < 1e-3);
        let middle = steps(&frame, Vec3::splat(0.5), Vec3::splat(1e-4)) / 1e-4;
        assert!((160.0..175.0).contains(&middle), "{middle}");
    }
}
