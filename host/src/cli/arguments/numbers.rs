//! Numbers on the command line, with their ranges.

use glam::Vec3;

fn number(text: &str, least: f32, greatest: f32, wanted: &str) -> Result<f32, String> {
    match text.trim().parse::<f32>() {
        Ok(value) if (least..=greatest).contains(&value) => Ok(value),
        _ => Err(wanted.into()),
    }
}

pub fn finite(text: &str) -> Result<f32, String> {
    number(text, -1e6, 1e6, "give a number of degrees")
}

pub fn elevation(text: &str) -> Result<f32, String> {
    number(text, -90.0, 90.0, "give a number of degrees from -90 to 90")
}

pub fn field_of_view(text: &str) -> Result<f32, String> {
    number(text, 1.0, 170.0, "give a number of degrees from 1 to 170")
}

pub fn offset(text: &str) -> Result<Vec3, String> {
    const WANTED: &str = "give three numbers of radii, for example 0,0.5,0";
    let numbers: Vec<f32> = text
        .split(',')
        .map(|part| number(part, -1e6, 1e6, WANTED))
        .collect::<Result<_, _>>()?;
    match numbers.as_slice() {
        [x, y, z] => Ok(Vec3::new(*x, *y, *z)),
        _ => Err(WANTED.into()),
    }
}

pub fn length(text: &str) -> Result<f32, String> {
    number(text, 1e-12, 1e12, "give a number of scene units above 0")
}

pub fn exposure(text: &str) -> Result<f32, String> {
    number(text, -30.0, 30.0, "give a number of stops from -30 to 30")
}

pub fn cutoff(text: &str) -> Result<f32, String> {
    number(text, 0.0, 255.0, "give a number of steps of 8 bits from 0 to 255")
}

pub fn tolerance(text: &str) -> Result<f32, String> {
    number(text, 1e-4, 1.0, "give a part of the output's range from 0.0001 to 1")
}

pub fn distance(text: &str) -> Result<f32, String> {
    number(text, 1e-3, 1e5, "give a number of radii from 0.001 to 100000")
}
