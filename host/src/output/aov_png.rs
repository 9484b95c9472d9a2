//! What pixels tell beside their colour, as pictures to look at.

use super::png::{Pixels, Png};
use crate::aov::Aov;
use crate::insight::hashed_color;
use crate::picture::Picture;
use crate::seen::Seen;
use glam::Vec3;
use oktant_shared::hit::Hit;

/// What stands in pixels that see nothing.
const NOTHING: [u8; 3] = [0; 3];

/// A picture of one of them, with a sentence that says how to read it.
pub fn png(aov: Aov, picture: &Picture, seen: &Seen) -> Png<'static> {
    let (pixels, description) = match aov {
        Aov::Depth => depth(&seen.hits),
        Aov::Normal => (
            rgb16(seen.normals.iter().map(|normal| {
                if *normal == Vec3::ZERO {
                    Vec3::ZERO
                } else {
                    (*normal + Vec3::ONE) / 2.0
                }
            })),
            "Unit normals in the scene's axes: red, green and blue are (x + 1) / 2, (y + 1) / 2 and (z + 1) / 2 of 65535; \
             black where nothing is hit."
                .into(),
        ),
        Aov::Id => (
            rgb8(seen.hits.iter().map(|hit| {
                if hit.is_hit() {
                    hashed_color(hit.triangle)
                } else {
                    NOTHING
                }
            })),
            "A colour for each triangle or plane, by a hash of its number (an EXR file has the number itself); black \
             where nothing is hit."
                .into(),
        ),
        Aov::Barycentrics => (
            rgb16(seen.hits.iter().map(|hit| {
                if hit.is_hit() {
                    Vec3::new(1.0 - hit.u - hit.v, hit.u, hit.v)
                } else {
                    Vec3::ZERO
                }
            })),
            "Weights of the triangle's first, second and third corner: red, green and blue of 65535; black where nothing \
             is hit."
                .into(),
        ),
        Aov::Samples => heat(
            picture.sums.iter().map(|sum| sum.w).collect(),
            "Sum of the samples' weights",
        ),
        Aov::Rays => heat(
            picture.work.iter().map(|work| work.x + work.y).collect(),
            "Closest-hit and shadow rays",
        ),
    };
    Png {
        width: picture.width,
        height: picture.height,
        pixels,
        description: Some(description),
    }
}

/// The nearest is white, the farthest almost black.
fn depth(hits: &[Hit]) -> (Pixels<'static>, String) {
    let depths = hits.iter().filter(|hit| hit.is_hit()).map(|hit| hit.t);
    let (near, far) = depths.fold((f32::INFINITY, 0.0_f32), |(near, far), t| (near.min(t), far.max(t)));
    let range = f64::from(far) - f64::from(near);
    let value = |hit: &Hit| {
        if !hit.is_hit() {
            0
        } else if range > 0.0 {
            1 + ((f64::from(far) - f64::from(hit.t)) / range * 65_534.0).round() as u16
        } else {
            65_535
        }
    };
    let description = if near > far {
        "Depth along the line of sight: nothing is hit, so all is 0.".into()
    } else {
        format!("Depth along the line of sight, scene units: 65535 is {near}, 1 is {far}, 0 where nothing is hit.")
    };
    (Pixels::Gray16(hits.iter().map(value).collect()), description)
}

/// Numbers from 0 up as colours from dark to bright, even to the eye and to the colour-blind.
fn heat(values: Vec<f32>, what: &str) -> (Pixels<'static>, String) {
    let greatest = values.iter().copied().fold(0.0, f32::max);
    let scale = if greatest > 0.0 { 1.0 / f64::from(greatest) } else { 0.0 };
    let color = |value: f32| {
        colorous::VIRIDIS
            .eval_continuous((f64::from(value) * scale).clamp(0.0, 1.0))
            .into_array()
    };
    (
        rgb8(values.into_iter().map(color)),
        format!("{what} of each pixel, from 0 (purple) to {greatest} (yellow) by the colour map viridis."),
    )
}

fn rgb8(colors: impl Iterator<Item = [u8; 3]>) -> Pixels<'static> {
    Pixels::Rgb8(colors.flatten().collect())
}

fn rgb16(colors: impl Iterator<Item = Vec3>) -> Pixels<'static> {
    let whole = |channel: f32| (channel.clamp(0.0, 1.0) * 65_535.0 + 0.5) as u16;
    Pixels::Rgb16(colors.flat_map(|color| color.to_array().map(whole)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Vec4, vec3, vec4};

    fn hit(triangle: u32, t: f32, u: f32, v: f32) -> Hit {
        Hit { t, triangle, u, v }
    }

    fn drawn(aov: Aov) -> (Vec<u16>, String) {
        let picture = Picture {
            work: vec![vec4(1.0, 1.0, 0.0, 0.0), vec4(4.0, 4.0, 0.0, 0.0), Vec4::ZERO],
            ..Picture::of_sums(3, 1, vec![Vec4::splat(4.0), Vec4::splat(4.0), Vec4::ZERO])
        };
        let seen = Seen {
            width: 3,
            hits: vec![hit(7, 2.0, 0.25, 0.5), hit(8, 6.0, 0.0, 0.0), Hit::miss(f32::MAX)],
            normals: vec![vec3(-1.0, 0.0, 0.0), Vec3::Y, Vec3::ZERO],
        };
        let png = png(aov, &picture, &seen);
        assert_eq!((png.width, png.height), (3, 1));
        let channels = match png.pixels {
            Pixels::Rgb8(channels) => channels.iter().map(|channel| u16::from(*channel)).collect(),
            Pixels::Rgb16(channels) | Pixels::Gray16(channels) => channels,
        };
        (channels, png.description.unwrap())
    }

    #[test]
    fn depth_says_its_range() {
        let (channels, description) = drawn(Aov::Depth);
        assert_eq!(channels, [65_535, 1, 0]);
        assert!(description.contains("65535 is 2, 1 is 6"), "{description}");
        let (_, description) = depth(&[Hit::miss(1.0)]);
        assert!(description.contains("nothing is hit"), "{description}");
        let (pixels, _) = depth(&[hit(0, 3.0, 0.0, 0.0), Hit::miss(1.0)]);
        assert!(matches!(pixels, Pixels::Gray16(channels) if channels == [65_535, 0]));
    }

    #[test]
    fn normals_and_barycentrics_are_colours() {
        assert_eq!(
            drawn(Aov::Normal).0,
            [0, 32_768, 32_768, 32_768, 65_535, 32_768, 0, 0, 0]
        );
        assert_eq!(
            drawn(Aov::Barycentrics).0,
            [16_384, 16_384, 32_768, 65_535, 0, 0, 0, 0, 0]
        );
    }

    #[test]
    fn counts_go_from_purple_to_yellow() {
        let (samples, description) = drawn(Aov::Samples);
        let [purple, yellow] = [[68, 1, 84], [253, 231, 37]];
        assert_eq!(samples, [yellow, yellow, purple].concat());
        assert!(description.contains("to 4 (yellow)"), "{description}");
        let (rays, description) = drawn(Aov::Rays);
        assert_eq!(rays[3..], [yellow, purple].concat());
        assert!(rays[1] > 1 && rays[1] < 231, "a quarter is between: {rays:?}");
        assert!(description.contains("to 8 (yellow)"), "{description}");
    }

    #[test]
    fn ids_are_told_apart() {
        let (channels, _) = drawn(Aov::Id);
        assert_ne!(channels[..3], channels[3..6]);
        assert_eq!(channels[6..], [0, 0, 0]);
    }
}
