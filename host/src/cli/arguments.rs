//! What can stand on the command line.

mod look;
mod numbers;
mod values;

pub use look::{LookArguments, StereoArgument};
pub use values::{Aovs, Octree, Size};

use clap::{Args, Parser, Subcommand, ValueEnum};
use oktant::backend::BackendChoice;
use oktant::backend::gpu::ModulePath;
use oktant::output::Bits;
use std::path::PathBuf;
use values::{aovs, octree, size};

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

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_definition_is_sound() {
        Arguments::command().debug_assert();
    }
}
