use super::*;
use crate::model::{Focus, plain_material, white_light};
use crate::progress::silent;
use crate::scene::Scene;
use crate::structure::StructureOptions;
use bytemuck::Zeroable;
use glam::{Vec2, vec2, vec3};
use oktant_shared::medium::MAX_MATERIALS;
use oktant_shared::texture::SRGB_IMAGE;

/// A triangle, a plane, an image and a light of each kind.
fn model() -> Model {
    let mesh = Mesh {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
        triangles: vec![[0, 1, 2]],
        coordinates: vec![Vec2::ZERO; 3],
        ..Mesh::default()
    };
    let area = Light {
        kind: AREA,
        edge_u: Vec3::X,
        edge_v: Vec3::Z,
        samples_per_side: 4,
        ..white_light()
    };
    let sun = Light {
        kind: DIRECTIONAL,
        position: Vec3::Y,
        ..white_light()
    };
    Model {
        materials: vec![Material {
            texture: 0,
            ..plain_material()
        }],
        planes: vec![Plane::new(Vec3::ZERO, Vec3::Y, 0)],
        lights: vec![white_light(), area, sun],
        textures: vec![Texture {
            width: 2,
            height: 2,
            kind: SRGB_IMAGE,
            repeats: 1.0,
            ..Texture::zeroed()
        }],
        texels: vec![0; 4],
        ..Model::of_mesh(mesh)
    }
}

/// What is said about a model with something wrong.
fn said(spoil: impl Fn(&mut Model)) -> String {
    let mut model = model();
    assert_eq!(validate(&model), Ok(()));
    spoil(&mut model);
    let InvalidModel(rule) = validate(&model).unwrap_err();
    rule
}

#[test]
fn the_sentence() {
    assert_eq!(
        InvalidModel("there is no material".into()).to_string(),
        "The scene is not valid: there is no material. This is a bug; please report it with the scene."
    );
}

#[test]
fn meshes() {
    assert_eq!(
        said(|model| model.mesh.triangles[0][1] = 3),
        "a triangle has corner 3 of 3"
    );
    assert_eq!(
        said(|model| model.mesh.normals = vec![Vec3::X]),
        "there are 1 normals for 3 vertices"
    );
    let not_finite = "a vertex has numbers that are not finite";
    assert_eq!(said(|model| model.mesh.positions[1].x = f32::NAN), not_finite);
    assert_eq!(
        said(|model| model.mesh.coordinates[1] = vec2(0.0, f32::INFINITY)),
        not_finite
    );
}

#[test]
fn materials() {
    assert_eq!(said(|model| model.materials.clear()), "there is no material");
    assert_eq!(said(|model| model.material_ids = vec![1]), "there is no material 1");
    assert_eq!(
        said(|model| model.material_ids = vec![0; 2]),
        "not every triangle has a material"
    );
    assert_eq!(said(|model| model.planes[0].material = 1), "there is no material 1");
    assert_eq!(
        said(|model| model.materials[0].bump = 1),
        "material 0: there is no texture 1"
    );
    let not_finite = "material 0: it has numbers that are not finite";
    assert_eq!(said(|model| model.materials[0].mirror.y = f32::NAN), not_finite);
    assert_eq!(said(|model| model.materials[0].bump_height = f32::INFINITY), not_finite);
    assert_eq!(
        said(|model| model.materials[0].ior = 0.0),
        "material 0: its index of refraction is not above 0"
    );
    assert_eq!(
        said(|model| model.mesh.coordinates.clear()),
        "a texture lies on triangles without coordinates"
    );
}

#[test]
fn textures() {
    assert_eq!(
        said(|model| model.textures[0].kind = 9),
        "texture 0: there is no kind 9"
    );
    for repeats in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert_eq!(
            said(|model| model.textures[0].repeats = repeats),
            format!("texture 0: it is repeated {repeats} times")
        );
    }
    assert_eq!(
        said(|model| model.textures[0].width = 0),
        "texture 0: an image cannot have 0 times 2 texels"
    );
    for first in [1, u32::MAX] {
        assert_eq!(
            said(|model| model.textures[0].first = first),
            "texture 0: the image has too few texels"
        );
    }
}

#[test]
fn lights() {
    assert_eq!(said(|model| model.lights[0].kind = 3), "light 0: there is no kind 3");
    let not_finite = "it has numbers that are not finite";
    assert_eq!(
        said(|model| model.lights[0].color.x = f32::NAN),
        format!("light 0: {not_finite}")
    );
    assert_eq!(
        said(|model| model.lights[2].position.x = f32::NAN),
        format!("light 2: {not_finite}")
    );
    assert_eq!(
        said(|model| model.lights[2].position = Vec3::ZERO),
        "light 2: it comes from nowhere"
    );
    assert_eq!(
        said(|model| model.lights[1].edge_v = Vec3::X * 2.0),
        "light 1: it has no area"
    );
    for side in [0, 65_536] {
        assert_eq!(
            said(|model| model.lights[1].samples_per_side = side),
            format!("light 1: it has {side} samples along each edge")
        );
    }
}

#[test]
fn planes_and_surroundings() {
    assert_eq!(
        said(|model| model.planes[0].normal = Vec3::ZERO),
        "plane 0: its normal is no unit vector"
    );
    assert_eq!(
        said(|model| model.planes[0].tangent = vec3(f32::NAN, 0.0, 0.0)),
        "plane 0: its tangent is no unit vector"
    );
    assert_eq!(
        said(|model| model.planes[0].offset = f32::INFINITY),
        "plane 0: its offset is not finite"
    );
    let no_image = |id| format!("the environment's texture {id} is no image");
    assert_eq!(said(|model| model.environment.texture = 1), no_image(1));
    assert_eq!(
        said(|model| {
            model.textures[0].kind = WAVES;
            model.environment.texture = 0;
        }),
        no_image(0)
    );
    assert_eq!(
        said(|model| model.environment.horizon.z = f32::NAN),
        "the environment has numbers that are not finite"
    );
    assert_eq!(
        said(|model| model.environment.up = Vec3::ZERO),
        "the environment's upwards is no unit vector"
    );
    assert_eq!(
        said(|model| model.ambient.x = f32::NAN),
        "the ambient light is not finite"
    );
    let nothing = Focus {
        center: Vec3::ZERO,
        radius: 0.0,
    };
    assert_eq!(
        said(|model| model.focus = Some(nothing)),
        "what is looked at has no place or size"
    );
}

#[test]
fn more_materials_than_are_told_apart_are_refused() {
    let of = |count: u32| {
        let mut model = model();
        model.materials = vec![model.materials[0]; count as usize];
        Scene::of_model(model, &StructureOptions::default(), &silent)
    };
    let refused = of(MAX_MATERIALS + 1).err().map(|error| error.to_string());
    assert!(refused.is_some_and(|said| said.starts_with("The scene has 65536 materials, and at most 65535")));
    assert!(of(MAX_MATERIALS).is_ok());
}
