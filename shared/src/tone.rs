//! From the light of a scene to what a screen can show.

use crate::arithmetic::{max, min};
use glam::Vec3;

/// Curve: what is brighter than the screen is cut off.
pub const CLIPPED: u32 = 0;
/// Curve: `c / (1 + c)` of the luminance (E. Reinhard et al., "Photographic tone reproduction for digital images",
/// SIGGRAPH 2002, equation 3).
pub const REINHARD: u32 = 1;
/// Curve: the filmic fit of K. Narkowicz ("ACES filmic tone mapping curve", 2015), channel by channel.
pub const ACES: u32 = 2;

/// A linear colour, 0 and up, as linear RGB from 0 to 1: exposed (multiplied with `exposure`), then bent by the curve.
pub fn tone_mapped(color: Vec3, exposure: f32, curve: u32) -> Vec3 {
    let color = color * exposure;
    if curve == REINHARD {
        // Rec. 709.
        let luminance = color.dot(Vec3::new(0.2126, 0.7152, 0.0722));
        return clipped(color / (1.0 + max(luminance, 0.0)));
    }
    if curve == ACES {
        // Beyond this the fit is 1, and its squares would overflow.
        let c = Vec3::new(min(color.x, 1e4), min(color.y, 1e4), min(color.z, 1e4));
        return clipped(c * (c * 2.51 + Vec3::splat(0.03)) / (c * (c * 2.43 + Vec3::splat(0.59)) + Vec3::splat(0.14)));
    }
    clipped(color)
}

fn clipped(color: Vec3) -> Vec3 {
    let channel = |c: f32| max(min(c, 1.0), 0.0);
    Vec3::new(channel(color.x), channel(color.y), channel(color.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_rise_from_black_to_white() {
        for curve in [CLIPPED, REINHARD, ACES] {
            assert_eq!(tone_mapped(Vec3::ZERO, 3.0, curve), Vec3::ZERO, "curve {curve}");
            let mut last = 0.0;
            for i in 1..2000 {
                let shown = tone_mapped(Vec3::splat(i as f32 * 0.01), 1.0, curve).x;
                assert!(shown >= last && shown <= 1.0, "curve {curve} at {i}");
                last = shown;
            }
            assert!(last > 0.95);
            assert!(
                tone_mapped(Vec3::splat(f32::MAX), 1.0, curve).x >= 0.99,
                "curve {curve}"
            );
        }
        assert_eq!(tone_mapped(Vec3::ONE, 1.0, REINHARD), Vec3::splat(0.5));
        assert!(tone_mapped(Vec3::splat(0.18), 1.0, ACES).x > 0.2);
        assert_eq!(tone_mapped(Vec3::splat(0.25), 2.0, CLIPPED), Vec3::splat(0.5));
    }
}
