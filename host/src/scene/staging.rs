//! What of a scene can be changed without building its structure anew.

use super::Scene;
use crate::model::{Model, white_light};
use glam::Vec3;
use oktant_shared::environment::Environment;
use oktant_shared::light::Light;
use oktant_shared::material::Material;

/// What surfaces are made of, what shines on them, and what is around.
#[derive(Clone, Debug, PartialEq)]
pub struct Staging {
    /// By material id, at least one.
    pub materials: Vec<Material>,
    /// The first one is the one that a view moves: where it is does not matter here.
    pub lights: Vec<Light>,
    /// What surrounds everything.
    pub environment: Environment,
    /// Ambient light, linear RGB.
    pub ambient: Vec3,
}

impl Default for Staging {
    /// Of no scene at all: nothing shines on nothing.
    fn default() -> Self {
        Staging {
            materials: Vec::new(),
            lights: Vec::new(),
            environment: Environment::constant(Vec3::ZERO),
            ambient: Vec3::ZERO,
        }
    }
}

impl Staging {
    /// Of a scene.
    pub fn of(scene: &Scene) -> Self {
        let others = &scene.lights[..scene.light_count as usize];
        let is_dark = scene.light.color == Vec3::ZERO && others.is_empty();
        let first = (!is_dark).then_some(scene.light);
        Staging {
            materials: scene.materials.clone(),
            lights: first.into_iter().chain(others.iter().copied()).collect(),
            environment: scene.environment,
            ambient: scene.ambient,
        }
    }

    /// Of a model.
    pub fn of_model(model: &Model) -> Self {
        Staging {
            materials: model.materials.clone(),
            lights: model.lights.clone(),
            environment: model.environment,
            ambient: model.ambient,
        }
    }

    /// Gives it to a model.
    pub fn put_on(&self, model: &mut Model) {
        model.materials.clone_from(&self.materials);
        model.lights.clone_from(&self.lights);
        (model.environment, model.ambient) = (self.environment, self.ambient);
    }
}

impl Scene {
    /// The same triangles in another staging, one that keeps the rules of a model and has as many materials. Their structure
    /// and all other arrays are shared. Where the normals of indexed triangles lie in 32 bits, they stay so, also where a
    /// material mirrors now.
    pub fn staged(&self, staging: &Staging) -> Self {
        let mut scene = self.clone();
        scene.materials.clone_from(&staging.materials);
        scene.set_lights(staging.lights.clone());
        scene.ambient = staging.ambient;
        scene.environment = staging.environment;
        scene.settle();
        scene
    }

    /// The first light, black where there is none, and the others.
    pub(super) fn set_lights(&mut self, lights: Vec<Light>) {
        let mut lights = lights.into_iter();
        self.light = lights.next().unwrap_or(Light {
            color: Vec3::ZERO,
            ..white_light()
        });
        let others: Vec<_> = lights.collect();
        self.light_count = others.len() as u32;
        self.lights = super::never_empty(others);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balls::balls;
    use crate::progress::silent;
    use crate::structure::StructureOptions;
    use oktant_shared::variant::{GLASS, LIGHTS, MIRRORS, Variant};
    use std::sync::Arc;

    fn scene() -> Scene {
        Scene::new(&balls(), &StructureOptions::default(), &silent).unwrap()
    }

    /// Oracle: the scene that is built of the model with that staging.
    #[test]
    fn a_staged_scene_is_the_one_that_would_be_built() {
        let plain = scene();
        let mut staging = Staging::of(&plain);
        assert_eq!(plain.needs, 0);
        staging.materials[0].mirror = Vec3::splat(0.5);
        staging.lights.push(Light {
            position: Vec3::ONE,
            color: Vec3::X,
            ..white_light()
        });
        staging.environment = Environment::constant(Vec3::splat(3.0));
        staging.ambient = Vec3::Y;
        let mut model = Model::of_mesh(balls());
        staging.put_on(&mut model);
        assert_eq!(Staging::of_model(&model), staging);
        let built = Scene::of_model(model, &StructureOptions::default(), &silent).unwrap();
        let staged = plain.staged(&staging);
        assert_eq!(staged.needs, MIRRORS | LIGHTS);
        assert_eq!((staged.needs, staged.variant), (built.needs, built.variant));
        assert_eq!(staged.variant, Variant::Mirrors);
        assert_eq!(staged.material_ids, built.material_ids);
        assert_eq!(staged.materials, built.materials);
        assert_eq!((staged.light, &staged.lights), (built.light, &built.lights));
        assert_eq!(staged.light_count, 1);
        assert_eq!((staged.ambient, staged.environment), (built.ambient, built.environment));
        assert_eq!(staged.brightest(&staged.light), built.brightest(&built.light));
        assert_eq!(Staging::of(&staged), staging);
        assert!(Arc::ptr_eq(&staged.nodes, &plain.nodes), "nothing large is copied");
        let again = staged.staged(&Staging::of(&plain));
        assert_eq!((again.needs, again.variant), (plain.needs, Variant::Plain));
    }

    #[test]
    fn glass_and_darkness_come_and_go() {
        let plain = scene();
        let mut staging = Staging::of(&plain);
        staging.materials[0].transmission = Vec3::splat(0.9);
        staging.lights.clear();
        let staged = plain.staged(&staging);
        assert_eq!(staged.needs, GLASS);
        assert!(staged.is_transparent());
        assert_eq!(staged.light.color, Vec3::ZERO);
        assert_eq!(Staging::of(&staged).lights, []);
    }
}
