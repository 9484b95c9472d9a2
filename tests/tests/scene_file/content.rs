//! What becomes of materials, textures, camera and lights.

use super::{read, read_in};
use glam::{Vec3, vec3};
use oktant::progress::silent;
use oktant::scene::Scene;
use oktant::structure::StructureOptions;
use oktant_shared::light::{AREA, DIRECTIONAL};
use oktant_shared::material::{FRESNEL, PHONG_HIGHLIGHTS, SMOOTH_NORMALS};
use oktant_shared::orbit::Up;
use oktant_shared::texture::{CHECKERBOARD, HEIGHT_IMAGE, NO_TEXTURE, SHARED_EXPONENT_IMAGE, SRGB_IMAGE};
use oktant_tests::stage::{mean, picture};
use std::fs;
use std::sync::Arc;
use tempfile::tempdir;

#[test]
fn paths_are_relative_to_the_scene() {
    let folder = tempdir().unwrap();
    fs::create_dir(folder.path().join("parts")).unwrap();
    let triangle = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                    element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    fs::write(folder.path().join("parts/triangle.ply"), triangle).unwrap();
    image::RgbImage::from_pixel(2, 3, image::Rgb([255, 0, 0]))
        .save(folder.path().join("parts/red.png"))
        .unwrap();
    image::Rgb32FImage::from_pixel(4, 2, image::Rgb([3.0, 0.5, -1.0]))
        .save(folder.path().join("parts/sky.exr"))
        .unwrap();
    let content = "[environment]\nimage = 'parts/sky.exr'\nstrength = 2\nrotation = 720090\n\
                   [textures.red]\nfile = 'parts/red.png'\n[[mesh]]\nfile = 'parts/triangle.ply'\n\
                   [[mesh]]\nfile = 'parts/triangle.ply'\ntranslate = [2, 0, 0]\n";
    let setting = read_in(&folder, content).unwrap();
    let mut names: Vec<_> = setting
        .files
        .iter()
        .map(|file| file.strip_prefix(folder.path()).unwrap().to_str().unwrap())
        .collect();
    names.sort_unstable();
    assert_eq!(
        names,
        ["parts/red.png", "parts/sky.exr", "parts/triangle.ply", "scene.toml"]
    );
    let model = &setting.model;
    assert_eq!(model.mesh.triangles, [[0, 1, 2], [3, 4, 5]]);
    assert_eq!(model.mesh.positions[4], vec3(3.0, 0.0, 0.0));
    let kinds: Vec<_> = model.textures.iter().map(|texture| texture.kind).collect();
    assert_eq!(kinds, [SRGB_IMAGE, SHARED_EXPONENT_IMAGE]);
    assert_eq!((model.environment.texture, model.environment.strength), (1, 2.0));
    assert_eq!(model.environment.rotation, 0.25);
    assert_eq!((model.texels.len(), model.texels[0]), (6 + 8, 255));
    let sky = model.textures[1].color(&model.texels, glam::vec2(0.5, 0.5));
    assert!(sky.abs_diff_eq(vec3(3.0, 0.5, 0.0), 0.01), "{sky}");
}

#[test]
fn materials_are_as_described() {
    let content = "[textures.squares]\nkind = 'checkerboard'\ncolors = ['#102030', 1]\nrepeats = 4\n\
                   [materials.plain]\n\
                   [materials.mirror]\nmirror = 0.6\nhighlight = 'phong'\nsmooth = false\n\
                   [materials.glass]\ntransmission = [0.9, 0.8, 0.7]\nabsorption = 3\nior = 1.33\npriority = 7\n\
                   [materials.tiles]\ntexture = 'squares'\nbump = 'squares'\nbump_height = -0.2\n\
                   [materials.unused]\n\
                   [[sphere]]\nmaterial = 'plain'\n[[sphere]]\nmaterial = 'mirror'\n\
                   [[sphere]]\nmaterial = 'glass'\n[[sphere]]\nmaterial = 'tiles'\n[[sphere]]\n";
    let model = read(content).model;
    let [plain, mirror, glass, tiles, clay] = model.materials[..] else {
        panic!("{} materials", model.materials.len());
    };
    assert_eq!((plain.base, plain.diffuse, plain.flags & FRESNEL), (Vec3::ONE, 0.85, 0));
    // What is mirrored is neither reflected evenly nor lit by ambient light.
    assert!((mirror.diffuse - 0.85 * 0.4).abs() < 1e-6 && (mirror.ambient - 0.4).abs() < 1e-6);
    assert_eq!(mirror.flags & (PHONG_HIGHLIGHTS | SMOOTH_NORMALS), PHONG_HIGHLIGHTS);
    assert_eq!(
        (glass.transmission, glass.absorption),
        (vec3(0.9, 0.8, 0.7), Vec3::splat(3.0))
    );
    assert_eq!((glass.ior, glass.priority, glass.flags & FRESNEL), (1.33, 7, FRESNEL));
    assert_eq!((tiles.texture, tiles.bump, tiles.bump_height), (0, 0, -0.2));
    assert!(clay.base.x < 1.0);
    let squares = model.textures[0];
    assert_eq!(
        (squares.kind, squares.width, squares.height),
        (CHECKERBOARD, 0x30_20_10, 0xff_ff_ff)
    );
    assert_eq!(squares.repeats, 4.0);
    assert_eq!(model.mesh.coordinates.len(), model.mesh.positions.len());
}

/// Oracle: the numbers that were written, which neither format rounds.
#[test]
fn what_is_around_in_an_hdr_file_is_what_is_seen() {
    let folder = tempdir().unwrap();
    let (above, below) = (vec3(8.0, 0.5, 2.0), vec3(0.25, 4.0, 1.0));
    let halves = image::Rgb32FImage::from_fn(8, 4, |_, y| image::Rgb(if y < 2 { above } else { below }.to_array()));
    halves.save(folder.path().join("sky.hdr")).unwrap();
    let content = "[camera]\nposition = [0, 0, 5]\nlook_at = [0, 0, 10]\nfov = 120\n\
                   [environment]\nimage = 'sky.hdr'\n[[sphere]]\n";
    let setting = read_in(&folder, content).unwrap();
    let scene = Scene::of_model(setting.model, &StructureOptions::default(), &silent).unwrap();
    let frame = setting.view.frame(&scene, 3, 3);
    let picture = picture(&Arc::new(scene), &frame);
    // Between the middles of the image's two rows on either side of the horizon, from 22.5 to 67.5 degrees, nothing is blended.
    for (row, color) in [(0, above), (2, below)] {
        for sum in &picture.sums[3 * row..3 * row + 3] {
            assert!(mean(*sum).distance(color) < 1e-5, "row {row}: {sum}");
        }
    }
}

/// An image is stored as what it is used as: colours, heights, or both.
#[test]
fn bumps_are_heights() {
    let folder = tempdir().unwrap();
    let ramp = image::ImageBuffer::from_fn(300, 2, |x, _| image::Luma([x as u16 * 100 + 7]));
    image::DynamicImage::ImageLuma16(ramp)
        .save(folder.path().join("ramp.png"))
        .unwrap();
    let content = "[textures.a-both]\nfile = 'ramp.png'\n[textures.height]\nfile = 'ramp.png'\nrepeats = 3\n\
                   [textures.unused]\nfile = 'ramp.png'\n\
                   [materials.a]\ntexture = 'a-both'\nbump = 'a-both'\n[materials.b]\nbump = 'height'\n\
                   [[sphere]]\nmaterial = 'a'\n[[sphere]]\nmaterial = 'b'\n";
    let setting = read_in(&folder, content).unwrap();
    let model = &setting.model;
    let kinds: Vec<_> = model.textures.iter().map(|texture| texture.kind).collect();
    assert_eq!(kinds, [SRGB_IMAGE, HEIGHT_IMAGE, HEIGHT_IMAGE, SRGB_IMAGE]);
    let [a, b] = model.materials[..] else {
        panic!("{} materials", model.materials.len());
    };
    assert_eq!((a.texture, a.bump, b.texture, b.bump), (0, 1, NO_TEXTURE, 2));
    assert_eq!((model.textures[1].repeats, model.textures[2].repeats), (1.0, 3.0));
    assert_eq!(setting.files.len(), 2);
    // The ramp has one slope everywhere: neither the steps of 8 bits nor a curve.
    let ramp = model.textures[1];
    for x in 2..298 {
        let slope = ramp.slope(&model.texels, glam::vec2((x as f32 + 0.3) / 300.0, 0.5)).x;
        assert!((slope - 100.0 / 65_535.0 * 300.0).abs() < 1e-4, "{x}: {slope}");
    }
}

/// Wherever a view has the light and the camera, the frame puts them where the file does.
#[test]
fn cameras_and_lights_are_where_the_file_has_them() {
    for up in [Up::Y, Up::Z] {
        let head = format!(
            "up = '{}'\n[camera]\nposition = [3, -4, 5]\nlook_at = [1, 2, 0.5]\nfov = 25\n[[sphere]]\nradius = 3\n[[light]]\n",
            if up == Up::Y { "y" } else { "z" }
        );
        let frame = |light: &str| {
            let setting = read(&format!("{head}{light}\n[[light]]\nposition = [9, 9, 9]\n"));
            let scene = Scene::of_model(setting.model, &StructureOptions::default(), &silent).unwrap();
            assert_eq!(scene.light_count, 1);
            setting.view.frame(&scene, 640, 480)
        };
        let point = frame("position = [-7, 8, 2]\nintensity = 3\ncolor = [1, 0.5, 0]");
        assert!(
            point.camera.eye.distance(vec3(3.0, -4.0, 5.0)) < 1e-5,
            "{}",
            point.camera.eye
        );
        let forward = (vec3(1.0, 2.0, 0.5) - vec3(3.0, -4.0, 5.0)).normalize();
        assert!(point.camera.forward.distance(forward) < 1e-6);
        assert!((point.camera.up.length() - 12.5_f32.to_radians().tan()).abs() < 1e-6);
        assert!(point.light.position.distance(vec3(-7.0, 8.0, 2.0)) < 1e-5);
        assert_eq!(point.light.color, vec3(3.0, 1.5, 0.0));
        let area = frame(
            "kind = 'area'\ncorner = [1, 5, 2]\nedge_u = [2, 0, 0]\nedge_v = [0, 0, 3]\nsamples_per_side = 3\n\
             falloff = 'inverse-square'\nradius = 0.2\nrange = 7.5",
        );
        assert_eq!(
            (area.light.kind, area.light.samples_per_side, area.light.falloff_radius),
            (AREA, 3, 0.2)
        );
        assert_eq!((point.light.range, area.light.range), (0.0, 7.5));
        assert!(area.light.position.distance(vec3(1.0, 5.0, 2.0)) < 1e-5);
        let sun = frame("kind = 'directional'\ndirection = [1, -2, 2]");
        assert_eq!(sun.light.kind, DIRECTIONAL);
        assert!(sun.light.position.distance(vec3(-1.0, 2.0, -2.0) / 3.0) < 1e-6);
    }
}

/// Oracle: the edges of the picture, in scene units. Whatever else a file says of the camera, it shows as much as it says.
#[test]
fn an_orthographic_camera_shows_the_height_of_its_file() {
    for place in [
        "",
        "position = [0, 3, 9]\n",
        "distance = 7\n",
        "look_at = [1, 0, 0]\nelevation = 70\n",
    ] {
        let text =
            |height: &str| format!("[camera]\nprojection = 'orthographic'\n{place}{height}[[sphere]]\nradius = 3\n");
        let heights = ["height = 2.5\n", ""].map(|height| {
            let setting = read(&text(height));
            let scene = Scene::of_model(setting.model, &StructureOptions::default(), &silent).unwrap();
            let frame = setting.view.frame(&scene, 640, 480);
            let [top, bottom] = [0.0, 480.0].map(|y| frame.camera.ray(320.0, y, 0.0));
            assert_eq!(top.direction, bottom.direction);
            let in_perspective = 2.0 * 20.0_f32.to_radians().tan() * frame.camera.convergence;
            (top.origin.distance(bottom.origin), in_perspective)
        });
        assert!((heights[0].0 - 2.5).abs() < 1e-5, "{place}: {heights:?}");
        assert!((heights[1].0 / heights[1].1 - 1.0).abs() < 1e-5, "{place}: {heights:?}");
    }
}

#[test]
fn defaults_are_those_of_a_mesh_alone() {
    let setting = read("[[mesh]]\nname = 'balls'\n");
    assert_eq!(setting.view, Default::default());
    assert_eq!(setting.model.focus, None);
    assert_eq!((setting.model.lights.len(), setting.size), (1, None));
    assert!(read("light = []\n[[sphere]]\n").model.lights.is_empty());
    assert_eq!(read("[render]\nwidth = 100\n[[sphere]]\n").size, Some([100, 968]));
}
