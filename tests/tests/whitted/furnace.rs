//! The white furnace: where light comes from everywhere alike and nothing absorbs, nothing can be seen.

use glam::{Vec3, vec3};
use oktant::balls::balls;
use oktant::mesh::Mesh;
use oktant_shared::environment::Environment;
use oktant_shared::material::{FRESNEL, Material, SMOOTH_NORMALS};
use oktant_tests::meshes::{ball, block, icosphere, torus};
use oktant_tests::stage::{Stage, black, camera, clear, frame, hits, matte, mean, mirror, picture};

/// What a furnace came to.
struct Furnace {
    /// Pixels that show the mesh.
    pixels: usize,
    /// Largest difference of a channel from white.
    off_white: f32,
    /// Pixels of which more than 1e-3 was cut.
    cut: usize,
}

fn furnace(mesh: &Mesh, material: Material) -> Furnace {
    let mut stage = Stage::default();
    stage.material(material);
    stage.mesh(mesh, 0);
    stage.model.environment = Environment::constant(Vec3::ONE);
    stage.model.ambient = Vec3::ONE;
    let scene = stage.build();
    let eye = scene.focus.center + vec3(0.4, 0.7, 1.0).normalize() * (2.4 * scene.focus.radius);
    let frame = frame(&scene, camera(eye, scene.focus.center, 50.0, 160, 160));
    let seen = hits(&scene, &frame);
    let picture = picture(&scene, &frame);
    let mut furnace = Furnace {
        pixels: 0,
        off_white: 0.0,
        cut: 0,
    };
    for ((hit, sum), work) in seen.iter().zip(&picture.sums).zip(&picture.work) {
        if !hit.is_hit() {
            assert_eq!(mean(*sum), Vec3::ONE);
            continue;
        }
        furnace.pixels += 1;
        furnace.off_white = furnace.off_white.max((mean(*sum) - 1.0).abs().max_element());
        furnace.cut += usize::from(work.z > 1e-3);
    }
    furnace
}

fn meshes() -> [(&'static str, Mesh); 6] {
    [
        ("box", block(vec3(-1.0, -0.7, -0.4), vec3(1.0, 0.7, 0.4))),
        ("icosphere", icosphere(3)),
        ("coarse smooth ball", ball(Vec3::ZERO, 1.0, 16, 8)),
        ("smooth ball", ball(Vec3::ZERO, 1.0, 64, 32)),
        ("torus", torus(1.0, 0.4, 48, 24)),
        ("balls", balls()),
    ]
}

fn glass(flags: u32) -> Material {
    Material {
        flags: FRESNEL | flags,
        ..clear(1.5)
    }
}

/// Oracle: conservation of energy. Matte surfaces of albedo 1 in white ambient light, mirrors, glass and what is a bit of
/// each are white to 1e-3, also where rays are cut after sixteen reflections and refractions: these see the environment.
#[test]
fn everything_stays_white() {
    let half = Material {
        ambient: 0.25,
        mirror: Vec3::splat(0.25),
        transmission: Vec3::splat(0.5),
        ior: 1.5,
        flags: FRESNEL | SMOOTH_NORMALS,
        ..black()
    };
    let smooth_mirror = Material {
        flags: SMOOTH_NORMALS,
        ..mirror()
    };
    let materials = [
        ("matte", matte(Vec3::ONE)),
        ("mirror", mirror()),
        ("smooth mirror", smooth_mirror),
        ("flat glass", glass(0)),
        ("smooth glass", glass(SMOOTH_NORMALS)),
        ("a bit of each", half),
    ];
    for (mesh_name, mesh) in meshes() {
        for (name, material) in &materials {
            let furnace = furnace(&mesh, *material);
            println!(
                "{mesh_name} of {name}: {} pixels, off white by {:.1e}, {} cut",
                furnace.pixels, furnace.off_white, furnace.cut
            );
            assert!(furnace.pixels > 3_000);
            assert!(furnace.off_white <= 1e-3);
        }
    }
}
