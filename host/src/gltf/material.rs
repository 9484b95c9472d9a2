//! From metals and rough surfaces to Whitted's model. docs/files.md has the rule.

use super::document::{Document, Material, TextureReference, TextureTransform, get};
use super::fault::{Fault, Place};
use super::images::Images;
use super::notices::Notices;
use crate::asset::clay;
use glam::{DVec3, Vec2, vec2};
use oktant_shared::material::{FRESNEL, Material as Whitted, SMOOTH_NORMALS, VERTEX_COLORS};
use oktant_shared::texture::NO_TEXTURE;
use std::collections::HashMap;

/// Where the texture of a material lies on its surfaces.
#[derive(Clone, Copy, Default)]
pub(super) struct Placement {
    /// The set of texture coordinates.
    pub(super) set: Option<usize>,
    transform: TextureTransform,
}

impl Placement {
    fn new(reference: &TextureReference) -> Self {
        let transform = reference.extensions.transform.unwrap_or_default();
        Placement {
            set: Some(transform.tex_coord.unwrap_or(reference.tex_coord) as usize),
            transform,
        }
    }

    /// Where a point of the surface lies on the image, whose lower left corner is (0, 0), from coordinates that count from
    /// the upper left one; zero for each number that is not finite.
    pub(super) fn coordinate(&self, [u, v]: [f32; 2]) -> Vec2 {
        let TextureTransform {
            offset: [right, down],
            rotation,
            scale,
            ..
        } = self.transform;
        let [width, height] = scale.unwrap_or([1.0; 2]);
        let (u, v) = (f64::from(u) * width, f64::from(v) * height);
        let (sine, cosine) = rotation.sin_cos();
        let at = vec2(
            (u * cosine + v * sine + right) as f32,
            (1.0 - (v * cosine - u * sine + down)) as f32,
        );
        at.map(|number| if number.is_finite() { number } else { 0.0 })
    }
}

/// The materials that primitives have.
#[derive(Default)]
pub(super) struct Palette {
    /// As the kernel reads them.
    pub(super) materials: Vec<Whitted>,
    /// What the file calls them.
    pub(super) names: Vec<Option<String>>,
    placements: Vec<Placement>,
    ids: HashMap<Option<usize>, u32>,
}

impl Palette {
    /// The index of a material of the file, or of clay.
    pub(super) fn id(
        &mut self,
        document: &Document,
        material: Option<usize>,
        images: &mut Images<'_>,
        notices: &mut Notices,
    ) -> Result<u32, Fault> {
        if let Some(id) = self.ids.get(&material) {
            return Ok(*id);
        }
        let (name, whitted, placement) = match material {
            None => (None, clay(), Placement::default()),
            Some(id) => {
                let place = Place::of("materials", id);
                let material = get(&document.materials, "materials", id)?;
                let color = material.pbr_metallic_roughness.base_color_texture.as_ref();
                (
                    material.name.clone().filter(|name| !name.is_empty()),
                    whitted(material, &place, images, notices)?,
                    color.map_or(Placement::default(), Placement::new),
                )
            }
        };
        let id = self.materials.len() as u32;
        self.materials.push(whitted);
        self.names.push(name);
        self.placements.push(placement);
        self.ids.insert(material, id);
        Ok(id)
    }

    /// Where the texture of a material lies.
    pub(super) fn placement(&self, id: u32) -> &Placement {
        &self.placements[id as usize]
    }
}

/// Of the normals of a rough surface's facets, those count as a mirror that are tilted by no more than this, as a tangent:
/// 5.7 degrees, so that the image is blurred by 11.4.
const MIRROR_TILT: f64 = 0.1;

/// Smoother surfaces have highlights as if they were so rough; a point's mirror image would have no size.
const SMOOTHEST: f64 = 0.1;

/// Mirror images fainter than this are left out: no ray would be followed for them, and without them most scenes need no tree
/// of rays.
const FAINTEST: f64 = 1.0 / 512.0;

/// What `KHR_materials_ior` takes for glass and plastic, if nothing is said.
const USUAL_IOR: f64 = 1.5;

/// Rays that absorb more see nothing anyway.
const MOST_ABSORPTION: f64 = 1e9;

/// A material in Whitted's model.
fn whitted(
    material: &Material,
    place: &Place,
    images: &mut Images<'_>,
    notices: &mut Notices,
) -> Result<Whitted, Fault> {
    note(material, notices);
    let surface = &material.pbr_metallic_roughness;
    let extensions = &material.extensions;
    let [red, green, blue, alpha] = surface
        .base_color_factor
        .unwrap_or([1.0; 4])
        .map(|part| part.clamp(0.0, 1.0));
    let base = DVec3::new(red, green, blue);
    let (mut texture, mut color) = (NO_TEXTURE, base);
    if let Some(reference) = &surface.base_color_texture
        && let Some(colors) = images.colors(reference.index, notices)?
    {
        texture = colors.texture;
        color *= colors.mean.as_dvec3();
        if colors.has_alpha && is_transparent(material) {
            notices.add("the alpha of textures");
        }
    }
    let mut roughness = surface.roughness_factor.unwrap_or(1.0);
    let mut metallic = surface.metallic_factor.unwrap_or(1.0);
    if let Some(reference) = &surface.metallic_roughness_texture
        && let Some(mean) = images.surface(reference.index, notices)?
    {
        notices.add("the pattern of metallic-roughness textures, of which the mean is taken");
        roughness *= mean.roughness;
        metallic *= mean.metallic;
    }
    let (roughness, metallic) = (roughness.clamp(0.0, 1.0), metallic.clamp(0.0, 1.0));
    let transmitted = extensions
        .transmission
        .as_ref()
        .map_or(0.0, |it| it.transmission_factor)
        .clamp(0.0, 1.0);
    let ior = extensions.ior.as_ref().and_then(|it| it.ior).unwrap_or(USUAL_IOR);
    if ior != 0.0 && !(ior >= 1.0 && ior <= f64::from(f32::MAX)) {
        return Err(Fault::Value {
            place: place.field("extensions.KHR_materials_ior.ior"),
            value: ior,
            wanted: "0, or 1 and up",
        });
    }
    let volume = extensions
        .volume
        .as_ref()
        .filter(|volume| volume.thickness_factor > 0.0);
    let absorption = match volume {
        Some(volume) => absorption(volume.attenuation_distance, volume.attenuation_color, place)?,
        None => DVec3::ZERO,
    };

    // What a dielectric reflects where light falls straight on it. An index of 0 stands for that of a perfect mirror.
    let normal_reflectance = ((ior - 1.0) / (ior + 1.0)).powi(2);
    let mut dielectric = DVec3::splat(normal_reflectance);
    if let Some(specular) = &extensions.specular {
        let tint = DVec3::from_array(specular.specular_color_factor.unwrap_or([1.0; 3])).max(DVec3::ZERO);
        dielectric = (dielectric * tint).min(DVec3::ONE) * specular.specular_factor.unwrap_or(1.0).clamp(0.0, 1.0);
    }
    let alpha_squared = roughness.powi(4);
    let sharp = 1.0 / (1.0 + alpha_squared / (MIRROR_TILT * MIRROR_TILT));
    let highlight_squared = roughness.max(SMOOTHEST).powi(4);
    let (plastic, bends) = (1.0 - metallic, volume.is_some() && transmitted > 0.0);
    let reflected = dielectric * plastic + color * metallic;
    // Of what goes into a volume, Fresnel's equations say how much is reflected.
    let mirrored = dielectric * plastic * if bends { 1.0 - transmitted } else { 1.0 } + color * metallic;
    let mut mirror = mirrored * sharp;
    if mirror.max_element() < FAINTEST {
        mirror = DVec3::ZERO;
    }
    let mut transmission = color * (plastic * transmitted) * if bends { DVec3::ONE } else { DVec3::ONE - dielectric };
    let mut diffuse = plastic * (1.0 - transmitted) * (1.0 - dielectric.max_element());
    // The blurred part of what a metal mirrors has the colour of the ambient light.
    let mut ambient = diffuse + metallic * (1.0 - sharp);
    let mut specular = reflected / (4.0 * highlight_squared);
    if is_blended(material) && !bends {
        // Of something half there, half is seen, and as much of what is behind.
        mirror *= alpha;
        diffuse *= alpha;
        ambient *= alpha;
        specular *= alpha;
        transmission = transmission * alpha + DVec3::splat(1.0 - alpha);
    }
    Ok(Whitted {
        base: base.as_vec3(),
        ambient: ambient as f32,
        specular: specular.as_vec3(),
        exponent: (2.0 / highlight_squared - 2.0).max(1.0) as f32,
        mirror: mirror.as_vec3(),
        diffuse: diffuse as f32,
        transmission: transmission.as_vec3(),
        // What is thin bends nothing.
        ior: if bends && ior > 0.0 { ior as f32 } else { 1.0 },
        absorption: absorption.as_vec3(),
        priority: 0,
        texture,
        bump: NO_TEXTURE,
        bump_height: 0.0,
        flags: VERTEX_COLORS | SMOOTH_NORMALS | if bends { FRESNEL } else { 0 },
    })
}

/// What a volume absorbs, per scene unit: after `distance`, light has the given colour.
fn absorption(distance: Option<f64>, color: Option<[f64; 3]>, place: &Place) -> Result<DVec3, Fault> {
    let Some(distance) = distance else {
        return Ok(DVec3::ZERO);
    };
    if distance <= 0.0 {
        return Err(Fault::Value {
            place: place.field("extensions.KHR_materials_volume.attenuationDistance"),
            value: distance,
            wanted: "a length above 0",
        });
    }
    let color = DVec3::from_array(color.unwrap_or([1.0; 3])).clamp(DVec3::ZERO, DVec3::ONE);
    Ok(color.map(|channel| (-channel.ln() / distance).clamp(0.0, MOST_ABSORPTION)))
}

/// Takes note of what has no equal.
fn note(material: &Material, notices: &mut Notices) {
    let extensions = &material.extensions;
    let specular = extensions.specular.as_ref();
    let is_textured = extensions
        .transmission
        .as_ref()
        .is_some_and(|it| it.transmission_texture.is_some())
        || specular.is_some_and(|it| it.specular_texture.is_some() || it.specular_color_texture.is_some());
    for (is_there, what) in [
        (material.normal_texture.is_some(), "normal maps"),
        (
            material.emissive_texture.is_some() || material.emissive_factor.is_some_and(|it| it != [0.0; 3]),
            "emission",
        ),
        (material.alpha_mode.as_deref() == Some("MASK"), "alpha masks"),
        (is_textured, "textures of transmission and of specular colours"),
    ] {
        if is_there {
            notices.add(what);
        }
    }
}

fn is_blended(material: &Material) -> bool {
    material.alpha_mode.as_deref() == Some("BLEND")
}

fn is_transparent(material: &Material) -> bool {
    material.alpha_mode.as_deref().is_some_and(|mode| mode != "OPAQUE")
}
