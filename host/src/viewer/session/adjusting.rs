//! Giving things values.

use super::{DISTANCES, Effect, Session};
use crate::stereo::Stereo;
use crate::viewer::adjustment::{Adjustment, KernelAdjustment, PictureAdjustment};

/// Why stereo and parallel rays exclude each other.
pub const ONE_EYE: &str = "two eyes see the same where rays are parallel; \
                           first choose perspective, or a picture for one eye";
/// Why there is nothing to be given a height.
const PERSPECTIVE: &str = "only orthographic pictures have a height of their own; \
                           say first: set projection orthographic";

impl Session {
    /// Gives something a value, and says what that brings about beyond the view; else says why that cannot be, and what to
    /// do.
    pub(super) fn adjust(&mut self, adjustment: Adjustment) -> Result<Option<Effect>, String> {
        let before = self.staging.clone();
        match adjustment {
            Adjustment::Picture(adjustment) => self.adjust_picture(adjustment)?,
            Adjustment::Kernel(KernelAdjustment::Backend(choice)) => return Ok(Some(Effect::Backend(choice))),
            Adjustment::Kernel(adjustment) => {
                let before = self.structure;
                adjustment.apply(&mut self.structure)?;
                return Ok((self.structure != before).then_some(Effect::Rebuild));
            }
            Adjustment::Light(index, adjustment) => self.adjust_light(index, adjustment)?,
            Adjustment::Material(index, adjustment) => self.adjust_material(index, adjustment)?,
            Adjustment::Environment(adjustment) => adjustment.apply(&mut self.staging)?,
        }
        Ok((self.staging != before).then_some(Effect::Restage))
    }

    fn adjust_picture(&mut self, adjustment: PictureAdjustment) -> Result<(), String> {
        let view = &mut self.view;
        match adjustment {
            PictureAdjustment::Samples(count) => (view.samples, view.adaptive) = (count.samples, count.adaptive),
            PictureAdjustment::Error(part) => view.tolerance = part,
            PictureAdjustment::Block(edge) => view.block = edge,
            PictureAdjustment::Pattern(pattern) => view.pattern = pattern,
            PictureAdjustment::Filter(filter) => view.filter = filter,
            PictureAdjustment::Shading(shading) => view.shading = shading,
            PictureAdjustment::Depth(depth) => view.depth = depth,
            PictureAdjustment::Cutoff(steps) => view.cutoff = steps,
            PictureAdjustment::Azimuth(degrees) => view.camera.azimuth = degrees,
            PictureAdjustment::Elevation(degrees) => view.camera.elevation = degrees,
            PictureAdjustment::Distance(radii) => view.camera.distance = radii,
            PictureAdjustment::Target(offset) => view.target = offset,
            PictureAdjustment::Projection(projection) => {
                if projection != view.projection {
                    self.toggle_projection()?;
                }
            }
            PictureAdjustment::FieldOfView(degrees) => view.field_of_view = degrees,
            PictureAdjustment::OrthoHeight(radii) => {
                if !view.is_orthographic() {
                    return Err(PERSPECTIVE.into());
                }
                view.ortho_height = Some(radii);
            }
            PictureAdjustment::LightAzimuth(degrees) => view.light.azimuth = degrees,
            PictureAdjustment::LightElevation(degrees) => view.light.elevation = degrees,
            PictureAdjustment::LightDistance(radii) => view.light.distance = radii,
            PictureAdjustment::Stereo(Some(_)) if view.is_orthographic() => return Err(ONE_EYE.into()),
            PictureAdjustment::Stereo(mode) => {
                view.stereo = mode.map(|mode| Stereo { mode, ..self.stereo });
                self.stereo = view.stereo.unwrap_or(self.stereo);
            }
            PictureAdjustment::EyeDistance(units) => {
                self.part_eyes(|stereo| stereo.eye_distance = Some(units))?;
            }
            PictureAdjustment::Convergence(units) => {
                self.part_eyes(|stereo| stereo.convergence = Some(units))?;
            }
            PictureAdjustment::Exposure(stops) => view.tone.exposure = stops,
            PictureAdjustment::Tone(curve) => view.tone.curve = curve,
        }
        Ok(())
    }

    /// Takes the other projection; what is looked at stays as large as it is.
    pub(super) fn toggle_projection(&mut self) -> Result<(), String> {
        if self.view.stereo.is_some() {
            return Err(ONE_EYE.into());
        }
        self.view.toggle_projection();
        self.view.camera.distance = self.view.camera.distance.clamp(DISTANCES[0], DISTANCES[1]);
        Ok(())
    }

    /// Changes where the eyes are, if there are two.
    fn part_eyes(&mut self, change: impl FnOnce(&mut Stereo)) -> Result<(), String> {
        let Some(stereo) = &mut self.view.stereo else {
            return Err("only pictures for two eyes have an eye distance and a convergence; \
                        say first what kind is wanted, for example: set stereo anaglyph"
                .into());
        };
        change(stereo);
        self.stereo = *stereo;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::backend::BackendChoice;
    use crate::sampling::Samples;
    use crate::stereo::StereoMode;
    use crate::tone::Curve;
    use crate::view::View;
    use crate::viewer::input::Input;
    use oktant_shared::parts::TraversalKind;

    fn session() -> Session {
        Session::new(View::default(), [800, 600], 1.0)
    }

    fn set(session: &mut Session, text: &str) -> Effect {
        session.apply(Input::Adjust(Adjustment::parse(text).unwrap()))
    }

    #[test]
    fn each_setting_changes_what_its_option_does() {
        let view = View::default();
        let changed = |text| {
            let mut session = session();
            assert_eq!(set(&mut session, text), Effect::Render, "{text}");
            assert_eq!(set(&mut session, text), Effect::Nothing, "{text}: there is nothing new");
            session.view
        };
        assert_eq!(changed("samples adaptive:16").samples, Samples::Sixteen);
        assert!(changed("samples adaptive:16").adaptive);
        assert_eq!(changed("error 0.03").tolerance, 0.03);
        assert_eq!(changed("block 4").block, 4);
        assert_ne!(changed("pattern r2").pattern, view.pattern);
        assert_ne!(changed("filter tent").filter, view.filter);
        assert_ne!(changed("shading flat").shading, view.shading);
        assert_eq!(changed("depth 2").depth, 2);
        assert_eq!(changed("cutoff 0").cutoff, 0.0);
        assert_eq!(changed("fov 60").field_of_view, 60.0);
        assert_eq!(changed("target 1,2,3").target, glam::vec3(1.0, 2.0, 3.0));
        assert!(changed("projection orthographic").is_orthographic());
        assert_eq!(changed("azimuth 30").camera.azimuth, 30.0);
        assert_eq!(changed("elevation -10").camera.elevation, -10.0);
        assert_eq!(changed("distance 4").camera.distance, 4.0);
        assert_eq!(changed("light-azimuth 30").light.azimuth, 30.0);
        assert_eq!(changed("light-elevation -10").light.elevation, -10.0);
        assert_eq!(changed("light-distance 4").light.distance, 4.0);
        assert_eq!(changed("stereo rows").stereo, Some(Stereo::new(StereoMode::Rows)));
    }

    #[test]
    fn tone_is_shown_and_not_rendered() {
        let mut session = session();
        assert_eq!(set(&mut session, "tone aces"), Effect::Show);
        assert_eq!(set(&mut session, "exposure -2"), Effect::Show);
        assert_eq!(
            (session.view.tone.curve, session.view.tone.exposure),
            (Curve::Aces, -2.0)
        );
    }

    #[test]
    fn kernels_are_built_and_back_ends_change_places() {
        let mut session = session();
        assert_eq!(set(&mut session, "traversal bvh2"), Effect::Rebuild);
        assert_eq!(set(&mut session, "traversal bvh2"), Effect::Nothing);
        assert_eq!(session.structure.parts.traversal, TraversalKind::Bvh2);
        assert_eq!(set(&mut session, "backend gpu"), Effect::Backend(BackendChoice::Gpu));
        assert!(matches!(set(&mut session, "triangle plucker"), Effect::Refused(_)));
    }

    #[test]
    fn parallel_rays_are_for_one_eye_and_have_a_height() {
        let mut session = session();
        let refused = |effect| matches!(effect, Effect::Refused(reason) if reason.contains("; "));
        assert!(refused(set(&mut session, "ortho-height 3")));
        set(&mut session, "projection orthographic");
        assert_eq!(set(&mut session, "ortho-height 3"), Effect::Render);
        assert_eq!(session.view.seen_height(), 3.0);
        assert!(refused(set(&mut session, "stereo rows")));
        assert!(refused(session.apply(Input::NextStereo)));
        assert_eq!(set(&mut session, "stereo none"), Effect::Nothing);
        set(&mut session, "projection perspective");
        set(&mut session, "stereo rows");
        assert!(refused(set(&mut session, "projection orthographic")));
        assert!(refused(session.apply(Input::ToggleProjection)));
        assert!(!session.view.is_orthographic());
    }

    #[test]
    fn one_eye_has_no_distance() {
        let mut session = session();
        for text in ["eye-distance 0.1", "convergence 3"] {
            assert!(
                matches!(set(&mut session, text), Effect::Refused(reason) if reason.contains("set stereo anaglyph"))
            );
        }
        set(&mut session, "stereo anaglyph");
        assert_eq!(set(&mut session, "eye-distance 0.1"), Effect::Render);
        assert_eq!(session.eye_distance(), 0.1);
        set(&mut session, "stereo none");
        set(&mut session, "stereo rows");
        assert_eq!(session.eye_distance(), 0.1, "it is remembered");
    }
}
