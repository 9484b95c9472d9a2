//! Picture and overlay as the window shows them, on the CPU.

use super::overlay::Overlay;
use crate::picture::Picture;
use glam::{Vec3, vec2};
use oktant_shared::present::{Present, presented_color};
use oktant_shared::shading::linear_from_srgb;
use std::sync::LazyLock;

/// How a picture and an overlay go onto a surface.
pub fn present(picture: [u32; 2], overlay: &Overlay, surface: [u32; 2]) -> Present {
    Present {
        width: picture[0],
        height: picture[1],
        surface_width: surface[0],
        surface_height: surface[1],
        overlay_width: overlay.width,
        overlay_height: overlay.height,
        reserved_a: 0,
        reserved_b: 0,
    }
}

/// Writes the pixels of a surface, sRGB-encoded, as `0x00RRGGBB`.
///
/// On the caller's thread alone: all others may be rendering, and would be waited for.
pub fn compose(picture: &Picture, overlay: &Overlay, surface: [u32; 2], pixels: &mut [u32]) {
    let encoder = &*ENCODER;
    let present = present([picture.width, picture.height], overlay, surface);
    for (row, y) in pixels.chunks_exact_mut(surface[0] as usize).zip(0..) {
        for (pixel, x) in row.iter_mut().zip(0..) {
            let at = vec2(x as f32 + 0.5, y as f32 + 0.5);
            let color = presented_color(&present, &picture.sums, &overlay.texels, at);
            *pixel = encoder.encode(color.truncate());
        }
    }
}

static ENCODER: LazyLock<Encoder> = LazyLock::new(Encoder::new);

/// Brackets of the first guess.
const GUESSES: usize = 4096;

/// The sRGB transfer function to bytes by comparison with the 255 numbers where it rises, because powers are slow.
struct Encoder {
    /// The least linear number that becomes this byte; beyond 1 for a byte past the last.
    thresholds: [f32; 257],
    /// The byte of the lower end of a bracket.
    guesses: Vec<u8>,
}

impl Encoder {
    fn new() -> Self {
        let mut thresholds = [2.0; 257];
        for (byte, threshold) in thresholds.iter_mut().take(256).enumerate() {
            *threshold = if byte == 0 {
                0.0
            } else {
                linear_from_srgb((byte as f32 - 0.5) / 255.0)
            };
        }
        let mut byte = 0_u8;
        let guesses = (0..GUESSES)
            .map(|i| {
                let linear = i as f32 / (GUESSES - 1) as f32;
                while linear >= thresholds[usize::from(byte) + 1] {
                    byte += 1;
                }
                byte
            })
            .collect();
        Encoder { thresholds, guesses }
    }

    fn encode(&self, color: Vec3) -> u32 {
        self.byte(color.x) << 16 | self.byte(color.y) << 8 | self.byte(color.z)
    }

    fn byte(&self, linear: f32) -> u32 {
        // Not a number becomes 0, as everything below.
        let linear = linear.max(0.0).min(1.0);
        let mut byte = u32::from(self.guesses[(linear * (GUESSES - 1) as f32) as usize]);
        while linear >= self.thresholds[byte as usize + 1] {
            byte += 1;
        }
        byte
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::srgb_bytes;
    use glam::Vec4;

    #[test]
    fn the_encoder_rounds_as_the_picture_file_does() {
        let mut differences = 0;
        for i in 0..=1_000_000_u32 {
            let linear = i as f32 / 1e6;
            let [wanted, ..] = srgb_bytes(Vec4::new(linear, 0.0, 0.0, 1.0));
            let is = ENCODER.byte(linear);
            assert!(is.abs_diff(u32::from(wanted)) <= 1, "{linear}");
            differences += u32::from(is != u32::from(wanted));
        }
        assert!(differences < 255, "{differences} ties fell to the other side");
        for (linear, byte) in [(-1.0, 0), (2.0, 255), (f32::NAN, 0), (f32::INFINITY, 255)] {
            assert_eq!(ENCODER.byte(linear), byte, "{linear}");
        }
    }

    #[test]
    fn a_surface_shows_the_picture_and_the_overlay() {
        let picture = Picture {
            width: 2,
            height: 1,
            sums: vec![Vec4::new(0.0, 0.0, 2.0, 2.0), Vec4::ZERO],
        };
        let overlay = Overlay {
            width: 1,
            height: 1,
            texels: vec![0xff00_00ff],
        };
        let mut pixels = vec![0; 4 * 2];
        compose(&picture, &overlay, [4, 2], &mut pixels);
        let (blue, red, magenta) = (0x0000_00ff, 0x00ff_0000, 0x00ff_00ff);
        assert_eq!(pixels, [red, blue, magenta, magenta, blue, blue, magenta, magenta]);
    }
}
