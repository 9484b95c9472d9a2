//! Colours and heights over a surface.

use crate::model::Model;
use glam::{DVec2, DVec3};
use oktant_shared::texture::{CHECKERBOARD, HEIGHT_IMAGE, SHARED_EXPONENT_IMAGE, SRGB_IMAGE, Texture, WAVES};
use std::f64::consts::TAU;

/// Linear light of an sRGB-encoded channel, 0 to 1 (IEC 61966-2-1).
fn decoded(channel: f64) -> f64 {
    if channel <= 0.04045 {
        channel / 12.92
    } else {
        ((channel + 0.055) / 1.055).powf(2.4)
    }
}

/// Linear light of a colour of three sRGB-encoded bytes.
pub(super) fn light_of(bytes: [u8; 3]) -> DVec3 {
    DVec3::from(bytes.map(|byte| decoded(f64::from(byte) / 255.0)))
}

/// Three sRGB-encoded bytes in a word, red lowest.
fn bytes_of(word: u32) -> [u8; 3] {
    let [red, green, blue, _] = word.to_le_bytes();
    [red, green, blue]
}

/// The colour of a texture at texture coordinates, linear RGB.
pub(super) fn color(model: &Model, id: u32, at: DVec2) -> DVec3 {
    let texture = &model.textures[id as usize];
    let at = at * f64::from(texture.repeats);
    match texture.kind {
        CHECKERBOARD => {
            let is_even = (at.x.floor() + at.y.floor()).rem_euclid(2.0) < 0.5;
            light_of(bytes_of(if is_even { texture.width } else { texture.height }))
        }
        WAVES => DVec3::splat(0.5 + 0.25 * ((TAU * at.x.fract()).sin() + (TAU * at.y.fract()).sin())),
        _ => interpolated(model, texture, at),
    }
}

/// The height that a texture says at texture coordinates: the mean of its channels.
fn height(model: &Model, id: u32, at: DVec2) -> f64 {
    color(model, id, at).element_sum() / 3.0
}

/// How the height changes along both axes of the texture: between points one texel of an image, or a hundredth of a
/// pattern's period, apart.
pub(super) fn slope(model: &Model, id: u32, at: DVec2) -> DVec2 {
    let texture = &model.textures[id as usize];
    let apart = match texture.kind {
        CHECKERBOARD | WAVES => DVec2::splat(0.01),
        _ => 1.0 / DVec2::new(f64::from(texture.width), f64::from(texture.height)),
    } / f64::from(texture.repeats);
    let along = |step: DVec2| height(model, id, at + step / 2.0) - height(model, id, at - step / 2.0);
    DVec2::new(along(DVec2::new(apart.x, 0.0)), along(DVec2::new(0.0, apart.y))) / apart
}

/// Between the middles of the four nearest texels; the image is repeated, its row 0 on top.
fn interpolated(model: &Model, texture: &Texture, at: DVec2) -> DVec3 {
    let x = at.x.rem_euclid(1.0) * f64::from(texture.width) - 0.5;
    let y = (1.0 - at.y.rem_euclid(1.0)) * f64::from(texture.height) - 0.5;
    let texel = |column: f64, row: f64| {
        let column = column.rem_euclid(f64::from(texture.width)) as usize;
        let row = row.rem_euclid(f64::from(texture.height)) as usize;
        let index = texture.first as usize + row * texture.width as usize + column;
        texel_light(texture.kind, model.texels[index])
    };
    let (left, above) = (x.floor(), y.floor());
    let row = |y: f64| texel(left, y).lerp(texel(left + 1.0, y), x - left);
    row(above).lerp(row(above + 1.0), y - above)
}

fn texel_light(kind: u32, texel: u32) -> DVec3 {
    match kind {
        SRGB_IMAGE => light_of(bytes_of(texel)),
        HEIGHT_IMAGE => DVec3::splat(f64::from(f32::from_bits(texel))),
        kind => {
            debug_assert_eq!(kind, SHARED_EXPONENT_IMAGE);
            // E5B9G9R9: three mantissas of 9 bits without a leading one, and an exponent that 15 is added to.
            let scale = ((texel >> 27) as f64 - 15.0 - 9.0).exp2();
            let mantissa = |shift: u32| f64::from(texel >> shift & 0x1ff);
            DVec3::new(mantissa(0), mantissa(9), mantissa(18)) * scale
        }
    }
}
