//! How the picture looks.

use super::numbers::{cutoff, distance, elevation, exposure, field_of_view, finite, length, offset, tolerance};
use crate::cli::Failure;
use clap::builder::PossibleValue;
use clap::{Args, ValueEnum};
use glam::Vec3;
use oktant::projection::Projection;
use oktant::sampling::{Filter, Pattern, SampleCount};
use oktant::source::Source;
use oktant::standpoint::Origin;
use oktant::stereo::{Stereo, StereoMode};
use oktant::tone::Curve;
use oktant::view::{Shading, View};
use oktant::view_file::ViewFile;
use oktant::viewer::GivenSetting;
use oktant_shared::orbit::Up;
use oktant_shared::whitted::MAX_DEPTH as MAX_TREE_DEPTH;
use std::path::PathBuf;

/// How the picture looks. What is not given is as the scene says, or as it is for a mesh alone.
#[derive(Clone, Debug, Default, Args)]
pub struct LookArguments {
    /// Samples of a pixel; with adaptive: only where edges or contrast ask for more than one, up to that number
    /// [default: as the scene says, else 1].
    #[arg(long, value_enum)]
    pub samples: Option<SampleCount>,
    /// How far a pixel of few samples may be off, as a part of the output's range, 0.0001 to 1, with --samples adaptive
    /// [default: as the scene says, else 0.01].
    #[arg(long, value_name = "PART", allow_negative_numbers = true, value_parser = tolerance)]
    pub error: Option<f32>,
    /// Edge, in pixels, of blocks of which only the corners are traced where these agree, with --samples adaptive
    /// [default: as the scene says, else 1: all pixels are traced].
    #[arg(long, value_enum)]
    pub block: Option<BlockArgument>,
    /// Where in a pixel the samples lie [default: as the scene says, else regular].
    #[arg(long, value_enum)]
    pub pattern: Option<Pattern>,
    /// How much each sample counts [default: as the scene says, else box].
    #[arg(long, value_enum)]
    pub filter: Option<Filter>,
    /// Normals: of the triangle (flat), or interpolated between the vertices (phong) [default: as the scene says, else phong].
    #[arg(long, value_enum)]
    pub shading: Option<Shading>,
    /// How many times a ray may be reflected or refracted, 0 to 16 [default: as the scene says, else 16].
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(0..=i64::from(MAX_TREE_DEPTH)))]
    pub depth: Option<u32>,
    /// Rays are left out as long as the brightest that they can meet first can change no channel of the output by more than so
    /// many steps of 8 bits, up to 255; 0: none is [default: as the scene says, else 0.5].
    #[arg(long, value_name = "STEPS", allow_negative_numbers = true, value_parser = cutoff)]
    pub cutoff: Option<f32>,
    /// Where the camera stands, by a file with a table [camera] as scene files have it, which the viewer copies with
    /// Ctrl+Shift+C; what other options say of it takes precedence.
    #[arg(long, value_name = "FILE.toml")]
    pub view: Option<PathBuf>,
    /// Where the camera stands, degrees: 0 in front (+Z, or -Y with --up z), counterclockwise seen from above
    /// [default: as the scene says, else 0].
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, value_parser = finite)]
    pub azimuth: Option<f32>,
    /// How high the camera stands, degrees above the horizon, -90 to 90 [default: as the scene says, else 15].
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, value_parser = elevation)]
    pub elevation: Option<f32>,
    /// How far the camera is from what it looks at, in radii of the mesh's bounding sphere, 0.001 to 100000; of a scene that
    /// has a camera, in halves of the height that it sees [default: as the scene says, else 2.8].
    #[arg(long, value_name = "RADII", allow_negative_numbers = true, value_parser = distance)]
    pub distance: Option<f32>,
    /// Vertical field of view, degrees, 1 to 170 [default: as the scene says, else 40].
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, value_parser = field_of_view)]
    pub fov: Option<f32>,
    /// Whether what is farther away is smaller (perspective) or not (orthographic) [default: as the scene says, else
    /// perspective].
    #[arg(long, value_enum)]
    pub projection: Option<Projection>,
    /// What an orthographic picture shows from its lower edge to the upper one, counted like --distance
    /// [default: as the scene says, else what --fov shows at --distance].
    #[arg(long, value_name = "RADII", allow_negative_numbers = true, value_parser = distance)]
    pub ortho_height: Option<f32>,
    /// What the camera looks at and circles: an offset along the scene's axes from the middle of what the scene looks at,
    /// counted like --distance [default: 0,0,0].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = offset)]
    pub target: Option<Vec3>,
    /// Which axis of a mesh points up; a scene file says it itself [default: y].
    #[arg(long, value_enum)]
    pub up: Option<UpArgument>,
    /// Where the first light stands, degrees, counted like --azimuth [default: as the scene says, else -40].
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, value_parser = finite)]
    pub light_azimuth: Option<f32>,
    /// How high the first light stands, degrees above the horizon, -90 to 90 [default: as the scene says, else 50].
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, value_parser = elevation)]
    pub light_elevation: Option<f32>,
    /// How far the first light is, counted like --distance [default: as the scene says, else 6].
    #[arg(long, value_name = "RADII", allow_negative_numbers = true, value_parser = distance)]
    pub light_distance: Option<f32>,
    /// Pictures for two eyes [default: as the scene says, else none].
    #[arg(long, value_enum)]
    pub stereo: Option<StereoArgument>,
    /// Distance between the eyes, scene units, above 0 [default: as the scene says, else a thirtieth of --convergence].
    #[arg(long, value_name = "UNITS", allow_negative_numbers = true, value_parser = length)]
    pub eye_distance: Option<f32>,
    /// Depth that appears on the screen itself, scene units, above 0 [default: as the scene says, else what the camera looks at].
    #[arg(long, value_name = "UNITS", allow_negative_numbers = true, value_parser = length)]
    pub convergence: Option<f32>,
    /// Brightness in stops, -30 to 30: each doubles the light; not for EXR files [default: as the scene says, else 0].
    #[arg(long, value_name = "STOPS", allow_negative_numbers = true, value_parser = exposure)]
    pub exposure: Option<f32>,
    /// Curve that makes bright light fit the screen; not for EXR files [default: as the scene says, else none].
    #[arg(long, value_enum)]
    pub tone: Option<Curve>,
    /// What lights, materials or surroundings are to be, with the words that the viewer's scripts have after `set`, for example
    /// --set "material 0 mirror 0.5"; also "add light" and "remove light N". Any number of times; docs/viewer.md has the names.
    #[arg(long, value_name = "SETTING", value_parser = GivenSetting::parse)]
    pub set: Vec<GivenSetting>,
    /// What the environment says of it, which nothing is refused for.
    #[arg(skip)]
    pub environment: Option<Box<LookArguments>>,
}

impl LookArguments {
    /// What is given here, and of the rest what the environment says.
    pub fn on_top_of(self, environment: LookArguments) -> Self {
        LookArguments {
            environment: Some(Box::new(environment)),
            ..self
        }
    }

    /// The file that says where the camera stands, if there is one.
    ///
    /// # Errors
    /// One that is none.
    pub fn view_file(&self) -> Result<Option<ViewFile>, Failure> {
        let path = self.view.as_deref();
        Ok(path.map(ViewFile::read).transpose()?)
    }

    /// A view with what is given here changed, but for what a file says.
    pub fn applied(&self, view: View) -> View {
        self.applied_after(view, |view| view)
    }

    /// A view of a scene with what is given here and in a file changed.
    pub fn applied_with(&self, file: Option<&ViewFile>, view: View, origin: &Origin) -> View {
        self.applied_after(view, |view| file.map_or(view, |file| file.applied(&view, origin)))
    }

    /// A view with what the environment says, then `between`, then what is given here changed.
    fn applied_after(&self, mut view: View, between: impl FnOnce(View) -> View) -> View {
        if let Some(environment) = &self.environment {
            view = environment.applied(view);
        }
        view = between(view);
        fn set<T: Copy>(value: &mut T, given: Option<T>) {
            *value = given.unwrap_or(*value);
        }
        set(&mut view.samples, self.samples.map(|count| count.samples));
        set(&mut view.adaptive, self.samples.map(|count| count.adaptive));
        set(&mut view.tolerance, self.error);
        set(&mut view.block, self.block.map(|block| block.0));
        set(&mut view.pattern, self.pattern);
        set(&mut view.filter, self.filter);
        set(&mut view.shading, self.shading);
        set(&mut view.depth, self.depth);
        set(&mut view.cutoff, self.cutoff);
        set(&mut view.camera.azimuth, self.azimuth);
        set(&mut view.camera.elevation, self.elevation);
        set(&mut view.camera.distance, self.distance);
        set(&mut view.target, self.target);
        set(&mut view.projection, self.projection);
        set(&mut view.field_of_view, self.fov);
        view.ortho_height = self.ortho_height.or(view.ortho_height);
        set(
            &mut view.up,
            self.up.map(|up| match up {
                UpArgument::Y => Up::Y,
                UpArgument::Z => Up::Z,
            }),
        );
        set(&mut view.light.azimuth, self.light_azimuth);
        set(&mut view.light.elevation, self.light_elevation);
        set(&mut view.light.distance, self.light_distance);
        set(&mut view.tone.exposure, self.exposure);
        set(&mut view.tone.curve, self.tone);
        if let Some(StereoArgument(mode)) = self.stereo {
            view.stereo = mode.map(|mode| Stereo {
                mode,
                ..view.stereo.unwrap_or(Stereo::new(mode))
            });
        }
        if let Some(stereo) = &mut view.stereo {
            stereo.eye_distance = self.eye_distance.or(stereo.eye_distance);
            stereo.convergence = self.convergence.or(stereo.convergence);
        }
        view
    }

    /// Whether a picture for each of two eyes is asked for, whatever a scene says.
    pub fn asks_for_pair(&self) -> bool {
        self.stereo == Some(StereoArgument(Some(StereoMode::Sequential)))
    }

    /// Makes sure that what is given has a meaning for a source, as far as that can be said before it is loaded.
    pub fn check(&self, source: &Source) -> Result<(), Failure> {
        let is_scene = matches!(source, Source::Scene(_));
        if source.says_up() && self.up.is_some() {
            return Err(Failure::usage(if is_scene {
                "A scene file says itself which axis points up: leave --up out, and say up = \"y\" or up = \"z\" in the \
                 scene file."
            } else {
                "In a glTF file +Y points up: leave --up out."
            }));
        }
        self.view_file()?;
        if self.projection == Some(Projection::Orthographic) && self.stereo.is_some() {
            // The rest is known when the scene is.
            self.check_projection(&self.applied(View::default()))?;
        }
        match self.stereo {
            None if is_scene => Ok(()),
            stereo => self.check_eyes(stereo.is_some_and(|stereo| stereo.0.is_some())),
        }
    }

    /// Makes sure that an orthographic picture is for one eye, and that only such a one is told how high it is.
    pub fn check_projection(&self, view: &View) -> Result<(), Failure> {
        if view.is_orthographic() && view.stereo.is_some() {
            return Err(Failure::usage(
                "Two eyes see the same where rays are parallel: give --projection perspective, or --stereo none.",
            ));
        }
        if !view.is_orthographic() && self.ortho_height.is_some() {
            return Err(Failure::usage(
                "Only orthographic pictures have a height of their own: leave --ortho-height out, or give --projection \
                 orthographic.",
            ));
        }
        Ok(())
    }

    /// Makes sure that only what is sampled adaptively is told how.
    pub fn check_sampling(&self, is_adaptive: bool) -> Result<(), Failure> {
        if !is_adaptive && (self.error.is_some() || self.block.is_some()) {
            return Err(Failure::usage(
                "Only pictures that are sampled adaptively have an --error and a --block: leave them out, or give for \
                 example --samples adaptive:16.",
            ));
        }
        Ok(())
    }

    /// Makes sure that only a picture for two eyes is told how far they are apart.
    pub fn check_eyes(&self, is_stereo: bool) -> Result<(), Failure> {
        if !is_stereo && (self.eye_distance.is_some() || self.convergence.is_some()) {
            return Err(Failure::usage(
                "Only pictures for two eyes have an eye distance and a convergence: leave --eye-distance and \
                 --convergence out, or say what kind of picture is wanted, for example --stereo anaglyph.",
            ));
        }
        Ok(())
    }
}

/// A kind of picture for two eyes, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StereoArgument(pub Option<StereoMode>);

impl ValueEnum for StereoArgument {
    fn value_variants<'a>() -> &'a [Self] {
        &[
            StereoArgument(None),
            StereoArgument(Some(StereoMode::SideBySide)),
            StereoArgument(Some(StereoMode::Rows)),
            StereoArgument(Some(StereoMode::Sequential)),
            StereoArgument(Some(StereoMode::Anaglyph)),
        ]
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        match self.0 {
            None => Some(PossibleValue::new("none").help("A picture for one eye")),
            Some(mode) => mode.to_possible_value(),
        }
    }
}

/// Edge of blocks that adaptive sampling may interpolate, pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BlockArgument(pub u32);

impl ValueEnum for BlockArgument {
    fn value_variants<'a>() -> &'a [Self] {
        &[BlockArgument(1), BlockArgument(2), BlockArgument(4), BlockArgument(8)]
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(match self.0 {
            1 => "1",
            2 => "2",
            4 => "4",
            _ => "8",
        }))
    }
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum UpArgument {
    Y,
    Z,
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;
    use clap::Parser;

    #[derive(Parser)]
    struct Only {
        #[command(flatten)]
        _look: LookArguments,
    }

    #[test]
    fn what_the_help_says_of_defaults_is_so() {
        let view = View::default();
        let (camera, light) = (view.camera, view.light);
        let command = Only::command();
        for (name, default) in [
            ("error", view.tolerance),
            ("block", view.block as f32),
            ("depth", view.depth as f32),
            ("cutoff", view.cutoff),
            ("azimuth", camera.azimuth),
            ("elevation", camera.elevation),
            ("distance", camera.distance),
            ("fov", view.field_of_view),
            ("light-azimuth", light.azimuth),
            ("light-elevation", light.elevation),
            ("light-distance", light.distance),
            ("exposure", view.tone.exposure),
        ] {
            let argument = command
                .get_arguments()
                .find(|argument| argument.get_long() == Some(name));
            let help = argument
                .and_then(|argument| argument.get_help())
                .expect(name)
                .to_string();
            let (_, said) = help.split_once("as the scene says, else ").expect(name);
            let said = said
                .split([']', ':'])
                .next()
                .and_then(|number| number.parse::<f32>().ok());
            assert_eq!(said, Some(default), "--{name}: {help}");
        }
    }
}
