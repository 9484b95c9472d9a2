//! How series look.

/// Red, green and blue.
pub(super) type Color = [u8; 3];

pub(super) const WHITE: Color = [255, 255, 255];
pub(super) const BLACK: Color = [17, 17, 17];
/// Of text that is not read first.
pub(super) const GRAY: Color = [95, 95, 95];
/// Of lines that lead.
pub(super) const PALE: Color = [165, 165, 165];
/// Of lines behind everything.
pub(super) const FAINT: Color = [232, 232, 232];

/// Sizes of letters: of names, and of all that is small.
pub(super) const TEXT: f64 = 12.0;
pub(super) const SMALL: f64 = 10.5;

/// Told apart with any colour vision: Okabe and Ito 2008, without their yellow, which is too pale for lines on white.
const COLORS: [Color; 7] = [
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [204, 121, 167],
    [86, 180, 233],
    [230, 159, 0],
    [60, 60, 60],
];

/// Corners of markers as directions in twelfths of a turn from the right, clockwise, and how far out they are.
type Corners = &'static [(f64, f64)];

const MARKERS: [Corners; 9] = [
    // Disc.
    &[
        (0.0, 1.0),
        (1.0, 1.0),
        (2.0, 1.0),
        (3.0, 1.0),
        (4.0, 1.0),
        (5.0, 1.0),
        (6.0, 1.0),
        (7.0, 1.0),
        (8.0, 1.0),
        (9.0, 1.0),
        (10.0, 1.0),
        (11.0, 1.0),
    ],
    // Square.
    &[(1.5, 1.25), (4.5, 1.25), (7.5, 1.25), (10.5, 1.25)],
    // Triangle, upwards.
    &[(1.0, 1.3), (5.0, 1.3), (9.0, 1.3)],
    // Diamond.
    &[(0.0, 1.3), (3.0, 1.3), (6.0, 1.3), (9.0, 1.3)],
    // Triangle, downwards.
    &[(3.0, 1.3), (7.0, 1.3), (11.0, 1.3)],
    // Star.
    &[
        (9.0, 1.5),
        (10.2, 0.65),
        (11.4, 1.5),
        (0.6, 0.65),
        (1.8, 1.5),
        (3.0, 0.65),
        (4.2, 1.5),
        (5.4, 0.65),
        (6.6, 1.5),
        (7.8, 0.65),
    ],
    // Cross.
    &[
        (0.6, 1.35),
        (1.5, 0.6),
        (2.4, 1.35),
        (3.6, 1.35),
        (4.5, 0.6),
        (5.4, 1.35),
        (6.6, 1.35),
        (7.5, 0.6),
        (8.4, 1.35),
        (9.6, 1.35),
        (10.5, 0.6),
        (11.4, 1.35),
    ],
    // Triangle to the right.
    &[(0.0, 1.3), (4.0, 1.3), (8.0, 1.3)],
    // Triangle to the left.
    &[(2.0, 1.3), (6.0, 1.3), (10.0, 1.3)],
];

/// How a series looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Style {
    pub color: Color,
    corners: Corners,
}

impl Style {
    /// Of the series in this place; 63 look different.
    pub fn of(index: usize) -> Self {
        Style {
            color: COLORS[index % COLORS.len()],
            corners: MARKERS[index % MARKERS.len()],
        }
    }

    /// The corners of its marker, this far around a point.
    pub fn marker(&self, [x, y]: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
        let corner = |&(twelfths, away): &(f64, f64)| {
            let (sine, cosine) = (twelfths * std::f64::consts::PI / 6.0).sin_cos();
            [x + cosine * away * radius, y + sine * away * radius]
        };
        self.corners.iter().map(corner).collect()
    }
}

/// Corners of a ring.
pub(super) fn ring([x, y]: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
    let corner = |step: u32| {
        let (sine, cosine) = (f64::from(step) * std::f64::consts::PI / 16.0).sin_cos();
        [x + cosine * radius, y + sine * radius]
    };
    (0..=32).map(corner).collect()
}

/// A colour as it is where something else is better: mostly grey.
pub(super) fn greyed(color: Color) -> Color {
    color.map(|channel| ((f64::from(channel) * 0.25) + 205.0 * 0.75) as u8)
}
