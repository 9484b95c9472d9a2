//! Figures of pictures whose differences are known beforehand. What other programs say is in the crate `oktant-tests`.

use super::*;
use image::{Rgb, RgbImage as Picture};
use std::path::Path;

fn shot(picture: &Picture) -> Shot {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("shot.png");
    picture.save(&path).unwrap();
    Shot::read(&path).unwrap()
}

fn compared(wanted: &Picture, is: &Picture, step: f32) -> Comparison {
    compare(&shot(wanted), &shot(is), step).unwrap().0
}

/// Waves of grey.
fn waves(shift: u32) -> Picture {
    Picture::from_fn(80, 60, |x, y| {
        let wave = ((x + shift) as f32 * 0.4).sin() * ((y as f32) * 0.3).cos();
        Rgb([(127.5 + 100.0 * wave) as u8; 3])
    })
}

#[test]
fn a_picture_is_like_itself() {
    let comparison = compared(&waves(0), &waves(0), 0.0);
    assert_eq!((comparison.rmse, comparison.psnr), (0.0, f64::INFINITY));
    assert_eq!((comparison.flip.mean, comparison.flip.largest), (0.0, 0.0));
    assert_eq!((comparison.differing, comparison.largest), (0, 0.0));
    assert!((comparison.ssim - 1.0).abs() < 1e-12, "{}", comparison.ssim);
}

#[test]
fn a_shifted_picture_is_another() {
    let one = compared(&waves(0), &waves(1), 0.0);
    let three = compared(&waves(0), &waves(3), 0.0);
    assert!(one.flip.mean > 0.01 && one.ssim < 0.99 && one.differing > 4_000);
    assert!(three.flip.mean > one.flip.mean && three.ssim < one.ssim);
    assert!(three.rmse > one.rmse && three.psnr < one.psnr);
    assert!(one.flip.mean < f64::from(one.flip.percentile_99) && one.flip.percentile_99 <= one.flip.largest);
}

#[test]
fn noise_of_known_size_is_measured() {
    // Up and down by 10 of 255 in turn: the error of colours is 10 / 255 everywhere.
    let grey = Picture::from_pixel(40, 40, Rgb([100; 3]));
    let noise = Picture::from_fn(40, 40, |x, y| Rgb([if (x + y) % 2 == 0 { 110 } else { 90 }; 3]));
    let comparison = compared(&grey, &noise, 0.0);
    assert!(
        (comparison.psnr - 20.0 * 25.5_f64.log10()).abs() < 1e-4,
        "{}",
        comparison.psnr
    );
    assert!((comparison.largest - 10.0).abs() < 1e-4);
    let light = |byte: f64| ((byte / 255.0 + 0.055) / 1.055).powf(2.4);
    let errors = [light(110.0) - light(100.0), light(100.0) - light(90.0)];
    let rmse = ((errors[0].powi(2) + errors[1].powi(2)) / 2.0).sqrt();
    assert!((comparison.rmse - rmse).abs() < 1e-6, "{} {rmse}", comparison.rmse);
    assert_eq!(comparison.differing, 1600);
    assert_eq!(compared(&grey, &noise, 9.0).differing, 1600);
    assert_eq!(compared(&grey, &noise, 10.0).differing, 0);
}

#[test]
fn pixels_that_differ_are_counted() {
    let mut other = waves(0);
    for (x, y) in [(3, 4), (70, 50)] {
        other.get_pixel_mut(x, y).0[1] ^= 1;
    }
    let comparison = compared(&waves(0), &other, 0.0);
    assert_eq!(comparison.differing, 2);
    assert!((comparison.largest - 1.0).abs() < 1e-4);
    assert_eq!(compared(&waves(0), &other, 1.0).differing, 0);
}

#[test]
fn similarity_of_flat_pictures_is_that_of_their_means() {
    let flat = |byte| Picture::from_pixel(20, 20, Rgb([byte; 3]));
    let (a, b) = (51.0 / 255.0, 153.0 / 255.0);
    let wanted = (2.0 * a * b + 1e-4) / (a * a + b * b + 1e-4);
    assert!((compared(&flat(51), &flat(153), 0.0).ssim - wanted).abs() < 1e-6);
    // Also of pictures that are narrower than the window.
    let narrow = |byte| Picture::from_pixel(2, 1, Rgb([byte; 3]));
    assert!((compared(&narrow(51), &narrow(153), 0.0).ssim - wanted).abs() < 1e-6);
}

#[test]
fn pictures_of_the_difference_say_where_and_in_which_direction() {
    let grey = Picture::from_pixel(30, 30, Rgb([100; 3]));
    let mut other = grey.clone();
    other.put_pixel(5, 5, Rgb([110, 100, 90]));
    let (wanted, is) = (shot(&grey), shot(&other));
    let (_, map) = compare(&wanted, &is, 0.0).unwrap();
    let at = |x: usize, y: usize, picture: &[u8]| <[u8; 3]>::try_from(&picture[3 * (30 * y + x)..][..3]).unwrap();
    let signed = difference_picture(DifferenceKind::Signed, &wanted, &is, &map);
    assert_eq!((at(5, 5, &signed), at(6, 5, &signed)), ([168, 128, 88], [128; 3]));
    let flip = difference_picture(DifferenceKind::Flip, &wanted, &is, &map);
    let black = colorous::MAGMA.eval_continuous(0.0).as_array();
    assert_eq!(at(29, 29, &flip), black);
    assert_ne!(at(5, 5, &flip), black);
}

#[test]
fn what_cannot_be_compared_is_told() {
    let error = compare(&shot(&Picture::new(2, 3)), &shot(&Picture::new(3, 2)), 0.0).unwrap_err();
    assert_eq!(
        error.to_string(),
        "The pictures differ in size, 2x3 and 3x2 pixels; render them in the same size."
    );
    let folder = tempfile::tempdir().unwrap();
    let told = |name: &str, content: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, content).unwrap();
        let sentence = Shot::read(&path).unwrap_err().to_string();
        sentence.replace(&*folder.path().to_string_lossy(), "")
    };
    assert!(told("a.png", b"nothing").contains("neither a PNG nor an EXR file"));
    assert!(told("b.png", b"\x89PNG\r\n\x1a\nabc").contains("cannot be decoded"));
    assert!(matches!(
        Shot::read(Path::new("missing.png")),
        Err(ShotFault::Missing(_))
    ));
    assert!(matches!(Shot::read(folder.path()), Err(ShotFault::Unreadable { .. })));
    let path = folder.path().join("nan.exr");
    let mut light = image::Rgb32FImage::new(3, 2);
    light.put_pixel(1, 1, Rgb([0.0, f32::NAN, 0.0]));
    light.save(&path).unwrap();
    assert!(matches!(
        Shot::read(&path),
        Err(ShotFault::NotFinite { x: 1, y: 1, .. })
    ));
}
