//! `oktant compare`.

use super::Failure;
use super::arguments::CompareArguments;
use super::render::counted;
use oktant::compare::{Comparison, Shot, compare, difference_picture};
use oktant::output::PictureFile;

/// Compares two pictures; fails where a figure is beyond its limit.
pub fn run(arguments: &CompareArguments) -> Result<(), Failure> {
    if let Some(path) = &arguments.output
        && path.extension().is_none_or(|end| !end.eq_ignore_ascii_case("png"))
    {
        return Err(Failure::usage(format!(
            "{}: the picture of the difference is a PNG file; give it a name that ends in .png.",
            path.display()
        )));
    }
    let output = arguments.output.as_deref().map(PictureFile::create).transpose()?;
    let wanted = Shot::read(&arguments.wanted)?;
    let is = Shot::read(&arguments.is)?;
    let (comparison, map) = compare(&wanted, &is, arguments.step)?;
    if let Some(output) = output {
        output.save_rgb8(&difference_picture(arguments.show, &wanted, &is, &map), is.size())?;
    }
    super::print(&if arguments.json {
        format!("{}\n", serde_json::to_string(&comparison)?)
    } else {
        told(&comparison)
    })?;
    let beyond = limits(arguments, &comparison);
    if beyond.is_empty() {
        Ok(())
    } else {
        Err(Failure {
            sentence: format!(
                "{} is not like {}: {}.",
                arguments.is.display(),
                arguments.wanted.display(),
                beyond.join(", ")
            ),
            code: 1,
        })
    }
}

fn told(comparison: &Comparison) -> String {
    let Comparison {
        width, height, flip, ..
    } = comparison;
    let pixels = *width as usize * *height as usize;
    let differing = if comparison.step > 0.0 {
        format!("by more than {} of 255", comparison.step)
    } else {
        "at all".into()
    };
    format!(
        "RMSE            {:.6} (light)\n\
         PSNR            {:.2} dB\n\
         SSIM            {:.6}\n\
         FLIP            mean {:.6}, 99 % up to {:.6}, greatest {:.6} ({:.2} pixels per degree)\n\
         differ {differing}: {} of {width}x{height} ({:.4} %), the most by {:.2} of 255\n",
        comparison.rmse,
        comparison.psnr,
        comparison.ssim,
        flip.mean,
        flip.percentile_99,
        flip.largest,
        flip.pixels_per_degree,
        counted(comparison.differing, "pixel"),
        100.0 * comparison.differing as f64 / pixels as f64,
        comparison.largest,
    )
}

/// What is beyond its limit, and by which option.
fn limits(arguments: &CompareArguments, comparison: &Comparison) -> Vec<String> {
    let flip = &comparison.flip;
    let most = [
        ("the RMSE", comparison.rmse, "--max-rmse", arguments.max_rmse),
        ("the mean of FLIP", flip.mean, "--max-flip", arguments.max_flip),
        (
            "FLIP's 99th percentile",
            f64::from(flip.percentile_99),
            "--max-flip-99",
            arguments.max_flip_99,
        ),
    ];
    let least = [
        ("the SSIM", comparison.ssim, "--min-ssim", arguments.min_ssim),
        ("the PSNR", comparison.psnr, "--min-psnr", arguments.min_psnr),
    ];
    let above = most.into_iter().filter_map(|(what, is, option, limit)| {
        let limit = limit.filter(|limit| is > *limit)?;
        Some(format!("{what} is {is:.6}, above {option} {limit}"))
    });
    let below = least.into_iter().filter_map(|(what, is, option, limit)| {
        let limit = limit.filter(|limit| is < *limit)?;
        Some(format!("{what} is {is:.6}, below {option} {limit}"))
    });
    let mut beyond: Vec<String> = above.chain(below).collect();
    if let Some(limit) = arguments
        .max_differing
        .filter(|limit| comparison.differing as u64 > *limit)
    {
        let differ = counted(comparison.differing, "pixel");
        beyond.push(format!("{differ} differ, above --max-differing {limit}"));
    }
    beyond
}
