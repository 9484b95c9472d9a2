//! Materials, lights and cameras of glTF in Whitted's model: seen as the physics says that the format prescribes.

use super::Reader;
use super::glb::Glb;
use glam::{DVec3, Vec3, dvec3, vec3};
use oktant::model::Model;
use oktant::progress::silent;
use oktant::scene::Scene;
use oktant::source::Setting;
use oktant::structure::StructureOptions;
use oktant_shared::environment::Environment;
use oktant_shared::ray::Ray;
use oktant_tests::stage::see;
use serde_json::{Value, json};
use std::f64::consts::PI;
use std::sync::Arc;

/// What a file shows, without ambient light, and surrounded by a grey of this brightness.
fn setting(glb: &Glb, around: f32) -> Setting {
    let asset = Reader::Gltf
        .parse(&glb.bytes())
        .unwrap_or_else(|error| panic!("{error}"));
    let has_lights = !asset.lights.is_empty();
    let mut setting = asset.into_setting();
    setting.model.ambient = Vec3::ZERO;
    setting.model.environment = Environment::constant(Vec3::splat(around));
    setting.view.depth = 16;
    setting.view.cutoff = 0.0;
    if !has_lights {
        setting.model.lights.clear();
    }
    setting
}

/// A model as the tree of rays reads it, also where it needs none.
fn scene(model: Model) -> Scene {
    let mut scene = Scene::of_model(model, &StructureOptions::default(), &silent).unwrap();
    Arc::make_mut(&mut scene.material_ids).resize(scene.triangles.len(), 0);
    scene
}

/// The colour that a ray from `eye` to `target` sees.
fn seen(glb: &Glb, around: f32, eye: Vec3, target: Vec3) -> DVec3 {
    let setting = setting(glb, around);
    let scene = scene(setting.model);
    let frame = setting.view.frame(&scene, 8, 8);
    see(&scene, &frame, &Ray::new(eye, target - eye)).color.as_dvec3()
}

#[track_caller]
fn assert_near(is: DVec3, wanted: DVec3) {
    assert!(
        (is - wanted).abs().max_element() <= 2e-5 * (1.0 + wanted.max_element()),
        "{is} instead of {wanted}"
    );
}

/// A matt floor of this colour, without reflections.
fn matt(color: [f64; 3]) -> Glb {
    let [red, green, blue] = color;
    Glb::floor().material(json!({
        "pbrMetallicRoughness": {"baseColorFactor": [red, green, blue, 1.0], "metallicFactor": 0.0},
        "extensions": {"KHR_materials_specular": {"specularFactor": 0.0}},
    }))
}

/// Oracle: a surface of reflectance c under the illuminance E sends on the luminance c E / pi (Lambert); a point light of
/// I candela gives E = I cos / d^2.
#[test]
fn a_point_light_lights_a_matt_floor() {
    let light = json!({"type": "point", "intensity": 7.0, "color": [1.0, 0.5, 0.25]});
    // The first light's place goes through the view, the second one's does not.
    let glb = matt([0.5, 0.25, 1.0])
        .light(
            light.clone(),
            json!({"translation": [0.5, 2.0, 0.25], "scale": [3.0, 3.0, 3.0]}),
        )
        .light(
            light,
            json!({"translation": [-0.75, 1.0, 0.0], "rotation": [1.0, 0.0, 0.0, 0.0]}),
        );
    for (x, z) in [(0.5, 0.25), (-0.75, 0.5), (0.9, -0.9)] {
        let mut wanted = DVec3::ZERO;
        for position in [dvec3(0.5, 2.0, 0.25), dvec3(-0.75, 1.0, 0.0)] {
            let towards = position - dvec3(f64::from(x), 0.0, f64::from(z));
            let illuminance = dvec3(1.0, 0.5, 0.25) * 7.0 * towards.normalize().y / towards.length_squared();
            wanted += dvec3(0.5, 0.25, 1.0) * illuminance / PI;
        }
        assert_near(seen(&glb, 0.0, vec3(0.1, 3.0, 0.2), vec3(x, 0.0, z)), wanted);
    }
}

/// Oracle: as above, times 1 - (distance / range)^4 (KHR_lights_punctual). A range beyond f32 is none.
#[test]
fn a_point_light_fades_out_at_its_range() {
    for (range, part) in [(2.5, 1.0 - 0.8_f64.powi(4)), (2.0, 0.0), (1.0, 0.0), (1e300, 1.0)] {
        let light = json!({"type": "point", "intensity": 7.0, "range": range});
        let glb = matt([0.5; 3]).light(light, json!({"translation": [0.25, 2.0, 0.5]}));
        let wanted = DVec3::splat(0.5 * 7.0 / 4.0 / PI * part);
        assert_near(seen(&glb, 0.0, vec3(0.1, 3.0, 0.2), vec3(0.25, 0.0, 0.5)), wanted);
    }
}

/// Oracle: as above, with E = lux times the cosine. Turned by 60 degrees, it comes from 60 degrees above the horizon.
#[test]
fn a_directional_light_lights_a_matt_floor() {
    let half = (-PI / 6.0).sin();
    let light = json!({"type": "directional", "intensity": 3.0});
    let glb = matt([0.5; 3]).light(light, json!({"rotation": [half, 0.0, 0.0, (1.0 - half * half).sqrt()]}));
    let wanted = DVec3::splat(0.5 * 3.0 / PI * (PI / 3.0).sin());
    assert_near(seen(&glb, 0.0, vec3(0.1, 3.0, 0.2), vec3(0.2, 0.0, 0.1)), wanted);
}

#[test]
fn a_camera_sees_what_its_file_says() {
    let half = (-PI / 12.0).sin();
    let mut glb = Glb::floor().node(json!({
        "camera": 0, "translation": [1.0, 2.0, 5.0], "rotation": [half, 0.0, 0.0, (1.0 - half * half).sqrt()],
    }));
    glb.json["cameras"] =
        json!([{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1, "aspectRatio": 1.5}}]);
    let setting = setting(&glb, 0.0);
    let scene = scene(setting.model);
    let camera = setting.view.frame(&scene, 300, 200).camera;
    // Turned down by 30 degrees from -z.
    let forward = vec3(0.0, -0.5, -(PI / 6.0).cos() as f32);
    assert!(camera.eye.distance(vec3(1.0, 2.0, 5.0)) < 1e-5, "{}", camera.eye);
    assert!(camera.forward.distance(forward) < 1e-6, "{}", camera.forward);
    let top = camera.ray(150.0, 0.0, 0.0).direction.normalize();
    assert!((top.dot(forward).acos() - 0.35).abs() < 1e-5);
    assert!(top.y > forward.y);
}

#[test]
fn a_camera_without_perspective_sees_as_much_as_its_file_says() {
    let half = (-PI / 12.0).sin();
    let mut glb = Glb::floor().node(json!({
        "camera": 0, "translation": [1.0, 2.0, 5.0], "rotation": [half, 0.0, 0.0, (1.0 - half * half).sqrt()],
    }));
    glb.json["cameras"] =
        json!([{"type": "orthographic", "orthographic": {"xmag": 3.0, "ymag": 1.25, "znear": 0.1, "zfar": 50.0}}]);
    let setting = setting(&glb, 0.0);
    let scene = scene(setting.model);
    let camera = setting.view.frame(&scene, 300, 200).camera;
    let forward = vec3(0.0, -0.5, -(PI / 6.0).cos() as f32);
    let [top, middle, bottom] = [0.0, 100.0, 200.0].map(|y| camera.ray(150.0, y, 0.0));
    assert!(middle.origin.distance(vec3(1.0, 2.0, 5.0)) < 1e-5, "{}", middle.origin);
    for ray in [top, middle, bottom] {
        assert!(ray.direction.distance(forward) < 1e-6, "{}", ray.direction);
    }
    assert!((top.origin.distance(bottom.origin) - 2.5).abs() < 1e-5);
    assert!(top.origin.y > bottom.origin.y);
}

/// A closed box of the size 4 x 1 x 4, its top at y = 0.
fn slab(material: Value) -> Glb {
    let corner = |i: usize| [[-2.0, 2.0][i & 1], [-1.0, 0.0][i >> 1 & 1], [-2.0, 2.0][i >> 2]];
    let positions: Vec<[f32; 3]> = (0..8).map(corner).collect();
    let faces = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    let triangles: Vec<[u16; 3]> = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Glb::new(&positions, &triangles).material(material)
}

fn glass(volume: Value) -> Value {
    json!({
        "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.0},
        "extensions": {
            "KHR_materials_transmission": {"transmissionFactor": 1.0},
            "KHR_materials_ior": {"ior": 1.5},
            "KHR_materials_volume": volume,
        },
    })
}

/// Oracle: the geometric series of a plane-parallel plate. Fresnel's reflectance of the index 1.5 at normal incidence is
/// 0.04; along the thickness 1, of light that is coloured `c` after the distance 2, the part c^(1/2) is left. All around is
/// a grey of 1, so that what is reflected and what goes through add up.
#[test]
fn a_volume_refracts_and_absorbs() {
    let volume = json!({"thicknessFactor": 1.0, "attenuationDistance": 2.0, "attenuationColor": [1.0, 0.25, 0.01]});
    let is = seen(&slab(glass(volume)), 1.0, vec3(0.1, 3.0, 0.2), vec3(0.1, 0.0, 0.2));
    let wanted = dvec3(1.0, 0.25, 0.01).map(|color: f64| {
        let (part, reflected) = (color.sqrt(), 0.04_f64);
        let inside = (1.0 - reflected).powi(2) / (1.0 - (reflected * part).powi(2));
        reflected + inside * reflected * part * part + inside * part
    });
    assert_near(is, wanted);
}

/// Oracle: Snell's law. A ray at 45 degrees leaves the slab parallel to how it came, moved by d sin(a - b) / cos(b): so of
/// the gradient around it sees what it would see without the slab, but for what is reflected. Its path is found by hand
/// below a second, opaque floor, whose edge it hits or misses.
#[test]
fn a_volume_bends_light_and_what_is_thin_does_not() {
    let thick = slab(glass(json!({"thicknessFactor": 1.0})));
    let thin = slab(glass(json!({})));
    let (entering, inside) = (PI / 4.0, ((PI / 4.0).sin() / 1.5).asin());
    for (glb, angle) in [(thick, inside), (thin, entering)] {
        // Where the ray leaves the slab, one below: tan of the angle in there.
        let leaves = angle.tan();
        for (offset, is_hit) in [(-0.01, true), (0.01, false)] {
            // A black floor right under the slab that ends just before or after that place.
            let mut glb = glb.clone();
            let edge = (leaves - offset) as f32;
            let floor = [
                [-9.0, -1.001, -9.0],
                [-9.0, -1.001, 9.0],
                [edge, -1.001, 9.0],
                [edge, -1.001, -9.0_f32],
            ];
            let bytes: Vec<u8> = floor
                .as_flattened()
                .iter()
                .flat_map(|number| number.to_le_bytes())
                .collect();
            let id = glb.accessor(&bytes, json!({"componentType": 5126, "count": 4, "type": "VEC3"}));
            glb.json["materials"]
                .as_array_mut()
                .unwrap()
                .push(json!({"pbrMetallicRoughness": {
                "baseColorFactor": [0, 0, 0, 1], "metallicFactor": 1.0}}));
            glb.json["meshes"].as_array_mut().unwrap().push(json!({"primitives": [
                {"attributes": {"POSITION": id}, "mode": 6, "material": 1}]}));
            let glb = glb.node(json!({"mesh": 1}));
            let is = seen(&glb, 1.0, vec3(-2.0, 2.0, 0.0), Vec3::ZERO).x;
            assert_eq!(is < 0.3, is_hit, "{is} at {offset} from {leaves}");
        }
    }
}

/// Oracle: of a smooth metal all light is mirrored in its colour; a smooth pane lets through what the dielectric does not
/// reflect, in its colour.
#[test]
fn mirrors_and_panes_in_a_grey_world() {
    let metal = Glb::floor().material(json!({
        "pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.6, 0.3, 1.0], "roughnessFactor": 0.0},
    }));
    let (eye, target) = (vec3(0.5, 3.0, 0.1), vec3(0.1, 0.0, 0.1));
    assert_near(seen(&metal, 0.5, eye, target), dvec3(0.45, 0.3, 0.15));
    let pane = Glb::floor().material(json!({
        "pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.6, 0.3, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.0},
        "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1.0}, "KHR_materials_ior": {"ior": 2.0}},
    }));
    let reflected = 1.0 / 9.0;
    assert_near(
        seen(&pane, 0.5, eye, target),
        (dvec3(0.9, 0.6, 0.3) * (1.0 - reflected) + DVec3::splat(reflected)) * 0.5,
    );
    let half_there = Glb::floor().material(json!({
        "alphaMode": "BLEND",
        "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 0.25], "metallicFactor": 1.0},
    }));
    assert_near(seen(&half_there, 0.5, eye, target), DVec3::splat(0.375));
}

/// Oracle: the peak of the microfacet lobe that glTF prescribes (Trowbridge-Reitz): with light and eye straight above,
/// luminance = F0 D E / 4 with D = 1 / (pi alpha^2), alpha the square of the roughness.
#[test]
fn highlights_are_as_bright_as_those_of_microfacets() {
    for roughness in [0.3, 0.5, 0.8, 1.0_f64] {
        let metal = Glb::floor().material(json!({
            "pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.6, 0.3, 1.0], "roughnessFactor": roughness},
        }));
        let half = (-PI / 4.0).sin();
        let down = json!({"rotation": [half, 0.0, 0.0, -half]});
        let glb = metal.light(json!({"type": "directional", "intensity": 3.0}), down);
        let peak = 3.0 / (4.0 * PI * roughness.powi(4));
        assert_near(
            seen(&glb, 0.0, vec3(0.1, 3.0, 0.1), vec3(0.1, 0.0, 0.1)),
            dvec3(0.9, 0.6, 0.3) * peak,
        );
    }
}

/// What no surface can do: send on more light than arrives. In a world of light all around, also ambient, no material may
/// be brighter than that.
#[test]
fn no_material_is_brighter_than_the_world() {
    let mut random = fastrand::Rng::with_seed(7);
    for _ in 0..300 {
        let mut part = || random.f64();
        let base = [part(), part(), part(), part()];
        let glb = slab(json!({
            "alphaMode": if part() < 0.3 { "BLEND" } else { "OPAQUE" },
            "pbrMetallicRoughness": {
                "baseColorFactor": base, "metallicFactor": part().min(0.999), "roughnessFactor": part(),
            },
            "extensions": {
                "KHR_materials_transmission": {"transmissionFactor": if part() < 0.5 { part() } else { 0.0 }},
                "KHR_materials_ior": {"ior": 1.0 + 2.0 * part()},
                "KHR_materials_volume": {"thicknessFactor": if part() < 0.5 { 1.0 } else { 0.0 }},
                "KHR_materials_specular": {"specularColorFactor": [part(), 4.0 * part(), 1.0]},
            },
        }));
        let mut setting = setting(&glb, 1.0);
        setting.model.ambient = Vec3::ONE;
        let scene = scene(setting.model);
        let frame = setting.view.frame(&scene, 8, 8);
        let eye = vec3(0.3, 2.0, 0.4);
        let color = see(&scene, &frame, &Ray::new(eye, vec3(0.1, 0.0, 0.2) - eye)).color;
        assert!(
            color.max_element() <= 1.0 + 1e-4 && color.min_element() > 0.0,
            "{color}: {}",
            glb.json["materials"]
        );
    }
}
