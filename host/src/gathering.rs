//! Several meshes in one scene, as they lie.

use crate::asset::Asset;
use crate::mesh::MOST;
use crate::mesh_source::{MeshError, MeshSource};
use crate::model::{plain_material, retextured};
use crate::progress::Progress;
use crate::shift::{centring, is_near};
use crate::texels::{self, TooManyTexels};
use crate::transform::Transform;
use glam::{DMat3, DVec3, Vec3};
use oktant_shared::color::linear_from_srgb;
use oktant_shared::light::DIRECTIONAL;
use oktant_shared::material::Material;
use std::path::PathBuf;

/// Why meshes cannot be looked at together.
#[derive(Debug, thiserror::Error)]
pub enum GatheringError {
    /// One of them is more than a mesh.
    #[error(
        "{} is a scene file, which is looked at alone: leave the others out, or name the meshes in it, each under [[mesh]].",
        .0.display()
    )]
    SceneAmong(PathBuf),
    /// One of them cannot be had.
    #[error(transparent)]
    Mesh(Box<MeshError>),
    /// One of them would lose its form.
    #[error(
        "{0}: this is too small and too far from the other meshes for f32 to hold it beside them; look at it alone, or move \
         it in a scene file, with translate."
    )]
    TooFar(String),
    /// Ids do not suffice.
    #[error("{name}: with this, there are more than {most} triangles or vertices; leave some of the meshes out.")]
    TooMany {
        /// The mesh that is one too many.
        name: String,
        /// How many there may be.
        most: usize,
    },
    /// Their images are too large together.
    #[error("{name}: {source}.")]
    Images {
        /// The mesh whose images are too many.
        name: String,
        /// What is too much.
        source: TooManyTexels,
    },
}

/// Loads meshes and puts them into one asset, each where its file has it, with the materials that its file gives it; what has
/// neither those nor colours gets a colour of its own. Materials are called after files. All lights of the files are there,
/// and no camera: the view begins with all that there is.
///
/// # Errors
/// [`GatheringError`], apart from [`GatheringError::SceneAmong`].
pub fn load(meshes: &[MeshSource], progress: Progress<'_>) -> Result<Asset, GatheringError> {
    let mut assets = Vec::with_capacity(meshes.len());
    for (number, mesh) in meshes.iter().enumerate() {
        let asset = mesh.load_asset(&|stage, fraction| {
            progress(stage, (number as f32 + fraction) / meshes.len() as f32);
        });
        assets.push(asset.map_err(|error| GatheringError::Mesh(Box::new(error)))?);
    }
    let mut gathering = Gathering {
        whole: Asset::default(),
        shift: common_shift(&assets),
    };
    gathering.whole.mesh.shift = gathering.shift;
    for (number, (mesh, asset)) in meshes.iter().zip(assets).enumerate() {
        gathering.add(number, mesh, asset)?;
    }
    gathering.whole.complete_coordinates();
    Ok(gathering.whole)
}

/// What is to be subtracted from all positions of the files, so that all meshes together are near the origin.
fn common_shift(assets: &[Asset]) -> DVec3 {
    let boxes = assets.iter().filter_map(|asset| {
        let (low, high) = asset.mesh.bounds()?;
        Some([low, high].map(|corner| corner.as_dvec3() + asset.mesh.shift))
    });
    let whole = boxes.reduce(|[low, high], [other_low, other_high]| [low.min(other_low), high.max(other_high)]);
    match whole {
        Some([low, high]) if !is_near(low, high) => centring(low, high),
        _ => DVec3::ZERO,
    }
}

/// Meshes that have been put together so far.
struct Gathering {
    whole: Asset,
    shift: DVec3,
}

impl Gathering {
    fn add(&mut self, number: usize, source: &MeshSource, mut asset: Asset) -> Result<(), GatheringError> {
        let moved = asset.mesh.shift - self.shift;
        if moved != DVec3::ZERO {
            let there = Transform {
                linear: DMat3::IDENTITY,
                translation: -self.shift,
            };
            asset.mesh = there
                .apply(asset.mesh)
                .map_err(|_| GatheringError::TooFar(source.to_string()))?;
        }
        self.add_materials(number, source, &asset)?;
        for mut light in asset.lights {
            if light.kind != DIRECTIONAL {
                light.position = (light.position.as_dvec3() + moved).as_vec3();
            }
            self.whole.lights.push(light);
        }
        self.whole.files.extend(asset.files);
        let mesh = &mut self.whole.mesh;
        let vertices = mesh.positions.len() + asset.mesh.positions.len();
        if vertices.max(mesh.triangles.len() + asset.mesh.triangles.len()) > MOST {
            return Err(GatheringError::TooMany {
                name: source.to_string(),
                most: MOST,
            });
        }
        mesh.append(asset.mesh);
        Ok(())
    }

    fn add_materials(&mut self, number: usize, source: &MeshSource, asset: &Asset) -> Result<(), GatheringError> {
        let whole = &mut self.whole;
        let name = source.name();
        let first = whole.materials.len() as u32;
        if asset.materials.is_empty() {
            let has_colors = !asset.mesh.colors.is_empty();
            whole.materials.push(Material {
                base: if has_colors { Vec3::ONE } else { color(number) },
                ..plain_material()
            });
            whole.names.materials.push(Some(name));
            let ids = std::iter::repeat_n(first, asset.mesh.triangles.len());
            whole.material_ids.extend(ids);
            return Ok(());
        }
        let all = (&mut whole.textures, &mut whole.texels);
        let first_texture =
            texels::append(all, (&asset.textures, &asset.texels)).map_err(|fault| GatheringError::Images {
                name: source.to_string(),
                source: fault,
            })?;
        for (id, material) in asset.materials.iter().enumerate() {
            whole.materials.push(retextured(material, first_texture));
            whole.names.materials.push(Some(match asset.names.material(id) {
                Some(own) => format!("{name}: {own}"),
                None => name.clone(),
            }));
        }
        whole
            .material_ids
            .extend(asset.material_ids.iter().map(|id| first + id));
        Ok(())
    }
}

/// The colour of the mesh with that number where it has none, linear RGB: after the eighth they begin again.
fn color(number: usize) -> Vec3 {
    let color = colorous::SET2[number % colorous::SET2.len()];
    Vec3::from_array([color.r, color.g, color.b].map(|channel| linear_from_srgb(f32::from(channel) / 255.0)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::silent;
    use std::fs;
    use std::path::Path;

    /// A PLY file with one triangle at `x`.
    fn triangle(folder: &Path, name: &str, x: f64) -> MeshSource {
        let path = folder.join(name);
        let text = format!(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n\
             element face 1\nproperty list uchar int vertex_indices\nend_header\n\
             {x} 0 0\n{} 0 0\n{x} 1 0\n3 0 1 2\n",
            x + 1.0
        );
        fs::write(&path, text).unwrap();
        MeshSource::File(path)
    }

    #[test]
    fn each_lies_where_its_file_has_it_with_a_material_of_its_own() {
        let folder = tempfile::tempdir().unwrap();
        let meshes = [
            triangle(folder.path(), "a.ply", 0.0),
            triangle(folder.path(), "b.ply", 3.0),
            MeshSource::Balls,
        ];
        let whole = load(&meshes, &silent).unwrap();
        assert_eq!(
            whole.mesh.positions[..6].iter().map(|at| at.x).collect::<Vec<_>>(),
            [0.0, 1.0, 0.0, 3.0, 4.0, 3.0]
        );
        assert_eq!(whole.mesh.triangles[..2], [[0, 1, 2], [3, 4, 5]]);
        assert_eq!(whole.mesh.triangles.len(), 2 + 4032);
        assert_eq!(whole.material_ids[..3], [0, 1, 2]);
        assert_eq!(whole.material_ids.len(), whole.mesh.triangles.len());
        let names: Vec<_> = (0..3).map(|id| whole.names.material(id)).collect();
        assert_eq!(names, [Some("a.ply"), Some("b.ply"), Some("balls")]);
        assert_ne!(whole.materials[0].base, whole.materials[1].base);
        assert_eq!(whole.files.len(), 2);
    }

    #[test]
    fn far_away_meshes_stay_beside_each_other() {
        let folder = tempfile::tempdir().unwrap();
        let meshes = [4e6, 4e6 + 2.0, 4e6 - 700.0].map(|x| triangle(folder.path(), &format!("{x}.ply"), x));
        let whole = load(&meshes, &silent).unwrap();
        assert_ne!(whole.mesh.shift, DVec3::ZERO);
        let at = |vertex: usize| f64::from(whole.mesh.positions[vertex].x) + whole.mesh.shift.x;
        assert_eq!([at(0), at(3), at(6)], [4e6, 4e6 + 2.0, 4e6 - 700.0]);
    }

    #[test]
    fn what_f32_cannot_hold_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let meshes = [0.0, 1e9].map(|x| triangle(folder.path(), &format!("{x}.ply"), x));
        let error = load(&meshes, &silent).unwrap_err();
        assert!(
            matches!(&error, GatheringError::TooFar(name) if name.ends_with(".ply")),
            "{error}"
        );
    }

    #[test]
    fn materials_keep_their_names_and_images() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::write(
            at("a.obj"),
            "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl wood\nf 1/1 2/1 3/1\n",
        )
        .unwrap();
        fs::write(at("a.mtl"), "newmtl wood\nmap_Kd wood.png\n").unwrap();
        image::RgbImage::new(2, 2).save(at("wood.png")).unwrap();
        let whole = load(&[at("a.obj"), at("a.obj")].map(MeshSource::File), &silent).unwrap();
        assert_eq!(whole.names.material(1), Some("a.obj: wood"));
        assert_eq!([whole.materials[0].texture, whole.materials[1].texture], [0, 1]);
        assert_eq!((whole.textures[1].first, whole.texels.len()), (4, 8));
        assert_eq!(whole.material_ids, [0, 1]);
    }
}
