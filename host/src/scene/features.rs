//! What of all that can be rendered a scene has.

use super::Scene;
use crate::view::{Shading, View};
use glam::Vec3;
use oktant_shared::light::{AREA, Light};
use oktant_shared::material::{Material, SMOOTH_NORMALS};
use oktant_shared::texture::NO_TEXTURE;
use rayon::prelude::*;
use std::fmt;

/// What a picture of a scene takes, in words. Materials that no triangle and no plane has do not count, and neither do lights
/// that are black.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Features {
    /// Lights: each casts shadows.
    pub lights: usize,
    /// Those of them that are areas.
    pub areas: usize,
    /// Materials.
    pub materials: usize,
    /// Planes without end.
    pub planes: usize,
    /// Whether colours lie on surfaces.
    pub textures: bool,
    /// Whether normals are tilted.
    pub bumps: bool,
    /// Whether there is an image around.
    pub image: bool,
    /// Whether something mirrors.
    pub mirrors: bool,
    /// Whether light goes through something.
    pub glass: bool,
    /// Whether there are triangles whose normal, interpolated between the corners, is not the same everywhere.
    pub smooth: bool,
    /// Whether there are flat ones, or no others.
    pub flat: bool,
    /// Samples of a pixel.
    pub samples: u32,
    /// Whether that is the most of them.
    pub adaptive: bool,
}

impl Features {
    /// Those of a scene as a view shows it.
    pub fn new(scene: &Scene, view: &View) -> Self {
        let others = &scene.lights[..scene.light_count as usize];
        let lights = || {
            let lights = std::iter::once(&scene.light).chain(others);
            lights.filter(|light| light.color != Vec3::ZERO)
        };
        let is_used = scene.used_materials();
        let used: Vec<&Material> = scene
            .materials
            .iter()
            .zip(&is_used)
            .filter_map(|(material, is_used)| is_used.then_some(material))
            .collect();
        let any = |is: fn(&Material) -> bool| used.iter().any(|material| is(material));
        let (smooth, flat) = normals(scene, view);
        Features {
            lights: lights().count(),
            areas: lights().filter(|light: &&Light| light.kind == AREA).count(),
            materials: used.len(),
            planes: scene.plane_count as usize,
            textures: any(|material| material.texture != NO_TEXTURE),
            bumps: any(|material| material.bump != NO_TEXTURE),
            image: scene.environment.texture != NO_TEXTURE,
            mirrors: any(|material| material.mirror != Vec3::ZERO),
            glass: any(Material::is_transmissive),
            smooth,
            flat,
            samples: view.samples.count(),
            adaptive: view.adaptive,
        }
    }
}

/// Whether there are smooth triangles, and flat ones. What only happens to be even, as a part of a bent surface may, is not
/// told as flat beside what is smooth.
fn normals(scene: &Scene, view: &View) -> (bool, bool) {
    let world = scene.world();
    let corners = |slot: u32| {
        let material = scene.material_ids.get(slot as usize).copied().unwrap_or(0);
        let is_smooth =
            view.shading == Shading::Phong && scene.materials[material as usize].flags & SMOOTH_NORMALS != 0;
        let triangle = world.scene.triangle(slot);
        let corners = [triangle.vertex_a, triangle.vertex_b, triangle.vertex_c];
        is_smooth.then(|| corners.map(|corner| world.vertex(corner).normal))
    };
    let slots = 0..scene.ids.len() as u32;
    let bent = |[a, b, c]: [Vec3; 3]| a != b || b != c;
    let smooth = slots
        .clone()
        .into_par_iter()
        .any(|slot| corners(slot).is_some_and(bent));
    // Normals of zero are how flat triangles are said among others.
    let said = |slot| corners(slot).is_none_or(|normals| normals == [Vec3::ZERO; 3]);
    (smooth, !smooth || slots.into_par_iter().any(said))
}

impl fmt::Display for Features {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let counted = |count: usize, what: &str| {
            let s = if count == 1 { "" } else { "s" };
            format!("{count} {what}{s}")
        };
        let areas = match (self.areas, self.lights) {
            (0, _) => String::new(),
            (areas, lights) if areas == lights => " with an area".into(),
            (areas, _) => format!(" ({areas} with an area)"),
        };
        let lights = if self.lights == 0 {
            "no light".into()
        } else {
            format!("shadows of {}{areas}", counted(self.lights, "light"))
        };
        let normals = match (self.smooth, self.flat) {
            (true, true) => "smooth and flat normals",
            (true, false) => "smooth normals",
            (false, _) => "flat normals",
        };
        let most = if self.adaptive { "at most " } else { "" };
        let samples = format!("{most}{} a pixel", counted(self.samples as usize, "sample"));
        let mut words = vec![lights, counted(self.materials, "material")];
        if self.planes > 0 {
            words.push(counted(self.planes, "plane"));
        }
        for (is, word) in [
            (self.textures, "textures"),
            (self.bumps, "bumps"),
            (self.image, "an image around"),
            (self.mirrors, "mirrors"),
            (self.glass, "glass"),
        ] {
            if is {
                words.push(word.into());
            }
        }
        words.extend([normals.into(), samples]);
        f.write_str(&words.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balls;
    use crate::model::{Model, plain_material, white_light};
    use crate::progress::silent;
    use crate::sampling::Samples;
    use crate::structure::StructureOptions;
    use oktant_shared::plane::Plane;
    use oktant_shared::texture::{SRGB_IMAGE, Texture};

    fn said(model: Model, view: &View) -> String {
        let scene = Scene::of_model(model, &StructureOptions::default(), &silent).unwrap();
        Features::new(&scene, view).to_string()
    }

    fn balls() -> Model {
        Model::of_mesh(balls::balls())
    }

    #[test]
    fn a_mesh_alone_takes_little() {
        let view = View::default();
        let plain = "shadows of 1 light, 1 material, smooth normals, 1 sample a pixel";
        assert_eq!(said(balls(), &view), plain);
        let flat = View {
            shading: Shading::Flat,
            samples: Samples::Sixteen,
            adaptive: true,
            ..view
        };
        assert_eq!(
            said(balls(), &flat),
            "shadows of 1 light, 1 material, flat normals, at most 16 samples a pixel"
        );
        let mut mixed = balls();
        mixed.mesh.normals[..9].fill(Vec3::ZERO);
        assert_eq!(said(mixed, &view), plain.replace("smooth", "smooth and flat"));
        let mut stl = balls();
        stl.mesh.normals.fill(Vec3::ZERO);
        assert_eq!(said(stl, &view), plain.replace("smooth", "flat"));
        let mut bare = balls();
        bare.mesh.normals.clear();
        bare.lights.clear();
        // What nothing has is not taken.
        bare.materials.push(Material {
            mirror: Vec3::splat(0.5),
            transmission: Vec3::splat(0.5),
            ..plain_material()
        });
        assert_eq!(
            said(bare, &view),
            "no light, 1 material, flat normals, 1 sample a pixel"
        );
    }

    #[test]
    fn everything_is_told_by_itself() {
        let texture = Texture {
            first: 0,
            width: 1,
            height: 1,
            kind: SRGB_IMAGE,
            repeats: 1.0,
            reserved: [0; 3],
        };
        let area = Light {
            kind: AREA,
            edge_u: Vec3::X,
            edge_v: Vec3::Z,
            ..white_light()
        };
        let floored = |material: Material| {
            let mut model = balls();
            model.textures.push(texture);
            model.texels.push(0x80_8080);
            model.materials.push(material);
            model.planes.push(Plane::new(Vec3::ZERO, Vec3::Y, 1));
            model
        };
        let words = |model: Model| {
            let said = said(model, &View::default());
            let end = said.find(", smooth normals").unwrap();
            said[..end].to_owned()
        };
        let plain = plain_material();
        let floor = "shadows of 1 light, 2 materials, 1 plane";
        assert_eq!(words(floored(plain)), floor);
        for (material, word) in [
            (Material { texture: 0, ..plain }, "textures"),
            (Material { bump: 0, ..plain }, "bumps"),
            (
                Material {
                    mirror: Vec3::splat(0.1),
                    ..plain
                },
                "mirrors",
            ),
            (
                Material {
                    transmission: Vec3::splat(0.1),
                    ..plain
                },
                "glass",
            ),
        ] {
            assert_eq!(words(floored(material)), format!("{floor}, {word}"));
        }
        let mut around = floored(plain);
        around.environment.texture = 0;
        assert_eq!(words(around), format!("{floor}, an image around"));
        for (lights, told) in [
            (vec![area], "shadows of 1 light with an area"),
            (
                vec![white_light(), area, white_light()],
                "shadows of 3 lights (1 with an area)",
            ),
            (
                vec![
                    area,
                    Light {
                        color: Vec3::ZERO,
                        ..white_light()
                    },
                ],
                "shadows of 1 light with an area",
            ),
        ] {
            let mut model = balls();
            model.lights = lights;
            assert_eq!(words(model), format!("{told}, 1 material"));
        }
    }
}
