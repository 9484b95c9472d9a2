//! Picture and overlay as the window shows them, on the CPU.

use super::overlay::Overlay;
use super::showing::Showing;
use crate::picture::Picture;
use glam::{Vec3, Vec4, vec2};
use oktant_shared::color::linear_from_srgb;
use oktant_shared::present::{Present, mean_color, presented_color};
use oktant_shared::tone::tone_mapped;
use std::num::NonZero;
use std::sync::LazyLock;

/// Threads that compose at most.
const THREADS: usize = 4;

/// Writes the pixels of a surface, sRGB-encoded, as `0x00RRGGBB`: what [`presented_color`] says, with a short cut where
/// one pixel of the picture covers several of the surface.
///
/// On threads of its own: all of rayon's may be rendering, and would be waited for.
pub fn compose(picture: &Picture, overlay: &Overlay, showing: &Showing, surface: [u32; 2], pixels: &mut [u32]) {
    let present = &showing.present([picture.width, picture.height], overlay, surface);
    let columns: Vec<u32> = (0..surface[0]).map(|x| scaled(x, surface[0], picture.width)).collect();
    let width = surface[0] as usize;
    let threads = std::thread::available_parallelism()
        .map_or(1, NonZero::get)
        .min(THREADS);
    let rows = (surface[1] as usize).div_ceil(threads);
    let columns = &columns;
    std::thread::scope(|scope| {
        for (band, top) in pixels.chunks_mut(width * rows).zip((0..).step_by(rows)) {
            scope.spawn(move || {
                let mut last = None;
                for y in 0..band.len() / width {
                    let (above, row) = band.split_at_mut(y * width);
                    let row = &mut row[..width];
                    let y = (top + y) as u32;
                    let source = present.first_row + scaled(y, surface[1], present.height);
                    if last == Some(source) && y > overlay.height {
                        row.copy_from_slice(&above[above.len() - width..]);
                        continue;
                    }
                    last = Some(source);
                    compose_row(
                        present,
                        &picture.sums[(source * picture.width) as usize..],
                        columns,
                        row,
                    );
                    if y < overlay.height {
                        lay_over(present, picture, overlay, y, row);
                    }
                }
            });
        }
    });
}

/// Writes a row of the surface that shows a row of the picture.
fn compose_row(present: &Present, sums: &[Vec4], columns: &[u32], row: &mut [u32]) {
    let encoder = &*ENCODER;
    let mut last = (u32::MAX, 0);
    for (pixel, &column) in row.iter_mut().zip(columns) {
        if last.0 != column {
            let color = tone_mapped(mean_color(sums[column as usize]), present.exposure, present.curve);
            last = (column, encoder.encode(color));
        }
        *pixel = last.1;
    }
}

/// Lays the overlay over a row of the surface.
fn lay_over(present: &Present, picture: &Picture, overlay: &Overlay, y: u32, row: &mut [u32]) {
    let start = (y * overlay.width) as usize;
    let texels = &overlay.texels[start..start + overlay.width as usize];
    for ((pixel, texel), x) in row.iter_mut().zip(texels).zip(0_u32..) {
        if texel >> 24 != 0 {
            let at = vec2(x as f32 + 0.5, y as f32 + 0.5);
            let color = presented_color(present, &picture.sums, &overlay.texels, at);
            *pixel = ENCODER.encode(color.truncate());
        }
    }
}

/// The place in a row of `to` pixels that a pixel of a row of `from` shows, as in `shared::present`.
fn scaled(pixel: u32, from: u32, to: u32) -> u32 {
    let place = ((pixel as f32 + 0.5) * to as f32 / from as f32) as u32;
    place.min(to - 1)
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
        // What is not a number becomes 0: it is cast to 0, and is not greater than anything.
        let linear = linear.clamp(0.0, 1.0);
        let mut byte = u32::from(self.guesses[(linear * (GUESSES - 1) as f32) as usize]);
        while linear >= self.thresholds[byte as usize + 1] {
            byte += 1;
        }
        byte
    }
}

#[cfg(test)]
mod tests {
    use super::super::showing::Part;
    use super::*;
    use crate::picture::srgb_bytes;
    use crate::tone::{Curve, Tone};

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
    fn the_short_cut_shows_what_the_gpu_does() {
        let mut random = 1_u32;
        let mut next = || {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            random >> 8
        };
        for (size, surface) in [
            ([1, 1], [5, 3]),
            ([7, 5], [7, 5]),
            ([5, 7], [13, 20]),
            ([40, 31], [160, 121]),
            ([30, 30], [17, 11]),
        ] {
            let sum = |value: u32| Vec4::new((value & 255) as f32, (value >> 8 & 255) as f32, 90.0, 255.0);
            let sums = (0..size[0] * size[1]).map(|_| sum(next())).collect();
            let picture = Picture::of_sums(size[0], size[1], sums);
            let overlay = Overlay {
                width: 6,
                height: 4,
                texels: (0..24).map(|_| next() << 8 | 7).collect(),
            };
            let mut pixels = vec![0; (surface[0] * surface[1]) as usize];
            for (part, curve) in [Part::Whole, Part::Upper, Part::Lower].into_iter().zip(Curve::ALL) {
                if part != Part::Whole && size[1] == 1 {
                    continue;
                }
                let tone = Tone { exposure: 0.7, curve };
                let showing = Showing { tone, part };
                compose(&picture, &overlay, &showing, surface, &mut pixels);
                let present = showing.present(size, &overlay, surface);
                for (pixel, i) in pixels.iter().zip(0..) {
                    let at = vec2((i % surface[0]) as f32 + 0.5, (i / surface[0]) as f32 + 0.5);
                    let color = presented_color(&present, &picture.sums, &overlay.texels, at);
                    assert_eq!(
                        *pixel,
                        ENCODER.encode(color.truncate()),
                        "{at} of {surface:?}, {showing:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn eyes_take_turns() {
        let [left, right] = [Vec4::new(1.0, 0.0, 0.0, 1.0), Vec4::new(0.0, 0.0, 0.5, 1.0)];
        let picture = Picture::of_sums(1, 4, vec![left, left, right, right]);
        let shown = |part| {
            let showing = Showing {
                tone: Tone {
                    exposure: 1.0,
                    ..Tone::default()
                },
                part,
            };
            let mut pixels = vec![0; 6];
            compose(&picture, &Overlay::default(), &showing, [2, 3], &mut pixels);
            pixels
        };
        assert_eq!(shown(Part::Upper), [0x00ff_0000; 6]);
        assert_eq!(shown(Part::Lower), [0x0000_00ff; 6]);
    }

    #[test]
    fn a_surface_shows_the_picture_and_the_overlay() {
        let picture = Picture::of_sums(2, 1, vec![Vec4::new(0.0, 0.0, 2.0, 2.0), Vec4::ZERO]);
        let overlay = Overlay {
            width: 1,
            height: 1,
            texels: vec![0xff00_00ff],
        };
        let mut pixels = vec![0; 4 * 2];
        compose(&picture, &overlay, &Showing::default(), [4, 2], &mut pixels);
        let (blue, red, magenta) = (0x0000_00ff, 0x00ff_0000, 0x00ff_00ff);
        assert_eq!(pixels, [red, blue, magenta, magenta, blue, blue, magenta, magenta]);
    }
}
