//! All settings with their values, as the steps of a script that would set them.

use super::adjustment::{LightAdjustment, SWITCHES, hue, stereo_name};
use super::application::Application;
use super::caption::name;
use super::session::Session;
use crate::names::{Names, on_one_line};
use crate::sampling::SampleCount;
use glam::Vec3;
use oktant_shared::light::{DIRECTIONAL, Light, POINT};
use oktant_shared::material::Material;
use oktant_shared::texture::NO_TEXTURE;

/// Lines of a script.
#[derive(Default)]
struct Steps(String);

impl Steps {
    fn set(&mut self, name: &str, value: impl ToString) {
        self.0.extend(["set ", name, " ", &value.to_string(), "\n"]);
    }

    /// A line that no script plays, whatever a file has in its names.
    fn remark(&mut self, text: &str) {
        self.0.extend(["# ", &on_one_line(text), "\n"]);
    }
}

impl Application {
    /// The settings, a step a line.
    pub(super) fn settings(&self) -> String {
        let mut steps = Steps::default();
        steps.set("backend", if self.wants_gpu { "gpu" } else { "cpu" });
        steps.0 + &settings(&self.session, &self.names)
    }
}

/// The settings of a session, a step a line; numbers are read as they were written.
fn settings(session: &Session, names: &Names) -> String {
    let mut steps = Steps::default();
    let parts = session.structure.parts;
    steps.set("traversal", parts.traversal);
    steps.set("triangle", parts.triangle);
    steps.set("box", parts.box_test);
    steps.set("build", session.structure.preset.name());
    picture(&mut steps, session);
    for (index, light) in session.staging.lights.iter().enumerate() {
        describe_light(&mut steps, session, index, light);
    }
    for (index, material) in session.staging.materials.iter().enumerate() {
        if let Some(name) = names.material(index) {
            steps.remark(&format!("material {index} is \"{name}\""));
        }
        describe_material(&mut steps, index, material);
    }
    surroundings(&mut steps, session);
    steps.0
}

fn picture(steps: &mut Steps, session: &Session) {
    let view = &session.view;
    let samples = SampleCount {
        samples: view.samples,
        adaptive: view.adaptive,
    };
    steps.set("samples", samples.name());
    steps.set("error", view.tolerance);
    steps.set("block", view.block);
    steps.set("pattern", name(&view.pattern));
    steps.set("filter", name(&view.filter));
    steps.set("shading", name(&view.shading));
    steps.set("depth", view.depth);
    steps.set("cutoff", view.cutoff);
    steps.set("target", triple(view.target));
    steps.set("projection", name(&view.projection));
    steps.set("fov", view.field_of_view);
    if let (true, Some(height)) = (view.is_orthographic(), view.ortho_height) {
        steps.set("ortho-height", height);
    }
    for (prefix, place) in [("", view.camera), ("light-", view.light)] {
        steps.set(&format!("{prefix}azimuth"), place.azimuth);
        steps.set(&format!("{prefix}elevation"), place.elevation);
        steps.set(&format!("{prefix}distance"), place.distance);
    }
    steps.set("stereo", stereo_name(view.stereo.map(|stereo| stereo.mode)));
    if let Some(stereo) = view.stereo {
        let lengths = [
            ("eye-distance", stereo.eye_distance),
            ("convergence", stereo.convergence),
        ];
        for (name, length) in lengths {
            if let Some(length) = length {
                steps.set(name, length);
            }
        }
    }
    steps.set("tone", name(&view.tone.curve));
    steps.set("exposure", view.tone.exposure);
}

fn describe_light(steps: &mut Steps, session: &Session, index: usize, light: &Light) {
    let mut set = |name: &str, value: String| steps.set(&format!("light {index} {name}"), value);
    set("color", triple(hue(light)));
    set("intensity", light.color.max_element().to_string());
    // The first one stands where the view says it.
    if let (1.., Some(place)) = (index, session.light_place(index)) {
        if light.kind == POINT {
            set("position", triple(light.position));
        } else {
            set("azimuth", place.azimuth.to_string());
            set("elevation", place.elevation.to_string());
        }
        if light.kind != POINT && light.kind != DIRECTIONAL {
            set("distance", place.distance.to_string());
        }
    }
    if light.kind == DIRECTIONAL {
        return;
    }
    set("range", light.range.to_string());
    let falls_off = light.falloff_radius > 0.0;
    set("falloff", LightAdjustment::FALLOFFS[usize::from(falls_off)].into());
    if falls_off {
        set("radius", light.falloff_radius.to_string());
    }
}

fn describe_material(steps: &mut Steps, index: usize, material: &Material) {
    let mut set = |name: &str, value: String| steps.set(&format!("material {index} {name}"), value);
    set("base", triple(material.base));
    set("ambient", material.ambient.to_string());
    // Before what even reflection has to make room for.
    set("mirror", triple(material.mirror));
    set("transmission", triple(material.transmission));
    set("diffuse", material.diffuse.to_string());
    set("specular", triple(material.specular));
    set("exponent", material.exponent.to_string());
    set("ior", material.ior.to_string());
    set("absorption", triple(material.absorption));
    set("priority", material.priority.to_string());
    set("bump_height", material.bump_height.to_string());
    for (name, bit, states) in SWITCHES {
        set(name, states[usize::from(material.flags & bit != 0)].into());
    }
}

fn surroundings(steps: &mut Steps, session: &Session) {
    let environment = &session.staging.environment;
    let mut set = |name: &str, value: String| steps.set(&format!("environment {name}"), value);
    if environment.texture == NO_TEXTURE {
        set("zenith", triple(environment.zenith));
        set("horizon", triple(environment.horizon));
        set("nadir", triple(environment.nadir));
    } else {
        set("strength", environment.strength.to_string());
        set("rotation", (environment.rotation * 360.0).to_string());
    }
    set("ambient", triple(session.staging.ambient));
}

/// Three numbers as settings have them.
fn triple(vector: Vec3) -> String {
    format!("{},{},{}", vector.x, vector.y, vector.z)
}

#[cfg(test)]
mod tests {
    use super::super::adjustment::Adjustment;
    use super::super::input::Input;
    use super::super::script::Script;
    use super::super::session::Effect;
    use super::super::step::Step;
    use super::*;
    use crate::model::{Focus, plain_material, white_light};
    use crate::scene::Staging;
    use crate::view::View;
    use oktant_shared::environment::Environment;
    use oktant_shared::light::AREA;

    fn session() -> Session {
        let mut session = Session::new(View::default(), [800, 600], 1.0);
        session.update(
            View::default(),
            Focus {
                center: Vec3::ONE,
                radius: 2.0,
            },
            false,
        );
        let of_kind = |kind| Light {
            kind,
            position: Vec3::Z,
            ..white_light()
        };
        session.restage(
            Staging {
                materials: vec![plain_material(); 2],
                lights: [POINT, POINT, AREA, DIRECTIONAL].map(of_kind).to_vec(),
                environment: Environment::constant(Vec3::ONE),
                ambient: Vec3::ZERO,
            },
            false,
        );
        session
    }

    /// Takes all steps of a script, which must be settings that are accepted.
    fn play(session: &mut Session, text: &str) {
        for (line, step) in Script::parse(text, "settings").expect("they are steps").steps {
            let Step::Ask(input @ Input::Adjust(_)) = step else {
                panic!("line {line}: {step:?}");
            };
            let effect = session.apply(input);
            assert!(!matches!(effect, Effect::Refused(_)), "line {line}: {effect:?}");
        }
    }

    #[test]
    fn they_bring_everything_back() {
        let mut changed = session();
        for text in [
            "samples adaptive:16",
            "error 0.03",
            "block 4",
            "pattern r2",
            "filter tent",
            "shading flat",
            "target 0.1,0.2,-0.3",
            "depth 2",
            "cutoff 0",
            "azimuth 0.1",
            "light-distance 4",
            "stereo rows",
            "convergence 3",
            "tone aces",
            "exposure -0.3",
            "fov 33.3",
            "traversal bvh2",
            "build fast",
            "light 0 color 1,0.5,0.25",
            "light 1 intensity 4",
            "light 1 position 0.1,-2,3.3",
            "light 1 falloff inverse-square",
            "light 1 radius 0.2",
            "light 2 range 7",
            "light 3 azimuth 90",
            "material 1 base 0.1,0.2,0.3",
            "material 1 transmission 0.3",
            "material 1 mirror 0.25,0.5,0.125",
            "material 1 diffuse 0.4",
            "material 1 fresnel on",
            "environment zenith 0.25",
            "environment ambient 0.5",
        ] {
            play(&mut changed, &format!("set {text}"));
        }
        let mut again = session();
        let names = Names {
            materials: vec![None, Some("old\nquit\rwood".into())],
            environment: None,
        };
        let text = settings(&changed, &names);
        assert!(
            text.contains("\n# material 1 is \"old quit wood\"\nset material 1 base "),
            "{text}"
        );
        assert!(!text.contains("material 0 is"), "{text}");
        play(&mut again, &text);
        assert_eq!(again.view, changed.view);
        assert_eq!(again.structure, changed.structure);
        assert_eq!(again.staging.materials, changed.staging.materials);
        assert_eq!(again.staging.environment, changed.staging.environment);
        assert_eq!(again.staging.ambient, changed.staging.ambient);
        for (index, light) in changed.staging.lights.iter().enumerate() {
            let same = &again.staging.lights[index];
            assert_eq!((same.color, same.range), (light.color, light.range), "light {index}");
            assert_eq!(same.falloff_radius, light.falloff_radius, "light {index}");
            assert!(same.position.distance(light.position) < 1e-5, "light {index}: {same:?}");
        }
        // Places of lights are turned into directions and back.
        let (again, changed) = (settings(&again, &names), settings(&changed, &names));
        let both = again.split([' ', ',', '\n']).zip(changed.split([' ', ',', '\n']));
        for (is, wanted) in both {
            let numbers = is.parse::<f32>().ok().zip(wanted.parse::<f32>().ok());
            let is_near = numbers.is_some_and(|(is, wanted)| (is - wanted).abs() < 1e-5);
            assert!(is == wanted || is_near, "{is} is not {wanted} in {again}");
        }
        assert_eq!(again.lines().count(), changed.lines().count());
    }

    #[test]
    fn every_setting_is_among_them() {
        let mut session = session();
        session.apply(Input::Adjust(Adjustment::parse("stereo rows").expect("it is one")));
        session.apply(Input::Adjust(Adjustment::parse("eye-distance 1").expect("it is one")));
        session.apply(Input::Adjust(Adjustment::parse("convergence 1").expect("it is one")));
        let mut text = settings(&session, &Names::default());
        // Without perspective there are no two eyes.
        for setting in ["stereo none", "projection orthographic", "ortho-height 2"] {
            session.apply(Input::Adjust(Adjustment::parse(setting).expect("it is one")));
        }
        text += &settings(&session, &Names::default());
        let names = super::super::adjustment::PictureAdjustment::NAMES.map(|name| format!("set {name} "));
        let of_materials =
            super::super::adjustment::MaterialAdjustment::NAMES.map(|name| format!("set material 1 {name} "));
        for name in names.iter().chain(&of_materials) {
            assert!(text.contains(name.as_str()), "{name} is not in {text}");
        }
    }
}
