//! Colours for what pixels tell.

use glam::Vec3;

/// A map from numbers to colours whose steps look even to the eye, and to the colour-blind (S. van der Walt, N. Smith 2015).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Palette {
    /// From purple over green to yellow.
    Viridis,
    /// From black over red to pale yellow.
    Inferno,
}

impl Palette {
    /// The colour at a place, 0 to 1, sRGB-encoded.
    pub fn color(self, place: f64) -> [u8; 3] {
        let gradient = match self {
            Palette::Viridis => colorous::VIRIDIS,
            Palette::Inferno => colorous::INFERNO,
        };
        gradient.eval_continuous(place.clamp(0.0, 1.0)).into_array()
    }
}

/// A colour that numbers next to each other do not share, never dark.
pub(crate) fn hashed_color(number: u32) -> [u8; 3] {
    // The finaliser of A. Appleby's MurmurHash3.
    let mut hash = number ^ 0x9e37_79b9;
    hash = (hash ^ hash >> 16).wrapping_mul(0x85eb_ca6b);
    hash = (hash ^ hash >> 13).wrapping_mul(0xc2b2_ae35);
    let [red, green, blue, _] = (hash ^ hash >> 16).to_le_bytes();
    [red, green, blue].map(|channel| 64 + channel / 4 * 3)
}

/// A unit vector, its coordinates from -1 to 1 as channels.
pub(super) fn normal_color(normal: Vec3) -> [u8; 3] {
    ((normal + Vec3::ONE) / 2.0).to_array().map(channel)
}

/// The weights of a triangle's corners, from those of the second and the third.
pub(super) fn barycentric_color(u: f32, v: f32) -> [u8; 3] {
    [1.0 - u - v, u, v].map(channel)
}

fn channel(part: f32) -> u8 {
    (part.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn ends_have_the_colours_that_are_published() {
        assert_eq!(
            [0.0, 1.0].map(|place| Palette::Viridis.color(place)),
            [[68, 1, 84], [253, 231, 37]]
        );
        assert_eq!(
            [0.0, 1.0].map(|place| Palette::Inferno.color(place)),
            [[0, 0, 4], [252, 255, 164]]
        );
        assert_eq!(Palette::Viridis.color(-1.0), Palette::Viridis.color(0.0));
    }

    #[test]
    fn ids_are_told_apart() {
        let colors: HashSet<_> = (0..1000).map(hashed_color).collect();
        assert!(colors.len() > 990, "{}", colors.len());
        assert!(colors.iter().flatten().all(|channel| *channel >= 64));
    }

    #[test]
    fn directions_and_weights_are_channels() {
        assert_eq!(normal_color(Vec3::new(-1.0, 0.0, 1.0)), [0, 128, 255]);
        assert_eq!(barycentric_color(0.25, 0.75), [0, 64, 191]);
    }
}
