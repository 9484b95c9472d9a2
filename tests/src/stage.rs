//! Scenes that a test puts together by hand, and rays and pictures of them.

use crate::meshes::block;
use bytemuck::Zeroable;
use glam::{DVec3, Vec2, Vec3, Vec4, vec3};
use oktant::backend::Backend;
use oktant::backend::cpu::Cpu;
use oktant::media::media_at;
use oktant::mesh::Mesh;
use oktant::model::Model;
use oktant::picture::Picture;
use oktant::progress::silent;
use oktant::scene::Scene;
use oktant::structure::StructureOptions;
use oktant_shared::camera::Camera;
use oktant_shared::environment::Environment;
use oktant_shared::frame::{Frame, TRANSPARENT};
use oktant_shared::hit::Hit;
use oktant_shared::light::{DIRECTIONAL, Light, POINT};
use oktant_shared::material::Material;
use oktant_shared::plane::Plane;
use oktant_shared::ray::Ray;
use oktant_shared::texture::{NO_TEXTURE, SRGB_IMAGE, Texture};
use oktant_shared::traversal::Standard;
use oktant_shared::variant::EVERYTHING;
use oktant_shared::whitted::{MAX_DEPTH, Traced, trace};
use std::ops::Range;
use std::sync::Arc;

/// A material that sends nothing to the eye.
pub fn black() -> Material {
    Material {
        base: Vec3::ONE,
        ior: 1.0,
        texture: NO_TEXTURE,
        bump: NO_TEXTURE,
        ..Material::zeroed()
    }
}

/// A perfectly diffuse one of a colour, which also shows the scene's ambient light.
pub fn matte(base: Vec3) -> Material {
    Material {
        base,
        ambient: 1.0,
        diffuse: 1.0,
        ..black()
    }
}

/// One that shines by itself as brightly as the scene's ambient light, times the texture.
pub fn glowing(texture: u32) -> Material {
    Material {
        ambient: 1.0,
        texture,
        ..black()
    }
}

/// One that reflects everything.
pub fn mirror() -> Material {
    Material {
        mirror: Vec3::ONE,
        ..black()
    }
}

/// One that lets everything through; no Fresnel weights.
pub fn clear(ior: f32) -> Material {
    Material {
        transmission: Vec3::ONE,
        ior,
        ..black()
    }
}

/// A point light without falloff.
pub fn point_light(position: Vec3, color: Vec3) -> Light {
    Light {
        position,
        kind: POINT,
        color,
        samples_per_side: 1,
        ..Light::zeroed()
    }
}

/// A light from far away, in a direction of any length.
pub fn directional_light(towards: Vec3, color: Vec3) -> Light {
    Light {
        kind: DIRECTIONAL,
        ..point_light(towards.normalize(), color)
    }
}

/// A model that is being put together: at first nothing in the dark.
pub struct Stage {
    /// What there is so far.
    pub model: Model,
}

impl Default for Stage {
    fn default() -> Self {
        Stage {
            model: Model {
                materials: Vec::new(),
                lights: Vec::new(),
                environment: Environment::constant(Vec3::ZERO),
                ambient: Vec3::ZERO,
                ..Model::of_mesh(Mesh::default())
            },
        }
    }
}

impl Stage {
    /// A shiny floor without end, and a block over it.
    pub fn with_block() -> Self {
        let mut stage = Stage::default();
        let shiny = stage.material(Material {
            specular: Vec3::splat(0.3),
            exponent: 12.0,
            ..matte(vec3(0.9, 0.6, 0.3))
        });
        stage.plane(Vec3::ZERO, Vec3::Y, shiny);
        stage.mesh(&block(vec3(-0.6, 0.1, -0.5), vec3(0.5, 1.3, 0.7)), shiny);
        stage
    }

    /// Adds a material; its index.
    pub fn material(&mut self, material: Material) -> u32 {
        self.model.materials.push(material);
        self.model.materials.len() as u32 - 1
    }

    /// Adds a mesh of a material; the ids of its triangles. What it lacks in normals and texture coordinates is zero.
    pub fn mesh(&mut self, mesh: &Mesh, material: u32) -> Range<u32> {
        let whole = &mut self.model.mesh;
        let (vertex, triangle) = (whole.positions.len() as u32, whole.triangles.len() as u32);
        whole.positions.extend(&mesh.positions);
        whole.normals.extend(&mesh.normals);
        whole.normals.resize(whole.positions.len(), Vec3::ZERO);
        whole.coordinates.extend(&mesh.coordinates);
        whole.coordinates.resize(whole.positions.len(), Vec2::ZERO);
        whole.triangles.extend(
            mesh.triangles
                .iter()
                .map(|corners| corners.map(|corner| corner + vertex)),
        );
        let end = whole.triangles.len() as u32;
        self.model.material_ids.resize(end as usize, material);
        triangle..end
    }

    /// Adds a plane.
    pub fn plane(&mut self, point: Vec3, normal: Vec3, material: u32) {
        self.model.planes.push(Plane::new(point, normal, material));
    }

    /// Adds a texture that tells where it is looked at: red is the fraction of `x / period`, green that of `y / period`,
    /// as long as these fractions are 1/4 to 3/4 (see [`Stage::position`]). Its index.
    pub fn position_texture(&mut self, period: f32) -> u32 {
        // Four texels, between whose middles the colour is linear.
        let first = self.model.texels.len() as u32;
        self.model
            .texels
            .extend([0x00_ff_00, 0x00_ff_ff, 0x00_00_00, 0x00_00_ff]);
        self.model.textures.push(Texture {
            first,
            width: 2,
            height: 2,
            kind: SRGB_IMAGE,
            repeats: 1.0 / period,
            reserved: [0; 3],
        });
        self.model.textures.len() as u32 - 1
    }

    /// The texture coordinates at which a [`Stage::position_texture`] has a colour.
    pub fn position(color: Vec3, period: f32) -> [f64; 2] {
        [color.x, color.y].map(|channel| (f64::from(channel) + 0.5) / 2.0 * f64::from(period))
    }

    /// The scene.
    ///
    /// # Panics
    /// Where the model is not valid.
    pub fn build(self) -> Arc<Scene> {
        let scene = Scene::of_model(self.model, &StructureOptions::default(), &silent);
        Arc::new(scene.expect("the model of a test is valid"))
    }
}

/// A frame of one sample a pixel that follows every ray as far as can be.
pub fn frame(scene: &Scene, camera: Camera) -> Frame {
    Frame {
        camera,
        root: scene.root,
        light: scene.light,
        environment: scene.environment,
        ambient: scene.ambient,
        features: if scene.is_transparent() { TRANSPARENT } else { 0 },
        samples: 1,
        samples_per_side: 1,
        sample_count: 1,
        light_count: scene.light_count,
        plane_count: scene.plane_count,
        depth: MAX_DEPTH,
        cutoff: 0.0,
        brightest: scene.brightest(&scene.light),
        exposure: 1.0,
        media: media_at(scene, camera.eye).to_eye(),
        ..Frame::zeroed()
    }
}

/// A camera that looks from one point to another, upright, with the vertical field of view in degrees and the picture's
/// size in pixels.
pub fn camera(eye: Vec3, target: Vec3, field_of_view: f32, width: u32, height: u32) -> Camera {
    let forward = (target - eye).normalize();
    let upwards = if forward.y.abs() < 0.99 { Vec3::Y } else { Vec3::Z };
    let right = forward.cross(upwards).normalize();
    let half_height = (field_of_view.to_radians() / 2.0).tan();
    Camera {
        eye,
        width,
        right: right * (half_height * width as f32 / height as f32),
        height,
        up: right.cross(forward) * half_height,
        eye_shift: 0.0,
        forward,
        convergence: eye.distance(target),
        ..Camera::zeroed()
    }
}

/// What a ray sees.
pub fn see(scene: &Scene, frame: &Frame, ray: &Ray) -> Traced {
    trace::<Standard, EVERYTHING>(frame, &scene.world(), ray)
}

/// The direction in which a ray leaves a scene that does nothing but bend it.
///
/// The environment is made to shine with each component of the direction in turn, also with negative light.
pub fn leaves_towards(scene: &Scene, frame: &Frame, ray: &Ray) -> DVec3 {
    let along = |up: Vec3| {
        let environment = Environment {
            zenith: Vec3::ONE,
            nadir: Vec3::NEG_ONE,
            up,
            ..Environment::constant(Vec3::ZERO)
        };
        let frame = Frame { environment, ..*frame };
        f64::from(see(scene, &frame, ray).color.x)
    };
    DVec3::new(along(Vec3::X), along(Vec3::Y), along(Vec3::Z))
}

/// The picture of a frame, by the CPU.
pub fn picture(scene: &Arc<Scene>, frame: &Frame) -> Picture {
    let picture = Cpu::new(scene.clone()).render(frame, &silent);
    picture.expect("the CPU renders everything")
}

/// What each pixel of a frame sees first, by the CPU.
pub fn hits(scene: &Arc<Scene>, frame: &Frame) -> Vec<Hit> {
    let hits = Cpu::new(scene.clone()).hits(frame);
    hits.expect("the CPU casts everything")
}

/// The mean colour of a pixel from its sum.
pub fn mean(sum: Vec4) -> Vec3 {
    sum.truncate() / sum.w
}
