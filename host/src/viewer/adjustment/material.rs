//! What a surface is made of, under the names of scene files.

use super::value::{color, named, number};
use crate::scene_file::{Exponent, Height, Ior, Part, Priority, Radiance, Reflectance};
use crate::viewer::grammar::unknown;
use glam::Vec3;
use oktant_shared::material::{FRESNEL, Material, PHONG_HIGHLIGHTS, SMOOTH_NORMALS, VERTEX_COLORS};

/// Something about a material with its new value; units and ranges as in [`Material`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MaterialAdjustment {
    /// Colour of the surface.
    Base(Vec3),
    /// Part of it that answers ambient light.
    Ambient(f32),
    /// Part of it that reflects light evenly.
    Diffuse(f32),
    /// Colour of the highlight.
    Specular(Vec3),
    /// Exponent of the highlight.
    Exponent(f32),
    /// What part of the light is mirrored.
    Mirror(Vec3),
    /// What part of the light goes through.
    Transmission(Vec3),
    /// Index of refraction.
    Ior(f32),
    /// What is absorbed inside, per scene unit.
    Absorption(Vec3),
    /// Which material is there where several overlap.
    Priority(u32),
    /// Height of white in the bump texture, scene units.
    BumpHeight(f32),
    /// A bit of [`Material::flags`].
    Flag(u32, bool),
}

/// The switches of a material, by name: a bit of its flags, and what it is called when it is off and on.
pub const SWITCHES: [(&str, u32, [&str; 2]); 4] = [
    ("fresnel", FRESNEL, ["off", "on"]),
    ("highlight", PHONG_HIGHLIGHTS, ["blinn", "phong"]),
    ("smooth", SMOOTH_NORMALS, ["off", "on"]),
    ("vertex_colors", VERTEX_COLORS, ["off", "on"]),
];

impl MaterialAdjustment {
    /// The names, as in scene files.
    pub const NAMES: [&str; 15] = [
        "base",
        "ambient",
        "diffuse",
        "specular",
        "exponent",
        "mirror",
        "transmission",
        "ior",
        "absorption",
        "priority",
        "bump_height",
        "fresnel",
        "highlight",
        "smooth",
        "vertex_colors",
    ];

    /// What a name and a value mean.
    pub fn parse(name: &str, value: &str) -> Result<Self, String> {
        let reflectance = || color::<Reflectance>(value).map(|color| color.0);
        Ok(match name {
            "base" => Self::Base(reflectance()?),
            "ambient" => Self::Ambient(number::<Part>(value)?.0),
            "diffuse" => Self::Diffuse(number::<Part>(value)?.0),
            "specular" => Self::Specular(reflectance()?),
            "exponent" => Self::Exponent(number::<Exponent>(value)?.0),
            "mirror" => Self::Mirror(reflectance()?),
            "transmission" => Self::Transmission(reflectance()?),
            "ior" => Self::Ior(number::<Ior>(value)?.0),
            "absorption" => Self::Absorption(color::<Radiance>(value)?.0),
            "priority" => Self::Priority(number::<Priority>(value)?.0),
            "bump_height" => Self::BumpHeight(number::<Height>(value)?.0),
            _ => match SWITCHES.iter().find(|switch| switch.0 == name) {
                Some((_, bit, states)) => {
                    let is_on = named(value, "state", &[false, true], |is_on| {
                        states[usize::from(is_on)].into()
                    })?;
                    Self::Flag(*bit, is_on)
                }
                None => return Err(unknown(name, "setting of a material", &Self::NAMES)),
            },
        })
    }

    /// Gives a material the value. Light is conserved: what is mirrored takes from what goes through and the other way
    /// round, and even reflection has what both leave.
    pub fn apply(self, material: &mut Material) {
        match self {
            Self::Base(color) => material.base = color,
            Self::Ambient(part) => material.ambient = part,
            Self::Diffuse(part) => material.diffuse = part,
            Self::Specular(color) => material.specular = color,
            Self::Exponent(exponent) => material.exponent = exponent,
            Self::Mirror(part) => {
                material.mirror = part;
                material.transmission = material.transmission.min(Vec3::ONE - part);
            }
            Self::Transmission(part) => {
                material.transmission = part;
                material.mirror = material.mirror.min(Vec3::ONE - part);
            }
            Self::Ior(ior) => material.ior = ior,
            Self::Absorption(color) => material.absorption = color,
            Self::Priority(priority) => material.priority = priority,
            Self::BumpHeight(height) => material.bump_height = height,
            Self::Flag(bit, true) => material.flags |= bit,
            Self::Flag(bit, false) => material.flags &= !bit,
        }
        let rest = (Vec3::ONE - material.mirror - material.transmission).max(Vec3::ZERO);
        let channels = rest.to_array().into_iter().zip(material.base.to_array());
        let most = channels.filter(|(_, base)| *base > 0.0).map(|(rest, base)| rest / base);
        material.diffuse = most.fold(material.diffuse, f32::min);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plain_material;

    #[test]
    fn every_name_takes_a_value_and_refuses_others() {
        for name in MaterialAdjustment::NAMES {
            for bad in ["", "?", "1e30", "1,2", "-1e30"] {
                let error = MaterialAdjustment::parse(name, bad).unwrap_err();
                assert!(!error.contains("setting"), "{name} {bad}: {error}");
            }
        }
        for (name, value, wanted) in [
            ("base", "1,0,0.5", MaterialAdjustment::Base(Vec3::new(1.0, 0.0, 0.5))),
            ("mirror", "0.5", MaterialAdjustment::Mirror(Vec3::splat(0.5))),
            ("specular", "#fff", MaterialAdjustment::Specular(Vec3::ONE)),
            ("priority", "3", MaterialAdjustment::Priority(3)),
            ("fresnel", "on", MaterialAdjustment::Flag(FRESNEL, true)),
            ("highlight", "blinn", MaterialAdjustment::Flag(PHONG_HIGHLIGHTS, false)),
        ] {
            assert_eq!(MaterialAdjustment::parse(name, value), Ok(wanted));
        }
        let error = MaterialAdjustment::parse("miror", "1").unwrap_err();
        assert!(error.contains("did you mean \"mirror\""), "{error}");
    }

    #[test]
    fn no_surface_sends_more_light_than_it_gets() {
        let mut material = Material {
            diffuse: 1.0,
            ..plain_material()
        };
        let sent = |material: &Material| material.base * material.diffuse + material.mirror + material.transmission;
        for adjustment in [
            MaterialAdjustment::Mirror(Vec3::new(0.5, 0.25, 0.0)),
            MaterialAdjustment::Transmission(Vec3::splat(0.75)),
            MaterialAdjustment::Base(Vec3::new(0.0, 0.1, 1.0)),
            MaterialAdjustment::Diffuse(1.0),
            MaterialAdjustment::Mirror(Vec3::ONE),
            MaterialAdjustment::Diffuse(0.5),
        ] {
            adjustment.apply(&mut material);
            assert!(
                sent(&material).max_element() <= 1.0 + 1e-6,
                "{adjustment:?}: {material:?}"
            );
        }
        assert_eq!((material.mirror, material.transmission), (Vec3::ONE, Vec3::ZERO));
        MaterialAdjustment::Mirror(Vec3::splat(0.25)).apply(&mut material);
        MaterialAdjustment::Base(Vec3::splat(0.5)).apply(&mut material);
        MaterialAdjustment::Diffuse(1.0).apply(&mut material);
        assert_eq!(material.diffuse, 1.0, "0.5 and 0.25 are no more than 1");
    }
}
