//! The most light that a ray can meet: what is left out is judged by it.

use super::Scene;
use glam::{Vec2, Vec3};
use oktant_shared::color::linear_color;
use oktant_shared::light::{AREA, Light};
use oktant_shared::material::Material;
use oktant_shared::texture::{CHECKERBOARD, NO_TEXTURE, Texture};
use oktant_shared::whitted::MAX_DEPTH;
use rayon::prelude::*;

impl Scene {
    /// The brightest that a ray meets first, linear RGB, with the scene's first light moved: a surface in the light of all
    /// lamps, or what is around. Rays are left out by it; through mirrors and glass, highlight upon highlight, one may see
    /// more, up to [`Scene::brightest_through`].
    pub fn brightest(&self, light: &Light) -> Vec3 {
        let incident = self.brightest_incident(light);
        let own = self
            .materials
            .iter()
            .map(|material| self.brightest_own(material, incident));
        own.fold(self.brightest_around(), Vec3::max).max(incident)
    }

    /// What no ray sees more of, linear RGB, through all that reflects and refracts, down to the greatest depth: what is left
    /// out of a picture is bounded by it.
    pub fn brightest_through(&self, light: &Light) -> Vec3 {
        let incident = self.brightest_incident(light);
        let around = self.brightest_around();
        let surfaces: Vec<[Vec3; 2]> = self
            .materials
            .iter()
            .map(|material| {
                let weight = material.mirror + material.transmission;
                [self.brightest_own(material, incident), weight]
            })
            .collect();
        let behind = |seen| {
            let through = surfaces.iter().map(|[own, weight]| *own + *weight * seen);
            through.fold(around, Vec3::max)
        };
        // What is left out of a shadow ray is a part of what arrives.
        (0..MAX_DEPTH).fold(around, |seen, _| behind(seen)).max(incident)
    }

    /// What a surface shows at most without what it reflects and lets through.
    fn brightest_own(&self, material: &Material, incident: Vec3) -> Vec3 {
        let base = material.base * self.brightest_of(material.texture);
        base * (material.ambient * self.ambient) + (base * material.diffuse + material.specular) * incident
    }

    /// The most that all lights together can bring to a place, the first one moved.
    fn brightest_incident(&self, light: &Light) -> Vec3 {
        let others = self.lights.iter().take(self.light_count as usize);
        let arriving = std::iter::once(light).chain(others);
        arriving.map(|light| self.brightest_arriving(light)).sum()
    }

    /// The brightest colour of what is around.
    fn brightest_around(&self) -> Vec3 {
        let environment = &self.environment;
        if environment.texture == NO_TEXTURE {
            environment.zenith.max(environment.horizon).max(environment.nadir)
        } else {
            self.brightest_of(environment.texture) * environment.strength
        }
    }

    /// The brightest colour of a texture; 1 for none.
    fn brightest_of(&self, texture: u32) -> Vec3 {
        self.brightest_colors
            .get(texture as usize)
            .copied()
            .unwrap_or(Vec3::ONE)
    }

    /// The most of a light that can arrive anywhere on the mesh.
    fn brightest_arriving(&self, light: &Light) -> Vec3 {
        if light.falloff_radius == 0.0 {
            return light.color;
        }
        let nearest = if self.plane_count > 0 {
            0.0
        } else {
            let reach = if light.kind == AREA {
                light.edge_u.length() + light.edge_v.length()
            } else {
                0.0
            };
            let outside = light.position.clamp(self.low, self.high).distance(light.position);
            (outside - reach).max(0.0)
        };
        light.color / nearest.max(light.falloff_radius).powi(2)
    }
}

/// The brightest colour of each texture, linear RGB.
pub(super) fn brightest_colors(textures: &[Texture], texels: &[u32]) -> Vec<Vec3> {
    textures
        .iter()
        .map(|texture| brightest_color(texture, texels))
        .collect()
}

fn brightest_color(texture: &Texture, texels: &[u32]) -> Vec3 {
    if texture.kind == CHECKERBOARD {
        return linear_color(texture.width).max(linear_color(texture.height));
    }
    if !texture.is_image() {
        return Vec3::ONE;
    }
    let first = texture.first as usize;
    let count = texture.width as usize * texture.height as usize;
    // One texel of an image is its colour in the middle of the texel; between the middles there is nothing brighter.
    let single = Texture {
        first: 0,
        width: 1,
        height: 1,
        ..*texture
    };
    let colors = texels[first..first + count]
        .par_iter()
        .map(|texel| single.color(std::slice::from_ref(texel), Vec2::splat(0.5)));
    colors.reduce(|| Vec3::ZERO, Vec3::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balls::balls;
    use crate::model::Model;
    use crate::progress::silent;
    use crate::structure::StructureOptions;
    use oktant_shared::environment::Environment;
    use oktant_shared::texture::{SHARED_EXPONENT_IMAGE, WAVES, shared_exponent};

    fn built(change: impl FnOnce(&mut Model)) -> Scene {
        let mut model = Model::of_mesh(balls());
        model.ambient = Vec3::ZERO;
        model.environment = Environment::constant(Vec3::ZERO);
        model.lights[0].color = Vec3::ONE;
        let material = &mut model.materials[0];
        (material.base, material.diffuse) = (Vec3::splat(0.5), 1.0);
        (material.specular, material.ambient) = (Vec3::ZERO, 0.0);
        change(&mut model);
        Scene::of_model(model, &StructureOptions::default(), &silent).unwrap()
    }

    #[test]
    fn images_may_be_brighter_than_white() {
        let image = |model: &mut Model| {
            model.texels = vec![
                shared_exponent(Vec3::new(0.25, 1.0, 6.0)),
                shared_exponent(Vec3::new(0.5, 8.0, 2.0)),
            ];
            let plain = Texture {
                first: 0,
                width: 2,
                height: 1,
                kind: SHARED_EXPONENT_IMAGE,
                repeats: 1.0,
                reserved: [0; 3],
            };
            model.textures = vec![Texture { kind: WAVES, ..plain }, plain];
        };
        let textured = built(|model| {
            image(model);
            model.mesh.coordinates = vec![Vec2::ZERO; model.mesh.positions.len()];
            model.materials[0].texture = 1;
        });
        let brightest = textured.brightest(&textured.light);
        // In red the light itself is more.
        assert_eq!(brightest, Vec3::new(1.0, 4.0, 3.0));
        assert_eq!(
            textured.brightest_through(&textured.light),
            brightest,
            "nothing is behind it"
        );
        let surrounded = built(|model| {
            image(model);
            model.environment.texture = 1;
            model.environment.strength = 2.0;
        });
        assert_eq!(surrounded.brightest(&surrounded.light), Vec3::new(1.0, 16.0, 12.0));
    }

    #[test]
    fn highlights_add_up_through_mirrors() {
        let scene = built(|model| {
            let material = &mut model.materials[0];
            material.diffuse = 0.0;
            (material.specular, material.mirror) = (Vec3::ONE, Vec3::splat(0.5));
        });
        assert_eq!(scene.brightest(&scene.light), Vec3::ONE);
        let through = scene.brightest_through(&scene.light);
        assert!(
            (through - 2.0).abs().max_element() < 1e-4,
            "{through}: 1 + 1/2 + 1/4 + ..."
        );
    }
}
