//! Findings over a picture.

use super::findings::{Disagreement, Findings, PENDING};
use crate::viewer::overlay::Overlay;
use crate::viewer::showing::Part;

/// What lies over pixels that agree, so that the others are seen: half dark.
const VEIL: u32 = 0x9000_0000;

/// The panels of an overlay over findings, in a window of that size that shows this part of the picture.
pub fn veiled(panels: &Overlay, findings: &Findings, part: Part, [width, height]: [u32; 2]) -> Overlay {
    let first_row = match part {
        Part::Lower => findings.size[1] / 2,
        Part::Whole | Part::Upper => 0,
    };
    let found = |x: u32, y: u32| {
        let row = y + first_row;
        let is_within = x < findings.size[0] && row < findings.size[1];
        let bits = match is_within {
            true => findings.pixels[(row * findings.size[0] + x) as usize],
            false => PENDING,
        };
        match Disagreement::ALL.into_iter().find(|kind| bits & kind.bit() != 0) {
            _ if bits == PENDING => 0,
            None => VEIL,
            Some(kind) => {
                let [red, green, blue] = kind.color();
                u32::from_le_bytes([red, green, blue, 255])
            }
        }
    };
    let texel = |x: u32, y: u32| {
        let is_panel = x < panels.width && y < panels.height;
        let panel = if is_panel {
            panels.texels[(y * panels.width + x) as usize]
        } else {
            0
        };
        if panel != 0 { panel } else { found(x, y) }
    };
    Overlay {
        width,
        height,
        texels: (0..height)
            .flat_map(|y| (0..width).map(move |x| (x, y)))
            .map(|(x, y)| texel(x, y))
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_disagrees_stands_out_and_panels_are_over_it() {
        let findings = Findings {
            size: [3, 2],
            pixels: vec![
                0,
                Disagreement::Color.bit(),
                PENDING,
                Disagreement::Id.bit() | Disagreement::Color.bit(),
                0,
                0,
            ],
        };
        let panels = Overlay {
            width: 2,
            height: 2,
            texels: vec![0, 0, 0, 7],
        };
        let shown = veiled(&panels, &findings, Part::Whole, [3, 2]);
        let color = |kind: Disagreement| {
            let [red, green, blue] = kind.color();
            u32::from_le_bytes([red, green, blue, 255])
        };
        let wanted = [VEIL, color(Disagreement::Color), 0, color(Disagreement::Id), 7, VEIL];
        assert_eq!(shown.texels, wanted);
        let lower = veiled(&Overlay::default(), &findings, Part::Lower, [3, 1]);
        assert_eq!(lower.texels, [color(Disagreement::Id), VEIL, VEIL]);
        assert_eq!((findings.compared(), findings.count(Disagreement::Color)), (5, 2));
    }
}
