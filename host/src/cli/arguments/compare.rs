//! What `oktant compare` takes.

use clap::Args;
use oktant::compare::DifferenceKind;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct CompareArguments {
    /// The picture as it should be, a PNG or EXR file.
    #[arg(value_name = "A")]
    pub wanted: PathBuf,
    /// The picture as it is, a PNG or EXR file.
    #[arg(value_name = "B")]
    pub is: PathBuf,
    /// Write a picture of the difference; docs/compare.md describes it. An existing file is replaced.
    #[arg(short, long, value_name = "OUT.png")]
    pub output: Option<PathBuf>,
    /// What that picture shows.
    #[arg(long, value_enum, default_value = "flip", requires = "output")]
    pub show: DifferenceKind,
    /// A pixel differs where a channel's colour is off by more than so many of 255, 0 to 255; with 0, where its light is not the same.
    #[arg(long, value_name = "N", default_value_t = 0.0, value_parser = step)]
    pub step: f32,
    /// Print the figures as JSON.
    #[arg(long)]
    pub json: bool,
    /// Fail where the light's root mean square error is greater, 0 or more.
    #[arg(long, value_name = "X", value_parser = limit)]
    pub max_rmse: Option<f64>,
    /// Fail where the mean of FLIP is greater, 0 to 1.
    #[arg(long, value_name = "X", value_parser = limit)]
    pub max_flip: Option<f64>,
    /// Fail where more than a hundredth of the pixels have a FLIP that is greater, 0 to 1.
    #[arg(long, value_name = "X", value_parser = limit)]
    pub max_flip_99: Option<f64>,
    /// Fail where more pixels differ.
    #[arg(long, value_name = "PIXELS")]
    pub max_differing: Option<u64>,
    /// Fail where the structural similarity is less, at most 1.
    #[arg(long, value_name = "X", value_parser = limit)]
    pub min_ssim: Option<f64>,
    /// Fail where the peak signal-to-noise ratio is less, decibels.
    #[arg(long, value_name = "DB", value_parser = limit)]
    pub min_psnr: Option<f64>,
}

fn step(text: &str) -> Result<f32, String> {
    match text.trim().parse::<f32>() {
        Ok(step) if (0.0..=255.0).contains(&step) => Ok(step),
        _ => Err("give a number from 0 to 255".into()),
    }
}

fn limit(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(limit) if limit >= 0.0 && limit.is_finite() => Ok(limit),
        _ => Err("give a number, 0 or more".into()),
    }
}
