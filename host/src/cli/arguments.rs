//! What can stand on the command line.

use super::Failure;
use clap::builder::PossibleValue;
use clap::{Args, Parser, Subcommand, ValueEnum};
use oktant::aov::Aov;
use oktant::backend::BackendChoice;
use oktant::backend::gpu::ModulePath;
use oktant::octree::OctreeOptions;
use oktant::output::Bits;
use oktant::picture::{DEFAULT_SIZE, LARGEST_PICTURE, LARGEST_SIDE};
use oktant::sampling::{Filter, Pattern, Samples};
use oktant::source::Source;
use oktant::stereo::{Stereo, StereoMode};
use oktant::tone::Curve;
use oktant::view::{Shading, View};
use oktant_shared::octree::MAX_DEPTH;
use oktant_shared::orbit::Up;
use oktant_shared::whitted::MAX_DEPTH as MAX_TREE_DEPTH;
use std::path::PathBuf;

/// Interactive ray tracer of triangle meshes whose GPU kernel is written in Rust.
///
/// Without a command, opens the viewer on the Stanford bunny, which is part of the program. Where there is no display,
/// it renders the picture into oktant.png instead.
#[derive(Debug, Parser)]
#[command(version, about, max_term_width = 110, args_conflicts_with_subcommands = true)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Option<Command>,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Look at a scene or mesh in a window (H lists the keys).
    View(ViewArguments),
    /// Render a picture of a scene or mesh into a PNG or EXR file.
    Render(RenderArguments),
    /// Read scene files with all that they refer to, and say what is in them, or what is wrong.
    Check(CheckArguments),
    /// Print the figures of a scene or mesh and of its octree, and the adapters at hand.
    Info(InfoArguments),
    /// Print the completions of a shell, for example: oktant completions bash > ~/.bash_completion
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
}

#[derive(Debug, Args)]
pub struct CheckArguments {
    /// Scene files; docs/scene-files.md describes them.
    #[arg(value_name = "SCENE.toml", required = true)]
    pub scenes: Vec<PathBuf>,
}

#[derive(Debug, Default, Args)]
pub struct ViewArguments {
    #[command(flatten)]
    pub mesh: MeshArguments,
    #[command(flatten)]
    pub look: LookArguments,
    #[command(flatten)]
    pub engine: EngineArguments,
    /// Size of the window's picture in pixels [default: as the scene says, else 1280x968].
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<Size>,
    /// Feed the window from a file instead of a person; docs/viewer.md describes the format.
    #[arg(long, value_name = "FILE")]
    pub script: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct RenderArguments {
    #[command(flatten)]
    pub mesh: MeshArguments,
    #[command(flatten)]
    pub files: FileArguments,
    /// Size of the picture in pixels [default: as the scene says, else 1280x968].
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<Size>,
    #[command(flatten)]
    pub look: LookArguments,
    #[command(flatten)]
    pub engine: EngineArguments,
    /// Render so many times and print the times of the kernel: median, least and greatest.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub repeat: u32,
}

/// Which files a picture becomes.
#[derive(Debug, Args)]
pub struct FileArguments {
    /// The picture: a PNG file, or an EXR file, which holds the light as it is. An existing one is replaced once the new
    /// one is complete. Of --stereo sequential the names get -left and -right at their ends.
    #[arg(short, long, value_name = "OUT.png|OUT.exr")]
    pub output: PathBuf,
    /// Bits of each channel in a PNG file [default: 8].
    #[arg(long, value_enum)]
    pub bits: Option<Bits>,
    /// What to write beside the colour, as layers of an EXR file or as files OUT-depth.png and so on beside a PNG file:
    /// any of depth, normal, id, barycentrics, samples and rays, separated by commas, or all.
    #[arg(long, value_name = "LIST|all", value_parser = aovs, default_value = "", hide_default_value = true)]
    pub aov: Aovs,
}

impl FileArguments {
    /// A picture and nothing else.
    pub fn picture(output: impl Into<PathBuf>) -> Self {
        FileArguments {
            output: output.into(),
            bits: None,
            aov: Aovs::default(),
        }
    }
}

#[derive(Debug, Args)]
pub struct InfoArguments {
    #[command(flatten)]
    pub mesh: MeshArguments,
}

/// Which mesh, and its octree.
#[derive(Debug, Default, Args)]
pub struct MeshArguments {
    /// A scene file (TOML), a PLY file, or one of the built-in meshes `bunny`, `balls` and `stadium` [default: bunny].
    pub mesh: Option<PathBuf>,
    /// Limits of the octree, any of depth=0..13, leaf=N (cells with so few references are not split) and budget=N
    /// (references per triangle at most), separated by commas.
    #[arg(long, value_name = "depth=D,leaf=N,budget=N", value_parser = octree, default_value = "")]
    pub octree: Octree,
}

/// How the picture looks. What is not given is as the scene says, or as it is for a mesh alone.
#[derive(Clone, Debug, Default, Args)]
pub struct LookArguments {
    /// Samples of a pixel [default: as the scene says, else 1].
    #[arg(long, value_enum)]
    pub samples: Option<Samples>,
    /// Where in a pixel the samples lie [default: as the scene says, else regular].
    #[arg(long, value_enum)]
    pub pattern: Option<Pattern>,
    /// How much each sample counts [default: as the scene says, else box].
    #[arg(long, value_enum)]
    pub filter: Option<Filter>,
    /// Normals: of the triangle (flat), or interpolated between the vertices (phong) [default: as the scene says, else phong].
    #[arg(long, value_enum)]
    pub shading: Option<Shading>,
    /// How many times a ray may be reflected or refracted, 0 to 16 [default: as the scene says, else 5].
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(0..=i64::from(MAX_TREE_DEPTH)))]
    pub depth: Option<u32>,
    /// Rays that can change no colour by more than this part of their light are left out [default: as the scene says, else 0.002].
    #[arg(long, value_name = "PART", allow_negative_numbers = true, value_parser = cutoff)]
    pub cutoff: Option<f32>,
    /// Where the camera stands, degrees: 0 in front (+Z, or -Y with --up z), counterclockwise seen from above
    /// [default: as the scene says, else 0].
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, value_parser = finite)]
    pub azimuth: Option<f32>,
    /// How high the camera stands, degrees above the horizon, -90 to 90 [default: as the scene says, else 15].
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, value_parser = elevation)]
    pub elevation: Option<f32>,
    /// How far the camera is from what it looks at, in radii of the mesh's bounding sphere; of a scene that has a
    /// camera, in halves of the height that it sees [default: as the scene says, else 2.8].
    #[arg(long, value_name = "RADII", allow_negative_numbers = true, value_parser = distance)]
    pub distance: Option<f32>,
    /// Vertical field of view, degrees, 1 to 170 [default: as the scene says, else 40].
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, value_parser = field_of_view)]
    pub fov: Option<f32>,
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
    /// Distance between the eyes, scene units [default: as the scene says, else a thirtieth of --convergence].
    #[arg(long, value_name = "UNITS", allow_negative_numbers = true, value_parser = length)]
    pub eye_distance: Option<f32>,
    /// Depth that appears on the screen itself, scene units [default: as the scene says, else what the camera looks at].
    #[arg(long, value_name = "UNITS", allow_negative_numbers = true, value_parser = length)]
    pub convergence: Option<f32>,
    /// Brightness in stops: each doubles the light; not for EXR files [default: as the scene says, else 0].
    #[arg(long, value_name = "STOPS", allow_negative_numbers = true, value_parser = exposure)]
    pub exposure: Option<f32>,
    /// Curve that makes bright light fit the screen; not for EXR files [default: as the scene says, else none].
    #[arg(long, value_enum)]
    pub tone: Option<Curve>,
}

impl LookArguments {
    /// A view with what is given here changed.
    pub fn applied(&self, mut view: View) -> View {
        fn set<T: Copy>(value: &mut T, given: Option<T>) {
            *value = given.unwrap_or(*value);
        }
        set(&mut view.samples, self.samples);
        set(&mut view.pattern, self.pattern);
        set(&mut view.filter, self.filter);
        set(&mut view.shading, self.shading);
        set(&mut view.depth, self.depth);
        set(&mut view.cutoff, self.cutoff);
        set(&mut view.camera.azimuth, self.azimuth);
        set(&mut view.camera.elevation, self.elevation);
        set(&mut view.camera.distance, self.distance);
        set(&mut view.field_of_view, self.fov);
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

    /// Makes sure that what is given has a meaning for a source, as far as that can be said before it is loaded.
    pub fn check(&self, source: &Source) -> Result<(), Failure> {
        let is_scene = matches!(source, Source::Scene(_));
        if is_scene && self.up.is_some() {
            return Err(Failure::usage(
                "A scene file says itself which axis points up: leave --up out, and say up = \"y\" or up = \"z\" in the \
                 scene file.",
            ));
        }
        match self.stereo {
            None if is_scene => Ok(()),
            stereo => self.check_eyes(stereo.is_some_and(|stereo| stereo.0.is_some())),
        }
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

/// What renders.
#[derive(Debug, Default, Args)]
pub struct EngineArguments {
    /// What renders: a real GPU if there is one, else the CPU (auto); the CPU; or a GPU, even a software one.
    #[arg(long, value_enum, default_value = "auto")]
    pub backend: BackendArgument,
    /// How the kernel reaches the GPU's driver: as it is where that is possible (auto, passthrough) or through naga.
    #[arg(long, value_enum, default_value = "auto")]
    pub spirv: SpirvArgument,
}

impl EngineArguments {
    pub fn choice(&self) -> BackendChoice {
        match self.backend {
            BackendArgument::Auto => BackendChoice::Auto,
            BackendArgument::Cpu => BackendChoice::Cpu,
            BackendArgument::Gpu => BackendChoice::Gpu,
        }
    }

    pub fn module(&self) -> ModulePath {
        match self.spirv {
            SpirvArgument::Auto => ModulePath::Auto,
            SpirvArgument::Passthrough => ModulePath::Passthrough,
            SpirvArgument::Naga => ModulePath::Naga,
        }
    }
}

#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum BackendArgument {
    #[default]
    Auto,
    Cpu,
    Gpu,
}

#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum SpirvArgument {
    #[default]
    Auto,
    Passthrough,
    Naga,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum UpArgument {
    Y,
    Z,
}

/// Width and height in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    pub width: u32,
    pub height: u32,
}

impl Default for Size {
    fn default() -> Self {
        DEFAULT_SIZE.into()
    }
}

impl From<[u32; 2]> for Size {
    fn from([width, height]: [u32; 2]) -> Self {
        Size { width, height }
    }
}

fn size(text: &str) -> Result<Size, String> {
    let wanted = "give width and height in pixels, for example 1280x968";
    let (width, height) = text.split_once(['x', 'X']).ok_or(wanted)?;
    let side = |text: &str| text.trim().parse::<u32>().map_err(|_| wanted);
    let size = Size {
        width: side(width)?,
        height: side(height)?,
    };
    if size.width == 0 || size.height == 0 {
        return Err("a picture needs at least 1x1 pixels".into());
    }
    let pixels = u64::from(size.width) * u64::from(size.height);
    if size.width.max(size.height) > LARGEST_SIDE || pixels > LARGEST_PICTURE {
        return Err(format!(
            "give at most {LARGEST_SIDE} pixels a side and {LARGEST_PICTURE} in all"
        ));
    }
    Ok(size)
}

/// Limits of the octree as given; what is not given keeps its default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Octree(pub OctreeOptions);

fn octree(text: &str) -> Result<Octree, String> {
    let mut options = OctreeOptions::default();
    for part in text.split(',').filter(|part| !part.trim().is_empty()) {
        let wanted = "give any of depth=0..13, leaf=N and budget=N, separated by commas";
        let (name, value) = part.split_once('=').ok_or(wanted)?;
        let value: u32 = value.trim().parse().map_err(|_| wanted)?;
        match name.trim() {
            "depth" if value <= MAX_DEPTH => options.depth = value,
            "leaf" if value >= 1 => options.leaf = value,
            "budget" if (1..=256).contains(&value) => options.budget = value,
            "depth" => return Err(format!("depth is at most {MAX_DEPTH}")),
            "leaf" => return Err("leaf is at least 1".into()),
            "budget" => return Err("budget is 1 to 256".into()),
            _ => return Err(wanted.into()),
        }
    }
    Ok(Octree(options))
}

/// What is to be told of pixels beside their colour, each once.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Aovs(pub Vec<Aov>);

fn aovs(text: &str) -> Result<Aovs, String> {
    let mut list = Vec::new();
    for name in text.split(',').map(str::trim).filter(|name| !name.is_empty()) {
        match Aov::ALL.into_iter().find(|aov| aov.name() == name) {
            Some(aov) => list.push(aov),
            None if name == "all" => list.extend(Aov::ALL),
            None => {
                let names = Aov::ALL.map(Aov::name).join(", ");
                return Err(format!("give any of {names}, separated by commas, or all"));
            }
        }
    }
    list.sort();
    list.dedup();
    Ok(Aovs(list))
}

fn number(text: &str, least: f32, greatest: f32, wanted: &str) -> Result<f32, String> {
    match text.trim().parse::<f32>() {
        Ok(value) if (least..=greatest).contains(&value) => Ok(value),
        _ => Err(wanted.into()),
    }
}

fn finite(text: &str) -> Result<f32, String> {
    number(text, -1e6, 1e6, "give a number of degrees")
}

fn elevation(text: &str) -> Result<f32, String> {
    number(text, -90.0, 90.0, "give a number of degrees from -90 to 90")
}

fn field_of_view(text: &str) -> Result<f32, String> {
    number(text, 1.0, 170.0, "give a number of degrees from 1 to 170")
}

fn length(text: &str) -> Result<f32, String> {
    number(text, 1e-12, 1e12, "give a number of scene units above 0")
}

fn exposure(text: &str) -> Result<f32, String> {
    number(text, -30.0, 30.0, "give a number of stops from -30 to 30")
}

fn cutoff(text: &str) -> Result<f32, String> {
    number(text, 0.0, 1.0, "give a number from 0 to 1")
}

fn distance(text: &str) -> Result<f32, String> {
    number(text, 1e-3, 1e5, "give a number of radii from 0.001 to 100000")
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_definition_is_sound() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn sizes() {
        assert_eq!(
            size("640x480"),
            Ok(Size {
                width: 640,
                height: 480
            })
        );
        for bad in [
            "",
            "640",
            "640x",
            "0x10",
            "10x0",
            "-1x5",
            "1e3x5",
            "99999x1",
            "32768x32768",
        ] {
            assert!(size(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn lists_of_aovs() {
        assert_eq!(aovs("").unwrap().0, []);
        assert_eq!(aovs("rays, depth,rays").unwrap().0, [Aov::Depth, Aov::Rays]);
        assert_eq!(aovs("all").unwrap().0, Aov::ALL);
        assert!(aovs("colour").unwrap_err().contains("barycentrics"));
    }

    #[test]
    fn octree_limits() {
        assert_eq!(octree("").unwrap().0, OctreeOptions::default());
        let options = octree("depth=5, leaf=3").unwrap().0;
        assert_eq!((options.depth, options.leaf), (5, 3));
        for bad in ["depth", "depth=14", "leaf=0", "budget=0", "size=3", "depth=-1"] {
            assert!(octree(bad).is_err(), "{bad}");
        }
    }
}
