//! What stands in a scene file.

use super::camera::Camera;
use super::checkerboard::Checkerboard;
use super::color::Radiance;
use super::cuboid::Cuboid;
use super::environment::Environment;
use super::lathe::Lathe;
use super::light::Light;
use super::material::Material;
use super::mesh::Mesh;
use super::plane::Plane;
use super::quad::Quad;
use super::render::Render;
use super::sphere::Sphere;
use super::stereo::Stereo;
use super::texture::Texture;
use oktant_shared::orbit;
use serde::Deserialize;
use std::collections::BTreeMap;

/// A scene file. Nothing in it is mandatory, but there must be something to see.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Description {
    /// Which axis points up: "y" or "z". Default: "y".
    pub up: Up,
    /// Light that comes from everywhere. Default: 0.12.
    pub ambient: Option<Radiance>,
    /// From where the picture is taken. Default: from the front, slightly above, so that everything fits.
    pub camera: Camera,
    /// What is around the scene. Default: a dark blue.
    pub environment: Environment,
    /// How the picture is made.
    pub render: Render,
    /// Pictures for two eyes. Default: for one.
    pub stereo: Option<Stereo>,
    /// What surfaces are made of, by name.
    pub materials: BTreeMap<String, Material>,
    /// Images and patterns, by name.
    pub textures: BTreeMap<String, Texture>,
    /// Triangle meshes.
    pub mesh: Vec<Mesh>,
    /// Spheres.
    pub sphere: Vec<Sphere>,
    /// Boxes.
    #[serde(rename = "box")]
    pub cuboid: Vec<Cuboid>,
    /// Parallelograms.
    pub quad: Vec<Quad>,
    /// Checkerboards.
    pub checkerboard: Vec<Checkerboard>,
    /// Surfaces of revolution.
    pub lathe: Vec<Lathe>,
    /// Planes without end.
    pub plane: Vec<Plane>,
    /// Lights; the first is the one that a hand can move. Default: a white one, above the left shoulder of who looks from
    /// the front. `light = []` is none.
    pub light: Option<Vec<Light>>,
}

/// Which axis points up.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Up {
    /// +Y; the front looks to +Z.
    #[default]
    Y,
    /// +Z; the front looks to -Y.
    Z,
}

impl From<Up> for orbit::Up {
    fn from(up: Up) -> Self {
        match up {
            Up::Y => orbit::Up::Y,
            Up::Z => orbit::Up::Z,
        }
    }
}
