//! What pixels tell as a picture, with its legend below.

use super::Insight;
use super::legend::Legend;
use crate::viewer::overlay::{Overlay, PANEL_COLOR};
use rayon::prelude::*;

/// A picture to look at.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Drawing {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Red, green and blue of each pixel, sRGB-encoded, row by row from the upper left.
    pub pixels: Vec<u8>,
}

/// Letters are enlarged once for so many pixels of the width.
const LETTERS: u32 = 1600;

impl Drawing {
    /// What the pixels tell, in colours; each pixel is its own.
    pub fn new(insight: &Insight, legend: &Legend) -> Self {
        let [width, height] = insight.size;
        let pixels = width as usize * height as usize;
        let color = |index| insight.color(index, legend.scale.as_ref());
        Drawing {
            size: insight.size,
            pixels: (0..pixels).into_par_iter().flat_map_iter(color).collect(),
        }
    }

    /// With the legend below, so that it covers nothing.
    pub fn with(mut self, legend: &Legend) -> Self {
        let width = self.size[0];
        let enlarged = 1 + width / LETTERS;
        let panel = Overlay::new(&[legend.lines(Overlay::columns(width, enlarged))], enlarged);
        let blank = (0..width * panel.height).flat_map(|_| PANEL_COLOR);
        let first = self.pixels.len();
        self.pixels.extend(blank);
        for y in 0..panel.height {
            // What is too wide is cut off.
            for x in 0..panel.width.min(width) {
                let [red, green, blue, opacity] = panel.texels[(y * panel.width + x) as usize].to_le_bytes();
                if opacity == u8::MAX {
                    let at = first + 3 * (y * width + x) as usize;
                    self.pixels[at..at + 3].copy_from_slice(&[red, green, blue]);
                }
            }
        }
        self.size[1] += panel.height;
        self
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Aspect, Values};
    use super::*;
    use oktant_shared::parts::TraversalKind;

    #[test]
    fn ends_of_the_map_and_holes_have_their_colours_and_the_legend_is_below() {
        let insight = Insight {
            aspect: Aspect::Steps,
            size: [400, 1],
            values: Values::Numbers(
                (0..400)
                    .map(|i| if i == 7 { f32::NAN } else { i as f32 % 50.0 })
                    .collect(),
            ),
        };
        let legend = Legend::new(&insight, TraversalKind::Octants, None);
        let drawing = Drawing::new(&insight, &legend);
        let [black, yellow] = [[0, 0, 4], [252, 255, 164]];
        assert_eq!((drawing.size, &drawing.pixels[..3]), ([400, 1], &black[..]));
        assert_eq!(drawing.pixels[3 * 49..3 * 50], yellow);
        assert_eq!(drawing.pixels[3 * 7..3 * 8], [64; 3]);

        let with = drawing.clone().with(&legend);
        assert_eq!(with.pixels[..drawing.pixels.len()], drawing.pixels);
        assert_eq!(with.pixels.len(), 3 * (with.size[0] * with.size[1]) as usize);
        let below: Vec<[u8; 3]> = with.pixels[drawing.pixels.len()..].as_chunks().0.to_vec();
        // The bar begins and ends with the ends of the map.
        let bar = below
            .iter()
            .filter(|color| **color == black || **color == yellow)
            .count();
        assert!(bar >= 26, "{bar}");
        assert!(below.contains(&[250; 3]), "there are letters");
    }
}
