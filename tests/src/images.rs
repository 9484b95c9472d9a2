//! Comparing a picture with one in a file.

use image::{Rgb, RgbImage};
use std::path::Path;

/// How far a picture may be from the one in a file.
pub struct Tolerance {
    /// A channel may be off by so many of 255.
    pub step: u8,
    /// Pixels that may be off by more, as a part of all.
    pub outliers: f64,
}

/// Another CPU has another power function, whose last bit may turn a rounding, or a ray at an edge.
pub const CPU: Tolerance = Tolerance {
    step: 1,
    outliers: 5e-4,
};

/// Compares a picture with the one in a file; what is wrong, if anything is. Then `target/goldens` has a picture of
/// expected, actual and difference side by side.
///
/// # Panics
/// Where that cannot be written.
pub fn difference(expected: &Path, actual: &RgbImage, tolerance: &Tolerance, who: &str) -> Option<String> {
    let name = expected.file_stem().unwrap_or_default().to_string_lossy();
    match image::open(expected) {
        Ok(image) => compared(&name, &image.to_rgb8(), actual, tolerance, who),
        Err(error) => Some(format!("{}: {error}", expected.display())),
    }
}

/// As [`difference`], with a picture that is there already.
///
/// # Panics
/// As [`difference`].
pub fn compared(name: &str, wanted: &RgbImage, actual: &RgbImage, tolerance: &Tolerance, who: &str) -> Option<String> {
    if wanted.dimensions() != actual.dimensions() {
        let (is, wants) = (actual.dimensions(), wanted.dimensions());
        return Some(format!("{name} on {who} has {is:?} pixels instead of {wants:?}"));
    }
    let part = outliers(wanted, actual, tolerance.step);
    println!(
        "{name} on {who}: {:.3} % of the pixels off by more than {}",
        part * 100.0,
        tolerance.step
    );
    if part <= tolerance.outliers {
        return None;
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../target/goldens");
    std::fs::create_dir_all(&folder).expect("target can be written");
    let shown = folder.join(format!("{name}-{who}.png"));
    side_by_side(wanted, actual)
        .save(&shown)
        .expect("target can be written");
    Some(format!(
        "{name} on {who}: {:.3} % of the pixels are off, see {}",
        part * 100.0,
        shown.display()
    ))
}

/// Part of the pixels in which a channel is off by more than a step; the pictures have the same size.
fn outliers(expected: &RgbImage, actual: &RgbImage, step: u8) -> f64 {
    let off = |(a, b): (&Rgb<u8>, &Rgb<u8>)| a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > step);
    let count = expected.pixels().zip(actual.pixels()).filter(|pair| off(*pair)).count();
    count as f64 / f64::from(expected.width() * expected.height())
}

/// Expected, actual and eight times the difference, side by side.
fn side_by_side(expected: &RgbImage, actual: &RgbImage) -> RgbImage {
    let (width, height) = expected.dimensions();
    RgbImage::from_fn(width * 3, height, |x, y| {
        let (a, b) = (expected.get_pixel(x % width, y), actual.get_pixel(x % width, y));
        match x / width {
            0 => *a,
            1 => *b,
            _ => Rgb(std::array::from_fn(|i| a.0[i].abs_diff(b.0[i]).saturating_mul(8))),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_comparison_can_fail() {
        let expected = RgbImage::from_fn(320, 242, |x, y| Rgb([x as u8, y as u8, 7]));
        assert_eq!(outliers(&expected, &expected, 0), 0.0);
        let mut actual = expected.clone();
        actual.put_pixel(5, 6, Rgb([5, 6, 10]));
        assert_eq!(outliers(&expected, &actual, 3), 0.0);
        assert_eq!(outliers(&expected, &actual, 2), 1.0 / (320.0 * 242.0));
        let shown = side_by_side(&expected, &actual);
        assert_eq!(shown.dimensions(), (320 * 3, 242));
        assert_eq!(*shown.get_pixel(320 * 2 + 5, 6), Rgb([0, 0, 24]));
        assert_eq!(*shown.get_pixel(320 * 2 + 6, 6), Rgb([0, 0, 0]));
    }

    #[test]
    fn a_picture_of_another_size_is_another() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.png");
        RgbImage::new(2, 3).save(&path).unwrap();
        assert_eq!(difference(&path, &RgbImage::new(2, 3), &CPU, "test"), None);
        assert!(difference(&path, &RgbImage::new(3, 2), &CPU, "test").is_some());
    }
}
