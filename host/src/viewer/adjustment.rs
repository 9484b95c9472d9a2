//! What can be given a value: by the panel, and by the step `set` of a script, which writes it with the names and values of the
//! command line.

mod kernel;
mod light;
mod material;
mod named;
mod picture;
mod surroundings;
mod value;

pub use kernel::{KernelAdjustment, box_tests, triangle_tests};
pub use light::{LightAdjustment, hue};
pub use material::{MaterialAdjustment, SWITCHES};
pub use named::NamedMaterial;
pub use picture::{BLOCKS, PictureAdjustment, STEREO, stereo_name};
pub use surroundings::SurroundingsAdjustment;

use super::grammar::{split, unknown};

/// Something with its new value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Adjustment {
    /// How the picture is taken and shown.
    Picture(PictureAdjustment),
    /// What renders and what rays are traced through.
    Kernel(KernelAdjustment),
    /// A light, by its number.
    Light(usize, LightAdjustment),
    /// What surfaces are made of, by the material's number.
    Material(usize, MaterialAdjustment),
    /// What is around.
    Environment(SurroundingsAdjustment),
}

/// What has settings of its own.
const PARTS: [&str; 3] = ["light", "material", "environment"];

impl Adjustment {
    /// What `NAME VALUE` means; else what is wrong with it and what to do.
    pub fn parse(text: &str) -> Result<Self, String> {
        let (name, rest) = split(text);
        match name {
            "light" => {
                let (index, name, value) = numbered(name, rest)?;
                Ok(Adjustment::Light(index, LightAdjustment::parse(name, value)?))
            }
            "material" => {
                let (index, name, value) = numbered(name, rest)?;
                Ok(Adjustment::Material(index, MaterialAdjustment::parse(name, value)?))
            }
            "environment" => {
                let (name, value) = split(rest);
                SurroundingsAdjustment::parse(name, value).map(Adjustment::Environment)
            }
            _ if PictureAdjustment::NAMES.contains(&name) => {
                PictureAdjustment::parse(name, rest).map(Adjustment::Picture)
            }
            _ if KernelAdjustment::NAMES.contains(&name) => KernelAdjustment::parse(name, rest).map(Adjustment::Kernel),
            _ => {
                let names = [&PictureAdjustment::NAMES[..], &KernelAdjustment::NAMES, &PARTS];
                Err(unknown(name, "setting", &names.concat()))
            }
        }
    }
}

/// The number of one of many things, the name of something about it, and its value.
fn numbered<'a>(what: &str, text: &'a str) -> Result<(usize, &'a str, &'a str), String> {
    let (number, rest) = split(text);
    let index = number
        .parse()
        .map_err(|_| format!("give the number of the {what}, counted from 0, for example: set {what} 0"))?;
    let (name, value) = split(rest);
    Ok((index, name, value))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn names_lead_to_what_they_are_about() {
        assert_eq!(
            Adjustment::parse("material 2 mirror 0.5"),
            Ok(Adjustment::Material(2, MaterialAdjustment::Mirror(Vec3::splat(0.5))))
        );
        assert_eq!(
            Adjustment::parse("light 1 range 3"),
            Ok(Adjustment::Light(1, LightAdjustment::Range(3.0)))
        );
        assert_eq!(
            Adjustment::parse("environment zenith 0,0,1"),
            Ok(Adjustment::Environment(SurroundingsAdjustment::Zenith(Vec3::Z)))
        );
        for (text, wanted) in [
            ("sampels 4", "did you mean \"samples\""),
            ("traversl bvh2", "did you mean \"traversal\""),
            ("ligth 0 range 3", "did you mean \"light\""),
            ("material mirror 0.5", "give the number of the material"),
            ("light 0", "give one of color"),
            ("environment", "give one of color"),
            ("", "give one of samples"),
        ] {
            let error = Adjustment::parse(text).unwrap_err();
            assert!(error.contains(wanted), "{text}: {error}");
        }
    }
}
