//! What a script is told of the window.

use super::application::Application;
use super::caption::name;
use super::fluidity::Fluidity;
use super::oracle::Disagreement;
use std::time::Instant;

impl Application {
    /// The figures and the view, a line each: a name and its values.
    pub(super) fn report(&mut self, now: Instant) -> String {
        let answered = self.pulse.take_longest();
        let caption = self.caption(now);
        let view = &self.session.view;
        let mut text = String::new();
        let mut line = |name: &str, value: String| text.extend([name, " ", &value, "\n"]);
        let number = |value: Option<f64>| value.map_or_else(|| "-".into(), |value| format!("{value:.3}"));
        let first = self.figures.first_picture.map(|first| first.as_secs_f64() * 1e3);
        line("backend", caption.backend);
        line(
            "triangles",
            caption
                .triangles
                .map_or_else(|| "-".into(), |triangles| triangles.to_string()),
        );
        line("size", format!("{} {}", caption.size[0], caption.size[1]));
        line("samples", format!("{} of {}", caption.samples[1], caption.samples[0]));
        line("shading", name(&view.shading));
        line("depth", view.depth.to_string());
        line("tone", name(&view.tone.curve));
        line("exposure", view.tone.exposure.to_string());
        line(
            "stereo",
            view.stereo.map_or_else(|| "none".into(), |stereo| name(&stereo.mode)),
        );
        line("eye-distance", self.session.eye_distance().to_string());
        for (name, place) in [("camera", view.camera), ("light", view.light)] {
            line(
                name,
                format!("{} {} {}", place.azimuth, place.elevation, place.distance),
            );
        }
        line(
            "target",
            format!("{} {} {}", view.target.x, view.target.y, view.target.z),
        );
        line("projection", name(&view.projection));
        line("fov", view.field_of_view.to_string());
        line("seen-height", view.seen_height().to_string());
        line("flying", self.session.flying_speed().is_some().to_string());
        for kind in Disagreement::ALL {
            let count = self.findings().map(|findings| findings.count(kind));
            let text = count.map_or_else(|| "-".into(), |count| count.to_string());
            line(&format!("oracle-{}", kind.name()), text);
        }
        for (name, value) in self.sight_report() {
            line(name, value);
        }
        line("first-picture", number(first));
        line(
            "answered-within-milliseconds",
            number(Some(answered.as_secs_f64() * 1e3)),
        );
        line("frames", self.figures.frames.to_string());
        line("drawn", self.figures.drawn.to_string());
        line("frames-a-second", number(caption.frames_a_second));
        line("kernel-milliseconds", number(caption.kernel));
        let draft = self.last_draft;
        let depth = if draft.is_shallow { " shallow" } else { "" };
        line("draft", format!("{}{depth}", draft.edge));
        let times = |times: Option<Fluidity>| times.map_or_else(|| "-".into(), |times| times.to_string());
        line("frame-milliseconds", times(self.figures.frame_times()));
        line("response-milliseconds", times(self.figures.response_times()));
        line("megarays-a-second", number(caption.megarays_a_second));
        let [closest, shadow] = match self.figures.kinds {
            Some(kinds) => kinds.map(Some),
            None => [None, None],
        };
        line("closest-rays-a-camera-ray", number(closest));
        line("shadow-rays-a-camera-ray", number(shadow));
        let parts = self.session.structure.parts;
        line("traversal", parts.traversal.to_string());
        line("triangle", parts.triangle.to_string());
        line("box", parts.box_test.to_string());
        line(
            "material",
            self.panel.as_ref().map_or(0, |panel| panel.layout.material).to_string(),
        );
        line("lights", self.session.staging.lights.len().to_string());
        text
    }
}
