//! What can stand on the command line.

use clap::{Args, Parser, Subcommand, ValueEnum};
use oktant::backend::BackendChoice;
use oktant::backend::gpu::ModulePath;
use oktant::octree::OctreeOptions;
use oktant::view::{Place, Samples, Shading, View};
use oktant_shared::octree::MAX_DEPTH;
use oktant_shared::orbit::Up;
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
    /// Look at a mesh in a window (H lists the keys).
    View(ViewArguments),
    /// Render a picture of a mesh into a PNG file.
    Render(RenderArguments),
    /// Print the figures of a mesh and of its octree, and the adapters at hand.
    Info(InfoArguments),
    /// Print the completions of a shell, for example: oktant completions bash > ~/.bash_completion
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
}

#[derive(Debug, Default, Args)]
pub struct ViewArguments {
    #[command(flatten)]
    pub mesh: MeshArguments,
    #[command(flatten)]
    pub look: LookArguments,
    #[command(flatten)]
    pub engine: EngineArguments,
    /// Size of the window's picture in pixels.
    #[arg(long, value_name = "WxH", default_value = "1280x968", value_parser = size)]
    pub size: Size,
    /// Feed the window from a file instead of a person; docs/viewer.md describes the format.
    #[arg(long, value_name = "FILE")]
    pub script: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct RenderArguments {
    #[command(flatten)]
    pub mesh: MeshArguments,
    /// The picture: a PNG file. An existing one is replaced once the new one is complete.
    #[arg(short, long, value_name = "OUT.png")]
    pub output: PathBuf,
    /// Size of the picture in pixels.
    #[arg(long, value_name = "WxH", default_value = "1280x968", value_parser = size)]
    pub size: Size,
    #[command(flatten)]
    pub look: LookArguments,
    #[command(flatten)]
    pub engine: EngineArguments,
    /// Render so many times and print the times of the kernel: median, least and greatest.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub repeat: u32,
}

#[derive(Debug, Args)]
pub struct InfoArguments {
    #[command(flatten)]
    pub mesh: MeshArguments,
}

/// Which mesh, and its octree.
#[derive(Debug, Default, Args)]
pub struct MeshArguments {
    /// A PLY file, or one of the built-in meshes `bunny` and `balls` [default: bunny].
    pub mesh: Option<PathBuf>,
    /// Limits of the octree, any of depth=0..13, leaf=N (cells with so few references are not split) and budget=N
    /// (references per triangle at most), separated by commas.
    #[arg(long, value_name = "depth=D,leaf=N,budget=N", value_parser = octree, default_value = "")]
    pub octree: Octree,
}

/// How the picture looks.
#[derive(Debug, Args)]
pub struct LookArguments {
    /// Samples of a pixel, on a regular grid.
    #[arg(long, value_enum, default_value = "1")]
    pub samples: SamplesArgument,
    /// Normals: of the triangle (flat), or interpolated between the vertices (phong).
    #[arg(long, value_enum, default_value = "phong")]
    pub shading: ShadingArgument,
    /// Where the camera stands, degrees: 0 in front (+Z, or -Y with --up z), counterclockwise seen from above.
    #[arg(long, value_name = "DEGREES", default_value_t = View::default().camera.azimuth, allow_negative_numbers = true, value_parser = finite)]
    pub azimuth: f32,
    /// How high the camera stands, degrees above the horizon, -90 to 90.
    #[arg(long, value_name = "DEGREES", default_value_t = View::default().camera.elevation, allow_negative_numbers = true, value_parser = elevation)]
    pub elevation: f32,
    /// How far the camera is from the centre of the mesh, in radii of its bounding sphere.
    #[arg(long, value_name = "RADII", default_value_t = View::default().camera.distance, value_parser = distance)]
    pub distance: f32,
    /// Vertical field of view, degrees, 1 to 170.
    #[arg(long, value_name = "DEGREES", default_value_t = View::default().field_of_view, value_parser = field_of_view)]
    pub fov: f32,
    /// Which axis of the mesh points up.
    #[arg(long, value_enum, default_value = "y")]
    pub up: UpArgument,
    /// Where the light stands, degrees, counted like --azimuth.
    #[arg(long, value_name = "DEGREES", default_value_t = View::default().light.azimuth, allow_negative_numbers = true, value_parser = finite)]
    pub light_azimuth: f32,
    /// How high the light stands, degrees above the horizon, -90 to 90.
    #[arg(long, value_name = "DEGREES", default_value_t = View::default().light.elevation, allow_negative_numbers = true, value_parser = elevation)]
    pub light_elevation: f32,
    /// How far the light is from the centre of the mesh, in radii of its bounding sphere.
    #[arg(long, value_name = "RADII", default_value_t = View::default().light.distance, value_parser = distance)]
    pub light_distance: f32,
}

impl Default for LookArguments {
    fn default() -> Self {
        let view = View::default();
        LookArguments {
            samples: SamplesArgument::One,
            shading: ShadingArgument::Phong,
            azimuth: view.camera.azimuth,
            elevation: view.camera.elevation,
            distance: view.camera.distance,
            fov: view.field_of_view,
            up: UpArgument::Y,
            light_azimuth: view.light.azimuth,
            light_elevation: view.light.elevation,
            light_distance: view.light.distance,
        }
    }
}

impl LookArguments {
    /// The view they describe.
    pub fn view(&self) -> View {
        View {
            camera: Place {
                azimuth: self.azimuth,
                elevation: self.elevation,
                distance: self.distance,
            },
            light: Place {
                azimuth: self.light_azimuth,
                elevation: self.light_elevation,
                distance: self.light_distance,
            },
            field_of_view: self.fov,
            up: match self.up {
                UpArgument::Y => Up::Y,
                UpArgument::Z => Up::Z,
            },
            shading: match self.shading {
                ShadingArgument::Flat => Shading::Flat,
                ShadingArgument::Phong => Shading::Phong,
            },
            samples: match self.samples {
                SamplesArgument::One => Samples::One,
                SamplesArgument::Four => Samples::Four,
                SamplesArgument::Sixteen => Samples::Sixteen,
            },
            ..View::default()
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
pub enum SamplesArgument {
    #[value(name = "1")]
    One,
    #[value(name = "4")]
    Four,
    #[value(name = "16")]
    Sixteen,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum ShadingArgument {
    Flat,
    Phong,
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
        Size {
            width: 1280,
            height: 968,
        }
    }
}

/// More pixels than this in a row or column, or in all, are refused: a picture must fit into memory.
const LARGEST_SIDE: u32 = 32_768;
const LARGEST_PICTURE: u64 = 1 << 28;

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
    fn octree_limits() {
        assert_eq!(octree("").unwrap().0, OctreeOptions::default());
        let options = octree("depth=5, leaf=3").unwrap().0;
        assert_eq!((options.depth, options.leaf), (5, 3));
        for bad in ["depth", "depth=14", "leaf=0", "budget=0", "size=3", "depth=-1"] {
            assert!(octree(bad).is_err(), "{bad}");
        }
    }
}
