//! Lines below the panels of an overlay.

use crate::viewer::overlay::Overlay;
use crate::wires::Layer;

/// An overlay over lines, in a window of that size. Of layers the first is the uppermost.
pub fn laid(overlay: &Overlay, layers: &[&Layer], [width, height]: [u32; 2]) -> Overlay {
    let texel_of = |x: u32, y: u32| {
        let is_over = x < overlay.width && y < overlay.height;
        let over = if is_over {
            overlay.texels[(y * overlay.width + x) as usize]
        } else {
            0
        };
        let layers = layers.iter().filter(|layer| x < layer.size[0] && y < layer.size[1]);
        layers.fold(over, |over, layer| {
            over_other(over, layer.texels[(y * layer.size[0] + x) as usize])
        })
    };
    Overlay {
        width,
        height,
        texels: (0..height)
            .flat_map(|y| (0..width).map(move |x| (x, y)))
            .map(|(x, y)| texel_of(x, y))
            .collect(),
    }
}

/// A texel over another one: colours with their opacity, not multiplied by it (T. Porter, T. Duff 1984).
fn over_other(over: u32, under: u32) -> u32 {
    if over >> 24 == 255 || under >> 24 == 0 {
        return over;
    }
    if over >> 24 == 0 {
        return under;
    }
    let [a, b] = [over, under].map(|texel| texel.to_le_bytes().map(u32::from));
    // In parts of 255 * 255.
    let (upper, lower) = (a[3] * 255, b[3] * (255 - a[3]));
    let all = upper + lower;
    let mixed = |channel: usize| ((a[channel] * upper + b[channel] * lower + all / 2) / all) as u8;
    u32::from_le_bytes([mixed(0), mixed(1), mixed(2), ((all + 127) / 255) as u8])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texel(red: u8, opacity: u8) -> u32 {
        u32::from_le_bytes([red, 0, 0, opacity])
    }

    #[test]
    fn panels_are_over_lines_and_lines_over_lines() {
        let overlay = Overlay {
            width: 2,
            height: 1,
            texels: vec![texel(10, 255), texel(100, 51)],
        };
        let layer = |texels: [u32; 3]| Layer {
            size: [3, 1],
            texels: texels.into(),
        };
        let upper = layer([texel(1, 200), texel(200, 255), 0]);
        let lower = layer([texel(2, 200), texel(3, 255), texel(4, 77)]);
        let laid = laid(&overlay, &[&upper, &lower], [3, 2]);
        assert_eq!((laid.width, laid.height), (3, 2));
        let wanted = [texel(10, 255), texel(180, 255), texel(4, 77), 0, 0, 0];
        assert_eq!(laid.texels, wanted);
        // Half of a half: three quarters are covered, two thirds of them by the upper one.
        assert_eq!(over_other(texel(90, 128), texel(0, 128)), texel(60, 192));
    }
}
