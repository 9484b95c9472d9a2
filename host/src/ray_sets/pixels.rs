//! In which order rays go through the pixels of a picture.

use glam::{UVec2, uvec2};

/// Edge of a tile, pixels.
const TILE: u32 = 8;

/// Row by row from the upper left.
pub fn rows(size: UVec2) -> Vec<UVec2> {
    (0..size.y)
        .flat_map(|y| (0..size.x).map(move |x| uvec2(x, y)))
        .collect()
}

/// Tile by tile, row by row from the upper left, along a Z-order curve (Morton 1966) inside each: 8 pixels in a row are
/// then 4 x 2, and 16 are 4 x 4. What lies outside the picture is left out.
pub fn tiles(size: UVec2) -> Vec<UVec2> {
    let across = size.x.div_ceil(TILE);
    let down = size.y.div_ceil(TILE);
    let inside = move |corner: UVec2| {
        (0..TILE * TILE)
            .map(move |place| corner + uvec2(even_bits(place), even_bits(place >> 1)))
            .filter(move |pixel| pixel.x < size.x && pixel.y < size.y)
    };
    (0..down)
        .flat_map(|y| (0..across).map(move |x| uvec2(x, y) * TILE))
        .flat_map(inside)
        .collect()
}

/// Bits 0, 2 and 4 of a number, side by side.
fn even_bits(number: u32) -> u32 {
    number & 1 | number >> 1 & 2 | number >> 2 & 4
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn each_pixel_once() {
        for size in [uvec2(1, 1), uvec2(8, 8), uvec2(13, 21)] {
            for order in [rows, tiles] {
                let pixels = order(size);
                let different: HashSet<_> = pixels.iter().map(|pixel| pixel.to_array()).collect();
                assert_eq!(
                    (pixels.len(), different.len()),
                    ((size.x * size.y) as usize, pixels.len())
                );
                assert!(pixels.iter().all(|pixel| pixel.cmplt(size).all()));
            }
        }
        assert_eq!(rows(uvec2(2, 2)), [uvec2(0, 0), uvec2(1, 0), uvec2(0, 1), uvec2(1, 1)]);
    }

    #[test]
    fn eight_in_a_row_are_a_block() {
        for (block, pixels) in tiles(uvec2(24, 16)).chunks(8).enumerate() {
            let low = pixels.iter().copied().reduce(UVec2::min).unwrap_or_default();
            let high = pixels.iter().copied().reduce(UVec2::max).unwrap_or_default();
            assert_eq!(high - low, uvec2(3, 1), "{block}");
        }
    }
}
