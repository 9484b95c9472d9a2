//! What surfaces are made of.

use super::color::Radiance;
use super::color::Reflectance;
use super::fault::{Fault, Reason};
use super::number::{Exponent, Height, Ior, Part, Priority};
use super::place::Place;
use super::texture::Textures;
use crate::model::{CLAY, plain_material, retextured};
use glam::Vec3;
use oktant_shared::material::{self, FRESNEL, PHONG_HIGHLIGHTS, SMOOTH_NORMALS, VERTEX_COLORS};
use oktant_shared::texture::NO_TEXTURE;
use serde::Deserialize;
use std::collections::BTreeMap;

/// `[materials.NAME]`: a material. Of each channel, `diffuse * base + mirror + transmission` must not exceed 1.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Material {
    /// Colour of the surface under white light. Default: 1.
    pub base: Option<Reflectance>,
    /// Part of the base colour that answers ambient light, 0 to 1. Default: what mirror and transmission leave.
    pub ambient: Option<Part>,
    /// Part of the base colour that reflects light evenly, 0 to 1. Default: 0.85 of what mirror and transmission leave.
    pub diffuse: Option<Part>,
    /// Colour of the highlight. Default: 0.22.
    pub specular: Option<Reflectance>,
    /// Exponent of the highlight, 0 (none), or 1 (wide) to 1e6 (tiny). Default: 40.
    pub exponent: Option<Exponent>,
    /// How the highlight is computed: "blinn" or "phong". Default: "blinn".
    pub highlight: Highlight,
    /// What part of the light is mirrored. Default: 0.
    pub mirror: Option<Reflectance>,
    /// What part of the light goes through. Default: 0.
    pub transmission: Option<Reflectance>,
    /// Index of refraction, 0.1 to 10. Default: 1.5.
    pub ior: Option<Ior>,
    /// What the material absorbs of the light inside of it, per scene unit, 0 and up: after a way `s`, the part
    /// `exp(-absorption * s)` is left. Default: 0.
    pub absorption: Option<Radiance>,
    /// Where transmissive materials overlap, the one with the highest priority is what is there, 0 to 1000000. Default: 0.
    pub priority: Option<Priority>,
    /// Whether the angle decides how much of the transmission, or of an opaque material's mirror, is reflected. Default:
    /// true where there is transmission.
    pub fresnel: Option<bool>,
    /// Name of the texture that the base colour is multiplied with. Default: none.
    pub texture: Option<String>,
    /// Name of the texture that says how high the surface is. Default: none.
    pub bump: Option<String>,
    /// What heights of 1 (white) in the bump texture stand for, scene units; negative makes dents. Default: 0.05.
    pub bump_height: Option<Height>,
    /// Whether the base colour is multiplied with the colours of meshes that have some. Default: true.
    pub vertex_colors: Option<bool>,
    /// Whether normals are interpolated between the vertices. Default: true.
    pub smooth: Option<bool>,
}

/// How highlights are computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Highlight {
    /// With the vector half-way between light and viewer.
    #[default]
    Blinn,
    /// About the reflected direction.
    Phong,
}

/// Roundings of colours that add up to 1.
const TOLERANCE: f32 = 1e-4;

impl Material {
    /// The material as the kernel reads it.
    fn build(&self, place: &Place, textures: &Textures) -> Result<material::Material, Fault> {
        let plain = plain_material();
        let color = |given: Option<Reflectance>, otherwise| given.map_or(otherwise, |color| color.0);
        let mirror = color(self.mirror, Vec3::ZERO);
        let transmission = color(self.transmission, Vec3::ZERO);
        let rest = (1.0 - (mirror + transmission).max_element()).max(0.0);
        let base = color(self.base, Vec3::ONE);
        let diffuse = self.diffuse.map_or(plain.diffuse * rest, |part| part.0);
        let parts = base * diffuse + mirror + transmission;
        let channels = ["red", "green", "blue"].into_iter().zip(parts.to_array());
        if let Some((channel, part)) = channels.into_iter().find(|(_, part)| *part > 1.0 + TOLERANCE) {
            return Err(Fault::new(place, Reason::Energy { part, channel }));
        }
        let texture = match &self.texture {
            Some(name) => textures.color_id(name, &place.key("texture"))?,
            None => NO_TEXTURE,
        };
        let bump = match &self.bump {
            Some(name) => textures.height_id(name, &place.key("bump"))?,
            None => NO_TEXTURE,
        };
        let flag = |is_set: bool, flag: u32| if is_set { flag } else { 0 };
        Ok(material::Material {
            base,
            ambient: self.ambient.map_or(rest, |part| part.0),
            specular: color(self.specular, plain.specular),
            exponent: self.exponent.map_or(plain.exponent, |exponent| exponent.0),
            mirror,
            diffuse,
            transmission,
            ior: self.ior.map_or(1.5, |ior| ior.0),
            absorption: self.absorption.map_or(Vec3::ZERO, |color| color.0),
            priority: self.priority.map_or(0, |priority| priority.0),
            texture,
            bump,
            bump_height: self.bump_height.map_or(0.05, |height| height.0),
            flags: flag(self.vertex_colors.unwrap_or(true), VERTEX_COLORS)
                | flag(self.smooth.unwrap_or(true), SMOOTH_NORMALS)
                | flag(self.highlight == Highlight::Phong, PHONG_HIGHLIGHTS)
                | flag(self.fresnel.unwrap_or(transmission != Vec3::ZERO), FRESNEL),
        })
    }
}

/// The materials of a scene.
pub struct Palette {
    /// All that the file describes.
    named: BTreeMap<String, material::Material>,
    /// Those that something is made of, with their names; none for clay, and for what has colours of its own.
    used: Vec<(Option<String>, material::Material)>,
}

impl Palette {
    /// The materials of a file.
    pub fn new(materials: &BTreeMap<String, Material>, textures: &Textures) -> Result<Self, Fault> {
        let build = |(name, material): (&String, &Material)| {
            let place = Place::of("materials").key(name);
            Ok((name.clone(), material.build(&place, textures)?))
        };
        Ok(Palette {
            named: materials.iter().map(build).collect::<Result<_, Fault>>()?,
            used: Vec::new(),
        })
    }

    /// The index of the material that a field at a place names; of clay where it names none, or of white for a mesh that
    /// has colours.
    pub fn id(&mut self, name: Option<&str>, has_colors: bool, place: &Place) -> Result<u32, Fault> {
        let material = match name {
            Some(name) => *self.named.get(name).ok_or_else(|| {
                let reason = Reason::UnknownName {
                    name: name.into(),
                    what: "material",
                    valid: self.named.keys().cloned().collect(),
                };
                Fault::new(place, reason)
            })?,
            None => material::Material {
                base: if has_colors { Vec3::ONE } else { CLAY },
                ..plain_material()
            },
        };
        let known =
            |(other, same): &(Option<String>, material::Material)| other.as_deref() == name && *same == material;
        let id = self.used.iter().position(known).unwrap_or_else(|| {
            self.used.push((name.map(String::from), material));
            self.used.len() - 1
        });
        Ok(id as u32)
    }

    /// Adds a material of a mesh, with the name that its file gives it, whose textures begin with the index `first`; returns
    /// its index.
    pub fn add_own(&mut self, name: Option<&str>, material: &material::Material, first: u32) -> u32 {
        self.used.push((name.map(String::from), retextured(material, first)));
        self.used.len() as u32 - 1
    }

    /// A used material.
    pub fn get(&self, id: u32) -> &material::Material {
        &self.used[id as usize].1
    }

    /// The name of a used material.
    pub fn name(&self, id: u32) -> &str {
        self.used[id as usize].0.as_deref().unwrap_or("clay")
    }

    /// The used materials by index.
    pub fn into_used(self) -> Vec<(Option<String>, material::Material)> {
        self.used
    }
}
