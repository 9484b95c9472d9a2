//! What can stand on the command line.

mod bench;
mod chart;
mod compare;
mod files;
mod frames;
mod insight;
mod look;
mod numbers;
mod refusal;
mod stability;
mod trace;
mod tune;
mod values;
mod verbosity;

pub use bench::{BenchArguments, BenchTable};
pub use chart::{ChartArguments, ChartKind};
pub use compare::CompareArguments;
pub use files::{FileArguments, is_standard_output};
pub use frames::{FrameArguments, FrameRange};
pub use insight::{InsightArguments, Switch};
pub use look::LookArguments;
pub use stability::StabilityArguments;
pub use trace::{RayArgument, TraceArguments, TraceSource};
pub use tune::TuneArguments;
pub use values::{Grid, Octree, Size};
pub use verbosity::Verbosity;

use super::Failure;
use super::engine::EngineOptions;
use clap::builder::PossibleValue;
use clap::{Args, Parser, Subcommand, ValueEnum};
use oktant::backend::BackendChoice;
use oktant::backend::gpu::{GpuOptions, Kernel, ModulePath};
use oktant::oracle::whitted::Takes;
use oktant::profile::Profile;
use oktant::structure::StructureOptions;
use oktant::tree::BuildPreset;
use oktant_shared::parts::{BoxKind, Parts, TraversalKind, TriangleKind};
use oktant_shared::variant::Variant;
use refusal::refusal;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use values::{box_test, grid, octree, preset, size, takes, traversal, triangle};

/// Interactive ray tracer of triangle meshes whose GPU kernel is written in Rust.
///
/// Without a command, opens the viewer on the Stanford bunny, which is part of the program. Where there is no display,
/// it renders the picture into oktant.png instead.
#[derive(Debug, Parser)]
#[command(version, about, max_term_width = 110)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Option<Command>,
    #[command(flatten)]
    pub verbosity: Verbosity,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Look at a scene or mesh in a window (H lists the keys).
    View(ViewArguments),
    /// Render a picture of a scene or mesh into a PNG or EXR file, or many along a path of the camera.
    Render(RenderArguments),
    /// Trace rays from a file at a scene or mesh, and write where they hit into a file.
    Cast(CastArguments),
    /// Measure the thesis's pictures and all parts on sets of rays, each checked by the oracle first.
    Bench(BenchArguments),
    /// Measure and draw charts of speed against error, or draw them from files.
    Chart(ChartArguments),
    /// Say how far a picture is from another, in figures and as a picture.
    Compare(CompareArguments),
    /// Show where methods fail, and that the default does not.
    Stability(StabilityArguments),
    /// Trace one ray, and print what it visits and what every test says of the triangles on its way.
    Trace(TraceArguments),
    /// Measure what the work of rays costs on a device, and write it into a profile that others take by --profile.
    Tune(TuneArguments),
    /// Read scene or mesh files with all that they refer to, and say what is in them, or what is wrong.
    Check(CheckArguments),
    /// List the parts that can be exchanged, and the combinations that are offered.
    Kernels(KernelsArguments),
    /// Print the figures of a scene or mesh and of its structure, and the adapters at hand.
    Info(InfoArguments),
    /// Say what is preferred in the configuration file and the environment; docs/configuration.md says more.
    Config(ConfigArguments),
    /// Print the manual page of a command, for example: oktant man render | man -l -
    Man(ManArguments),
    /// Print the completions of a shell, for example: oktant completions bash > ~/.bash_completion
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
}

#[derive(Debug, Args)]
pub struct CheckArguments {
    /// Scene files or mesh files; docs/scene-files.md and docs/files.md describe them.
    #[arg(value_name = "FILE", required = true)]
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
    /// Size of the window's picture in pixels, at most 32768 a side [default: as the scene says, else 1280x968].
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<Size>,
    /// How long a picture may take while the camera or the light moves, milliseconds, 5 to 1000: resolution follows it, down to
    /// a quarter of width and height, then reflections and samples of the first light; where there is time left, so do samples.
    #[arg(long, value_name = "N", default_value_t = 60, value_parser = clap::value_parser!(u32).range(5..=1000))]
    pub target_ms: u32,
    /// Whether the panel with settings is open at first; Tab opens and closes it [default: as it was left, else off].
    #[arg(long, value_enum, value_name = "on|off", hide_possible_values = true)]
    pub panel: Option<SwitchArgument>,
    /// Feed the window from a file instead of a person; docs/viewer.md describes the format.
    #[arg(long, value_name = "FILE")]
    pub script: Option<PathBuf>,
}

/// Whether something is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SwitchArgument {
    On,
    Off,
}

#[derive(Debug, Args)]
pub struct RenderArguments {
    #[command(flatten)]
    pub mesh: MeshArguments,
    #[command(flatten)]
    pub files: FileArguments,
    #[command(flatten)]
    pub frames: FrameArguments,
    /// Size of the picture in pixels, at most 32768 a side and 268435456 in all [default: as the scene says, else 1280x968].
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<Size>,
    #[command(flatten)]
    pub look: LookArguments,
    #[command(flatten)]
    pub engine: EngineArguments,
    /// Render so many times, 1 to 10000, and print the times of the kernel in milliseconds: median, least and greatest.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub repeat: u32,
    /// Say what was rendered as JSON, on standard output: files, rays, times, bounds of what was cut; with --show the figures of
    /// the legend.
    #[arg(long, conflicts_with = "reference")]
    pub json: bool,
    #[command(flatten)]
    pub insight: InsightArguments,
    /// Variant of the kernel: the least that does all that the scene needs, or a greater one, for comparison
    /// [default: the least].
    #[arg(long, value_enum)]
    pub variant: Option<VariantArgument>,
    /// Render in double precision, slowly, for others to be compared with; with a number, in so many samples of a pixel, a
    /// regular grid of 1, 4, 9, ... or 4096; docs/reference.md says more.
    #[arg(
        long,
        value_name = "SAMPLES",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "",
        value_parser = takes,
        conflicts_with_all = ["backend", "spirv", "kernel", "repeat", "variant", "error", "block", "traversal", "triangle", "box_test", "build", "octree", "grid", "profile"],
    )]
    pub reference: Option<Takes>,
}

/// A variant of the kernel.
#[derive(Clone, Copy, Debug)]
pub struct VariantArgument(pub Variant);

impl ValueEnum for VariantArgument {
    fn value_variants<'a>() -> &'a [Self] {
        &[
            VariantArgument(Variant::Plain),
            VariantArgument(Variant::Opaque),
            VariantArgument(Variant::Mirrors),
            VariantArgument(Variant::Everything),
        ]
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.0.name()))
    }
}

#[derive(Debug, Args)]
pub struct CastArguments {
    /// A scene file (TOML), a mesh file (glTF, OBJ, PLY, STL, PTRI or MSH1), or one of the built-in meshes `bunny`, `balls` and `stadium`.
    pub mesh: PathBuf,
    /// The rays: a .npy file of N x 6 numbers (origin, direction) or N x 8 (then tmin, tmax), or a file that begins with
    /// PRAY or RAY1; docs/cast.md describes them.
    pub rays: PathBuf,
    /// Where the hits go: arrays t, triangle, u, v and normal for numpy.load, or hit where any hit is asked for. An
    /// existing file is replaced once the new one is complete.
    #[arg(short, long, value_name = "HITS.npz", required_unless_present = "repeat")]
    pub output: Option<PathBuf>,
    /// Ask whether there is any hit instead of for the closest one [default: as the file says, else the closest one].
    #[arg(long, conflicts_with = "closest")]
    pub any: bool,
    /// Ask for the closest hit, also where the file says any.
    #[arg(long)]
    pub closest: bool,
    #[command(flatten)]
    pub structure: StructureArguments,
    #[command(flatten)]
    pub engine: EngineArguments,
    /// Trace so many times more, 1 to 10000, and print how fast, as JSON: by the GPU's clock, or by the wall's around the
    /// tracing alone.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub repeat: Option<u32>,
}

#[derive(Debug, Args)]
pub struct ConfigArguments {
    /// Print the path of the file alone, there or not.
    #[arg(long, conflicts_with = "json")]
    pub path: bool,
    /// Print everything as JSON.
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub struct ManArguments {
    /// The command whose page is printed; without one, that of the program.
    #[arg(conflicts_with = "output")]
    pub command: Option<String>,
    /// Write the pages of all commands into this folder, which is there already, as oktant-render.1 and so on.
    #[arg(short, long, value_name = "FOLDER")]
    pub output: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct KernelsArguments {
    /// Print everything as JSON.
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub struct InfoArguments {
    #[command(flatten)]
    pub mesh: MeshArguments,
}

/// Which mesh, and what rays are traced with.
#[derive(Debug, Default, Args)]
pub struct MeshArguments {
    /// A scene file (TOML), a mesh file (glTF, OBJ, PLY, STL, PTRI or MSH1), or one of the built-in meshes `bunny`, `balls` and `stadium` [default: bunny].
    /// Several meshes are shown in one scene, as they lie.
    #[arg(value_name = "MESH")]
    pub meshes: Vec<PathBuf>,
    #[command(flatten)]
    pub structure: StructureArguments,
}

/// What rays are traced with.
#[derive(Clone, Debug, Default, Args)]
pub struct StructureArguments {
    /// The way through the scene; `oktant kernels` says more of it and the tests.
    #[arg(long, value_parser = traversal(), default_value = "octants")]
    pub traversal: TraversalKind,
    /// The test of ray against triangle.
    #[arg(long, value_parser = triangle(), default_value = "watertight")]
    pub triangle: TriangleKind,
    /// The test of ray against box, where the traversal leaves it open.
    #[arg(long = "box", value_parser = box_test(), default_value = "kay-kajiya")]
    pub box_test: BoxKind,
    /// What the build of a tree of boxes spends its time on.
    #[arg(long, value_parser = preset(), default_value = "balanced")]
    pub build: BuildPreset,
    /// Limits of --traversal octree, any of depth=0..13, leaf=N (cells with more than N references are split, and no others,
    /// whatever it costs) and budget=N (references per triangle at most, 1 to 256), separated by commas
    /// [default: depth=13,budget=16, split where that costs rays less].
    #[arg(long, value_name = "depth=D,leaf=N,budget=N", value_parser = octree, default_value = "", hide_default_value = true)]
    pub octree: Octree,
    /// Limits of --traversal grid, any of density=D (cells for each triangle, 0.01 to 100) and budget=N (references per triangle
    /// at most, 1 to 256), separated by commas [default: density=4,budget=32].
    #[arg(long, value_name = "density=D,budget=N", value_parser = grid, default_value = "", hide_default_value = true)]
    pub grid: Grid,
    /// What the work of rays costs on this device, as `oktant tune` measured it [default: what is the best on others].
    #[arg(long, value_name = "PROFILE.toml")]
    pub profile: Option<PathBuf>,
}

impl StructureArguments {
    /// What is to be built.
    ///
    /// # Errors
    /// A combination that is not offered, limits of another structure, or a broken profile.
    pub fn options(&self) -> Result<StructureOptions, Failure> {
        let parts = Parts {
            traversal: self.traversal,
            triangle: self.triangle,
            box_test: self.box_test,
        };
        if !parts.is_offered() {
            return Err(Failure::usage(refusal(parts)));
        }
        // Limits that are the default's change nothing.
        if self.octree != Octree::default() && self.traversal != TraversalKind::Octree {
            return Err(Failure::usage(
                "Only the octree has the limits of --octree; add --traversal octree, or leave them out.",
            ));
        }
        if self.grid != Grid::default() && self.traversal != TraversalKind::Grid {
            return Err(Failure::usage(
                "Only the grid has the limits of --grid; add --traversal grid, or leave them out.",
            ));
        }
        let mut options = StructureOptions {
            parts,
            preset: self.build,
            octree: self.octree.0,
            grid: self.grid.0,
            ..StructureOptions::default()
        };
        if let Some(profile) = &self.profile {
            options.apply(&Profile::read(profile)?);
        }
        Ok(options)
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
    /// A compiled kernel to run on the GPU in the place of the one that is part of the program, with its manifest beside
    /// it; docs/kernels.md says what it must be. The viewer reads it again whenever it is saved.
    #[arg(long, value_name = "FILE.spv")]
    pub kernel: Option<PathBuf>,
}

impl EngineArguments {
    pub fn choice(&self) -> BackendChoice {
        match self.backend {
            BackendArgument::Auto => BackendChoice::Auto,
            BackendArgument::Cpu => BackendChoice::Cpu,
            BackendArgument::Gpu => BackendChoice::Gpu,
        }
    }

    /// What to render with. A kernel is read now, so that nobody waits for a scene and then learns that it does not fit.
    ///
    /// # Errors
    /// A kernel for the CPU, or one that cannot be run.
    pub fn options(&self) -> Result<EngineOptions, Failure> {
        let kernel = match self.kernel_file()? {
            Some(path) => Some(Arc::new(Kernel::read(path)?)),
            None => None,
        };
        Ok(EngineOptions {
            choice: self.choice(),
            gpu: GpuOptions {
                software: self.choice() == BackendChoice::Gpu,
                module: self.module(),
                kernel,
            },
        })
    }

    /// The file of the kernel, if there is one.
    ///
    /// # Errors
    /// One for the CPU.
    pub fn kernel_file(&self) -> Result<Option<&Path>, Failure> {
        match (&self.kernel, self.backend) {
            (Some(_), BackendArgument::Cpu) => Err(Failure::usage(
                "--kernel runs on a GPU, and --backend cpu has none; leave one of the two out.",
            )),
            (kernel, _) => Ok(kernel.as_deref()),
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

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_definition_is_sound() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn what_a_command_takes_comes_before_what_all_do() {
        let mut program = Arguments::command();
        program.build();
        for command in program.get_subcommands_mut() {
            let help = command.render_long_help().to_string();
            let Some(common) = help.find("--verbose") else {
                assert_eq!(command.get_name(), "help");
                continue;
            };
            for own in help[common..].match_indices("      --") {
                let rest = &help[common + own.0..];
                assert!(rest.starts_with("      --help"), "{}: {rest}", command.get_name());
            }
        }
    }
}
