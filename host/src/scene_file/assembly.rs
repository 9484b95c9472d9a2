//! Putting the parts of a scene together.

use super::description::Description;
use super::fault::{Fault, Reason};
use super::folder::Folder;
use super::material::Palette;
use super::place::Place;
use super::texture::Textures;
use crate::asset::Asset;
use crate::mesh::Mesh;
use crate::mesh_source::MeshSource;
use crate::model::{AMBIENT, Model, needs_coordinates};
use crate::names::Names;
use crate::preferences::Preferences;
use crate::progress::Progress;
use crate::source::Setting;
use crate::transform::{Misplaced, Transform};
use crate::view::View;
use glam::{DMat3, DVec3};
use oktant_shared::orbit::Up;
use std::path::PathBuf;
use std::sync::Arc;

/// A scene in the making.
pub struct Assembly<'a> {
    /// Paths in the file are relative to this.
    pub folder: Folder<'a>,
    /// At most so many triangles, and so many vertices.
    most: usize,
    /// Who hears of the meshes that are read.
    pub progress: Progress<'a>,
    /// Which axis points up.
    pub up: Up,
    /// The materials.
    pub palette: Palette,
    /// All meshes so far in one.
    mesh: Mesh,
    /// Index of the material for each triangle.
    material_ids: Vec<u32>,
    /// Images and patterns.
    textures: Textures,
    /// Meshes that were read; many copies of one are read once.
    read: Vec<Loaded>,
    /// Files that were read.
    files: Vec<PathBuf>,
}

/// A mesh that was read.
struct Loaded {
    source: MeshSource,
    asset: Arc<Asset>,
    /// What its materials have become, once something is made of them.
    materials: Option<Vec<u32>>,
}

/// Makes the scene that a file describes, of at most so many triangles.
///
/// # Errors
/// The first thing that is wrong.
pub fn assemble(
    description: &Description,
    folder: Folder<'_>,
    most: usize,
    progress: Progress<'_>,
) -> Result<Setting, Fault> {
    let up = description.up.into();
    let mut textures = Textures::read(&description.textures, &description.materials, folder)?;
    let environment = description.environment.build(&mut textures, folder, up)?;
    let mut assembly = Assembly {
        folder,
        most,
        progress,
        up,
        palette: Palette::new(&description.materials, &textures)?,
        mesh: Mesh::default(),
        material_ids: Vec::new(),
        textures,
        read: Vec::new(),
        files: Vec::new(),
    };
    macro_rules! add_all {
        ($($parts:expr, $key:literal;)*) => {$(
            for (i, part) in $parts.iter().enumerate() {
                part.add_to(&mut assembly, &Place::of($key).index(i))?;
            }
        )*};
    }
    add_all! {
        description.mesh, "mesh";
        description.sphere, "sphere";
        description.cuboid, "box";
        description.quad, "quad";
        description.checkerboard, "checkerboard";
        description.lathe, "lathe";
    }
    let mut planes = Vec::new();
    for (i, plane) in description.plane.iter().enumerate() {
        planes.push(plane.build(&mut assembly, &Place::of("plane").index(i))?);
    }
    if planes.is_empty() && assembly.mesh.triangles.is_empty() {
        return Err(Fault::new(&Place::ROOT, Reason::Empty));
    }
    let whole = assembly.mesh.bounding_sphere();
    let mut view = View {
        up,
        ..Preferences::of_process().view
    };
    let focus = description.camera.apply(&mut view, whole)?;
    description.render.apply(&mut view)?;
    view.stereo = description.stereo.as_ref().map(|stereo| stereo.build());
    if view.stereo.is_some() && view.is_orthographic() {
        let place = Place::of("stereo");
        return Err(Fault::new(
            &place,
            Reason::Excludes("camera.projection = \"orthographic\""),
        ));
    }
    description.render.check_halves(&view)?;
    let lights = super::light::build_all(description.light.as_deref(), &mut view, focus.unwrap_or(whole))?;
    let (names, materials): (Vec<_>, Vec<_>) = assembly.palette.into_used().into_iter().unzip();
    let image = description.environment.image.as_deref();
    let names = Names {
        materials: names,
        environment: image.map(|path| path.display().to_string()),
    };
    let mut files = assembly.files;
    files.extend(assembly.textures.files);
    files.sort();
    files.dedup();
    Ok(Setting {
        model: Model {
            mesh: assembly.mesh,
            material_ids: if materials.len() > 1 {
                assembly.material_ids
            } else {
                Vec::new()
            },
            materials,
            planes,
            lights,
            textures: assembly.textures.textures,
            texels: assembly.textures.texels,
            environment,
            ambient: description.ambient.map_or(AMBIENT, |color| color.0),
            focus,
        },
        view,
        names,
        size: description.render.size(),
        files,
    })
}

impl Assembly<'_> {
    /// Loads a mesh, once.
    pub fn load(&mut self, source: MeshSource, place: &Place) -> Result<Arc<Asset>, Fault> {
        if let Some(known) = self.read.iter().find(|known| known.source == source) {
            return Ok(known.asset.clone());
        }
        let asset = source
            .load_asset(self.progress)
            .map_err(|error| Fault::new(place, Reason::Mesh(Box::new(error))))?;
        self.files.extend(asset.files.iter().cloned());
        let asset = Arc::new(asset);
        self.read.push(Loaded {
            source,
            asset: asset.clone(),
            materials: None,
        });
        Ok(asset)
    }

    /// The material of each triangle of a mesh that was loaded, and has materials of its own.
    pub fn own_materials(&mut self, asset: &Arc<Asset>, place: &Place) -> Result<Vec<u32>, Fault> {
        let known = self.read.iter().find(|known| Arc::ptr_eq(&known.asset, asset));
        let ids = match known.and_then(|known| known.materials.as_ref()) {
            Some(ids) => ids.clone(),
            None => self.adopt(asset, place)?,
        };
        Ok(asset.material_ids.iter().map(|id| ids[*id as usize]).collect())
    }

    /// Makes the materials of a mesh, and their textures, part of the scene; returns their ids.
    fn adopt(&mut self, asset: &Arc<Asset>, place: &Place) -> Result<Vec<u32>, Fault> {
        let first = self
            .textures
            .append(&asset.textures, &asset.texels)
            .map_err(|fault| Fault::new(place, fault.into()))?;
        let ids: Vec<u32> = asset
            .materials
            .iter()
            .enumerate()
            .map(|(own, material)| self.palette.add_own(asset.names.material(own), material, first))
            .collect();
        if let Some(known) = self.read.iter_mut().find(|known| Arc::ptr_eq(&known.asset, asset)) {
            known.materials = Some(ids.clone());
        }
        Ok(ids)
    }

    /// The transform of a shape made with y up: turned by `degrees` about its own axes x, y, z, then put where the scene
    /// has its up, then moved.
    pub fn placed(&self, degrees: DVec3, translation: DVec3) -> Transform {
        let turned = Transform::new(DVec3::ONE, degrees, DVec3::ZERO);
        Transform {
            linear: DMat3::from_cols_array_2d(&self.up.axes().map(|axis| axis.as_dvec3().to_array())) * turned.linear,
            translation,
        }
    }

    /// Adds a mesh of one material.
    pub fn add(&mut self, place: &Place, mesh: Mesh, transform: &Transform, material: u32) -> Result<(), Fault> {
        let ids = vec![material; mesh.triangles.len()];
        self.add_mixed(place, mesh, transform, &ids)
    }

    /// Adds a mesh, with a material for each of its triangles.
    pub fn add_mixed(
        &mut self,
        place: &Place,
        mesh: Mesh,
        transform: &Transform,
        materials: &[u32],
    ) -> Result<(), Fault> {
        if mesh.coordinates.is_empty()
            && let Some(id) = materials.iter().find(|id| needs_coordinates(self.palette.get(**id)))
        {
            let name = self.palette.name(*id).to_string();
            return Err(Fault::new(place, Reason::NoCoordinates(name)));
        }
        let mesh = transform.apply(mesh).map_err(|misplaced| {
            let reason = match misplaced {
                Misplaced::TooLarge => Reason::TooLarge,
                Misplaced::TooFar { center, extent } if place.is_below("mesh") => {
                    Reason::MeshTooFar(rounded(transform.translation - center, extent))
                }
                Misplaced::TooFar { center, extent } => Reason::ShapeTooFar(rounded(-center, extent)),
            };
            Fault::new(place, reason)
        })?;
        self.material_ids.extend_from_slice(materials);
        self.mesh.append(mesh);
        if self.mesh.positions.len().max(self.mesh.triangles.len()) > self.most {
            return Err(Fault::new(place, Reason::TooMany(self.most)));
        }
        Ok(())
    }
}

/// A vector as a scene file has it, rounded to about a hundredth of the extent of what it moves.
fn rounded(vector: DVec3, extent: f64) -> String {
    let decimals = (2.0 - extent.log10().floor()).clamp(0.0, 12.0) as usize;
    let step = 10_f64.powi(-(decimals as i32));
    let coordinates = vector.to_array().map(|value| {
        // Zero has no sign.
        let value = if value.abs() < step / 2.0 { 0.0 } else { value };
        format!("{value:.decimals$}")
    });
    format!("[{}]", coordinates.join(", "))
}
