//! Scene files: those that come with oktant, broken ones and what is said about them, and what becomes of their shapes.

#![cfg(test)]

use glam::{Vec3, vec3};
use oktant::octree::OctreeOptions;
use oktant::progress::silent;
use oktant::scene::Scene;
use oktant::scene_file::{self, SceneFileError};
use oktant::source::Setting;
use oktant_shared::light::{AREA, DIRECTIONAL};
use oktant_shared::material::{FRESNEL, PHONG_HIGHLIGHTS, SMOOTH_NORMALS};
use oktant_shared::orbit::Up;
use oktant_shared::texture::{CHECKERBOARD, SHARED_EXPONENT_IMAGE, SRGB_IMAGE};
use oktant_tests::program::run;
use std::collections::HashMap;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::{TempDir, tempdir};

fn project() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The scene files of a folder, by name.
fn scenes(folder: &Path) -> Vec<PathBuf> {
    let mut scenes: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    scenes.sort();
    scenes
}

/// Reads a scene file with this content, in a folder of its own.
fn read_in(folder: &TempDir, content: &str) -> Result<Setting, SceneFileError> {
    let path = folder.path().join("scene.toml");
    fs::write(&path, content).unwrap();
    scene_file::read(&path, &silent)
}

#[track_caller]
fn read(content: &str) -> Setting {
    read_in(&tempdir().unwrap(), content).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn the_scenes_that_come_with_oktant_are_sound() {
    let folder = project().join("assets/scenes");
    let scenes = scenes(&folder);
    let mut counts = HashMap::new();
    for scene in &scenes {
        let setting = scene_file::read(scene, &silent).unwrap_or_else(|error| panic!("{error}"));
        let name = scene.file_stem().unwrap().to_str().unwrap().to_string();
        counts.insert(name, setting.model.mesh.triangles.len());
        assert!(setting.files.contains(scene));
        Scene::of_model(setting.model, &OctreeOptions::default(), &silent).unwrap();
    }
    assert_eq!(counts["balls"], 4_032, "the count of the thesis");
    assert_eq!(counts["bunny"], 69_451);
    for name in ["mirrors", "cornell", "glass", "stadium"] {
        assert!(counts.contains_key(name), "{name}");
    }
    // And as a person would ask.
    let run = run(&folder, [&["check".into()][..], &scenes].concat());
    assert_eq!(run.code, Some(0), "{}", run.error);
    assert_eq!(run.output.lines().count(), scenes.len());
    for line in run.output.lines() {
        assert!(line.ends_with(": ok"), "{line}");
    }
}

/// The messages are in `tests/goldens/broken-scenes.txt`. After a wanted change, write them anew with
/// `OKTANT_BLESS=1 cargo test --release --workspace --test scene_file` and read the difference.
#[test]
fn broken_scenes_are_explained() {
    let folder = project().join("tests/broken-scenes");
    let golden = project().join("tests/goldens/broken-scenes.txt");
    let mut messages = String::new();
    for scene in scenes(&folder) {
        let name = scene.file_name().unwrap().to_str().unwrap();
        let error = scene_file::read(&scene, &silent).expect_err(name).to_string();
        let message = error.replace(&format!("{}/", folder.display()), "");
        assert!(message.starts_with(&format!("{name}:")), "{message}");
        assert!(!message.contains('\n'), "one sentence: {message}");
        writeln!(messages, "{message}").unwrap();
    }
    if std::env::var_os("OKTANT_BLESS").is_some() {
        fs::create_dir_all(golden.parent().unwrap()).unwrap();
        fs::write(&golden, &messages).unwrap();
    }
    let wanted = fs::read_to_string(&golden).unwrap_or_default();
    assert_eq!(
        messages,
        wanted,
        "what is said about broken scenes is not what {} says",
        golden.display()
    );
}

#[test]
fn the_page_about_scene_files_is_complete() {
    let page = fs::read_to_string(project().join("docs/scene-files.md")).unwrap();
    let examples: Vec<_> = page.split("```toml\n").skip(1).collect();
    assert_eq!(examples.len(), 2);
    for example in examples {
        read(example.split("```").next().unwrap());
    }
    // Who asks for a field unlike all others is told which there are.
    let odd = "qqqqqqqqqqqqqqqq = 1\n";
    for table in [
        "",
        "[camera]",
        "[environment]",
        "[render]",
        "[stereo]",
        "[materials.NAME]",
        "[textures.NAME]",
        "[[mesh]]",
        "[[sphere]]",
        "[[box]]",
        "[[quad]]",
        "[[checkerboard]]",
        "[[lathe]]",
        "[[plane]]",
        "[[light]]",
    ] {
        let error = read_in(&tempdir().unwrap(), &format!("{table}\n{odd}"))
            .unwrap_err()
            .to_string();
        let (_, fields) = error.split_once("; there are ").unwrap();
        let section = &page[page
            .find(&format!("`{table}`"))
            .filter(|_| !table.is_empty())
            .unwrap_or_default()..];
        for field in fields
            .split([',', ' '])
            .filter(|word| !word.is_empty() && *word != "and")
        {
            assert!(
                section.contains(&format!("`{field}`")) || section.contains(&format!("[{field}")),
                "{field} of {table} is not on the page"
            );
        }
    }
}

#[test]
fn files_that_are_no_scenes_are_refused() {
    let folder = tempdir().unwrap();
    let missing = scene_file::read(&folder.path().join("missing.toml"), &silent).unwrap_err();
    assert!(missing.to_string().contains("cannot be read"), "{missing}");
    assert!(scene_file::read(folder.path(), &silent).is_err());
    let path = folder.path().join("scene.toml");
    fs::write(&path, [0xff, 0xfe, 0x00]).unwrap();
    let binary = scene_file::read(&path, &silent).unwrap_err();
    assert!(binary.to_string().contains("no text"), "{binary}");
    // The command says the same, with its exit code.
    let failed = run(folder.path(), ["check", "scene.toml"]);
    assert_eq!(failed.code, Some(1));
    assert_eq!(
        failed.error,
        "oktant: scene.toml: this is no text in UTF-8; give a scene file\n"
    );
    assert_eq!(run(folder.path(), ["check"]).code, Some(2), "a usage error");
}

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
    let content = "[environment]\nimage = 'parts/sky.exr'\nstrength = 2\nrotation = 90\n\
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
fn transforms_keep_the_outside_outside() {
    let moved = "scale = [1, -2, 0.5]\nrotate = [30, 40, 50]\ntranslate = [5, 6, 7]\n";
    for content in [
        format!("[[mesh]]\nname = 'balls'\n{moved}"),
        "up = 'z'\n[[sphere]]\ncenter = [1, 2, 3]\nradius = 2\nrotate = [10, 20, 30]\n".into(),
        "[[box]]\ncenter = [1, 2, 3]\nsize = [1, 2, 3]\nrotate = [10, 20, 30]\n".into(),
    ] {
        let mesh = read(&content).model.mesh;
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|i| mesh.positions[i as usize]);
            let normal = triangle.map(|i| mesh.normals[i as usize]).iter().sum::<Vec3>();
            let face = (b - a).cross(c - a).normalize();
            assert!(face.dot(normal.normalize()) > 0.8, "{content}: {face} and {normal}");
        }
        for normal in &mesh.normals {
            assert!((normal.length() - 1.0).abs() < 1e-5);
        }
    }
    // Scaled, then turned about x, y and z, then moved.
    let moved = read("[[mesh]]\nname = 'balls'\nscale = 2\nrotate = [90, 0, 90]\ntranslate = [0, 0, 1]\n");
    let plain = read("[[mesh]]\nname = 'balls'\n").model.mesh.positions;
    for (moved, plain) in moved.model.mesh.positions.iter().zip(plain) {
        // About x: (x, -z, y); about z: (z, x, y).
        let wanted = vec3(plain.z, plain.x, plain.y) * 2.0 + Vec3::Z;
        assert!(moved.distance(wanted) < 1e-5, "{plain} became {moved}");
    }
}

#[test]
fn shapes_have_their_stated_triangles() {
    for (content, count) in [
        ("[[sphere]]\n", 1520),
        ("[[sphere]]\ntriangles = 8\n", 8),
        ("[[sphere]]\ntriangles = 1000\n", 960),
        ("[[sphere]]\ntriangles = 1000000\n", 4 * 500 * 499),
        ("[[box]]\n", 12),
        ("[[quad]]\nedge_u = [1, 0, 0]\nedge_v = [0, 1, 0]\n", 2),
        (
            "[materials.a]\n[materials.b]\n[[checkerboard]]\nsquares = [5, 7]\nmaterials = ['a', 'b']\n",
            70,
        ),
        (
            "[[lathe]]\nprofile = [[0, 0], [1, 0], [1, 2], [0, 2]]\nslices = 10\n",
            40,
        ),
        ("[[mesh]]\nname = 'stadium'\n", 55_680),
        ("[[plane]]\n", 0),
    ] {
        let model = read(content).model;
        assert_eq!(model.mesh.triangles.len(), count, "{content}");
        assert!(model.material_ids.is_empty() || model.material_ids.len() == count);
    }
}

#[test]
fn closed_shapes_are_closed() {
    for content in [
        "[[sphere]]\n",
        "[[sphere]]\ntriangles = 8\n",
        "[[sphere]]\ncenter = [100, 0.1, 3]\nradius = 0.3\ntriangles = 5000\nrotate = [1, 2, 3]\n",
        "[[box]]\nrotate = [10, 20, 30]\n",
        "[[lathe]]\nprofile = [[0, 0], [1, 0], [1, 2], [0, 2]]\n",
        "[[lathe]]\nprofile = [[1, 0], [1.5, 0], [1.5, 2], [1, 2], [1, 0]]\n",
        "[[mesh]]\nname = 'stadium'\n",
    ] {
        let mesh = read(content).model.mesh;
        let mut edges: HashMap<_, i32> = HashMap::new();
        let bits = |i: u32| mesh.positions[i as usize].to_array().map(|x| (x + 0.0).to_bits());
        for &[a, b, c] in &mesh.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                *edges.entry((bits(from), bits(to))).or_default() += 1;
            }
        }
        for (&(from, to), &count) in &edges {
            assert_eq!(count, 1, "{content}: an edge is there twice in the same direction");
            assert!(edges.contains_key(&(to, from)), "{content}: an edge has one side only");
        }
    }
}

#[test]
fn a_checkerboard_alternates() {
    let content = "[materials.a]\nbase = 0\n[materials.b]\n[[checkerboard]]\nsize = [3, 2]\nsquares = [3, 2]\n\
                   materials = ['a', 'b']\n";
    let model = read(content).model;
    for (triangle, id) in model.mesh.triangles.iter().zip(&model.material_ids) {
        let middle = triangle.map(|i| model.mesh.positions[i as usize]).iter().sum::<Vec3>() / 3.0;
        let square = (middle.x + 1.5).floor() + (middle.z + 1.0).floor();
        assert_eq!(*id, square as u32 % 2, "at {middle}");
    }
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
            let scene = Scene::of_model(setting.model, &OctreeOptions::default(), &silent).unwrap();
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
             falloff = 'inverse-square'\nradius = 0.2",
        );
        assert_eq!(
            (area.light.kind, area.light.samples_per_side, area.light.falloff_radius),
            (AREA, 3, 0.2)
        );
        assert!(area.light.position.distance(vec3(1.0, 5.0, 2.0)) < 1e-5);
        let sun = frame("kind = 'directional'\ndirection = [1, -2, 2]");
        assert_eq!(sun.light.kind, DIRECTIONAL);
        assert!(sun.light.position.distance(vec3(-1.0, 2.0, -2.0) / 3.0) < 1e-6);
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
