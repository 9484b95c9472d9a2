//! From MTL materials to what the kernel reads. docs/files.md has the rule.

use super::fault::Fault;
use super::mtl::{self, Description};
use super::statements::{NONE, Statements};
use crate::array_file::UnusableFile;
use crate::asset::{Asset, clay};
use crate::excerpt::excerpt;
use crate::texels;
use crate::whole_file;
use glam::{DVec3, Vec3};
use oktant_shared::material::{FRESNEL, Material, SMOOTH_NORMALS, VERTEX_COLORS};
use oktant_shared::texture::NO_TEXTURE;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// The index of refraction of what bends light and does not say how much: of glass.
const GLASS: f64 = 1.5;

/// Gives an asset the materials that its faces name, as far as they can be had, and numbers its triangles accordingly.
pub(super) fn furnish(
    asset: &mut Asset,
    statements: &Statements,
    name: &str,
    folder: Option<&Path>,
) -> Result<(), Fault> {
    let mut described = HashMap::new();
    let mut is_all_read = folder.is_some();
    if let Some(folder) = folder {
        let libraries = statements.libraries.iter();
        for path in libraries.flat_map(|library| mtl::candidates(library, folder)) {
            asset.files.push(path.clone());
            let file = path.display().to_string();
            match whole_file::read(&path, mtl::LARGEST) {
                Ok(bytes) => mtl::read(&bytes, &file, path.parent().unwrap_or(Path::new("")), &mut described)?,
                Err(fault) => {
                    is_all_read = false;
                    tracing::warn!("{name}: {}", UnusableFile { file, fault });
                }
            }
        }
    }
    let is_missing = |material: &&String| !material.is_empty() && !described.contains_key(*material);
    // Where a file of materials cannot be had, that has been said.
    if is_all_read && let Some(missing) = statements.materials.iter().find(is_missing) {
        tracing::warn!(
            "{name}: no MTL file describes the material \"{}\", so its faces are of clay",
            excerpt(missing.as_bytes())
        );
    }
    let mut ids: Vec<u32> = Vec::new();
    let mut images = HashMap::new();
    let mut has_others = false;
    for material in &statements.materials {
        ids.push(match described.get(material) {
            Some(description) => {
                let texture = texture(asset, description.image.as_deref(), name, &mut images)?;
                has_others |= description.has_others;
                asset.materials.push(material_of(description, texture));
                asset.names.materials.push(Some(material.clone()));
                asset.materials.len() as u32 - 1
            }
            None => NONE,
        });
    }
    if has_others {
        tracing::warn!("{name}: of images only map_Kd is read, and the materials have others; docs/files.md says more");
    }
    if asset.materials.is_empty() {
        asset.material_ids.clear();
        return Ok(());
    }
    let other = asset.materials.len() as u32;
    let mut is_other_used = false;
    for id in &mut asset.material_ids {
        // None was named, or one that is not described.
        *id = ids.get(*id as usize).copied().filter(|id| *id != NONE).unwrap_or(other);
        is_other_used |= *id == other;
    }
    if is_other_used {
        asset.materials.push(clay());
    }
    Ok(())
}

/// The index of the texture of an image; none where it cannot be had.
fn texture(
    asset: &mut Asset,
    image: Option<&Path>,
    name: &str,
    known: &mut HashMap<PathBuf, u32>,
) -> Result<u32, Fault> {
    let Some(path) = image else {
        return Ok(NO_TEXTURE);
    };
    if let Some(id) = known.get(path) {
        return Ok(*id);
    }
    asset.files.push(path.to_path_buf());
    let id = match texels::read(path) {
        Ok(image) => {
            asset.textures.push(texels::add_colors(&image, &mut asset.texels)?);
            asset.textures.len() as u32 - 1
        }
        Err(fault) => {
            tracing::warn!("{name}: {fault}");
            NO_TEXTURE
        }
    };
    known.insert(path.to_path_buf(), id);
    Ok(id)
}

/// A material as the kernel reads it: what leaves a surface is no more than what arrives.
fn material_of(description: &Description, texture: u32) -> Material {
    let illumination = description.illumination;
    let opacity = description.dissolve.clamp(0.0, 1.0);
    let (bends, has_fresnel) = (matches!(illumination, 6 | 7), matches!(illumination, 5 | 7));
    let reflects = matches!(illumination, 3..=6);
    let mut mirror = if reflects { description.specular } else { DVec3::ZERO };
    let mut transmission = match (bends, has_fresnel) {
        // Fresnel's equations say what is reflected of it.
        (true, true) => description.filter,
        (true, false) => description.filter * (DVec3::ONE - description.specular),
        (false, _) => DVec3::splat(1.0 - opacity),
    };
    // What is half there reflects half as much.
    let there = if bends { 1.0 } else { opacity };
    mirror *= there;
    let most = (mirror + transmission).max_element();
    if most > 1.0 {
        mirror /= most;
        transmission /= most;
    }
    let rest = DVec3::ONE - mirror - transmission;
    let part = |rest: f64, base: f64| if base > rest { (rest / base).max(0.0) } else { 1.0 };
    let base = description.diffuse;
    let diffuse = part(rest.x, base.x)
        .min(part(rest.y, base.y))
        .min(part(rest.z, base.z))
        .min(there);
    let shines = illumination >= 2 && description.exponent > 0.0;
    let ior = if description.ior > 1.0 {
        description.ior.min(10.0)
    } else {
        GLASS
    };
    Material {
        base: base.as_vec3(),
        ambient: diffuse as f32,
        specular: (description.specular * there).as_vec3(),
        exponent: if shines {
            description.exponent.clamp(1.0, 1e6) as f32
        } else {
            0.0
        },
        mirror: mirror.as_vec3(),
        diffuse: diffuse as f32,
        transmission: transmission.as_vec3(),
        ior: if bends || has_fresnel { ior as f32 } else { 1.0 },
        absorption: Vec3::ZERO,
        priority: 0,
        texture,
        bump: NO_TEXTURE,
        bump_height: 0.0,
        flags: VERTEX_COLORS | SMOOTH_NORMALS | if has_fresnel { FRESNEL } else { 0 },
    }
}
