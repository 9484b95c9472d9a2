//! Where pictures go.

use super::values::{Aovs, aovs, cells};
use crate::cli::Failure;
use clap::{Args, ValueEnum};
use oktant::output::{AnimationFormat, Bits};
use oktant::wires::Selection;
use std::borrow::Cow;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};

/// What stands for standard output in the place of a name.
const STANDARD_OUTPUT: &str = "-";

/// Whether a name stands for standard output.
pub fn is_standard_output(name: &Path) -> bool {
    name == Path::new(STANDARD_OUTPUT)
}

/// Which files a picture becomes.
#[derive(Debug, Args)]
pub struct FileArguments {
    /// The picture: a PNG file, or an EXR file, which holds the light as it is; - is standard output. An existing file is
    /// replaced once the new one is complete. Of --stereo sequential the names get -left and -right at their ends.
    #[arg(short, long, value_name = "OUT.png|OUT.exr|-")]
    pub output: PathBuf,
    /// What goes to standard output, with -o - [default: png].
    #[arg(long, value_enum)]
    pub format: Option<FormatArgument>,
    /// Bits of each channel in a PNG file [default: 8].
    #[arg(long, value_enum)]
    pub bits: Option<Bits>,
    /// What to write beside the colour, as layers of an EXR file or as files OUT-depth.png and so on beside a PNG file:
    /// any of depth, normal, id, barycentrics, samples and rays, separated by commas, or all.
    #[arg(long, value_name = "LIST|all", value_parser = aovs, default_value = "", hide_default_value = true)]
    pub aov: Aovs,
    /// Draw cells of the structure over a PNG picture: all leaves, a level (the root's is 0), or what the ray through the middle
    /// of a pixel visits.
    #[arg(long, value_name = "all|LEVEL|X,Y", value_parser = cells, conflicts_with_all = ["bits", "reference", "frames"])]
    pub cells: Option<Selection>,
}

/// A format of what goes to standard output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FormatArgument {
    /// A picture as a screen shows it.
    Png,
    /// A picture with the light as it is.
    Exr,
    /// An animation with 256 colours a frame.
    Gif,
    /// An animation with every colour.
    Apng,
}

impl FileArguments {
    /// A picture and nothing else.
    pub fn picture(output: impl Into<PathBuf>) -> Self {
        FileArguments {
            output: output.into(),
            format: None,
            bits: None,
            aov: Aovs::default(),
            cells: None,
        }
    }

    /// Whether the picture goes to standard output.
    pub fn is_standard_output(&self) -> bool {
        is_standard_output(&self.output)
    }

    /// The name that says which format is meant: standard output has one as if it were a file.
    pub fn name(&self) -> Cow<'_, Path> {
        if !self.is_standard_output() {
            return self.output.as_path().into();
        }
        let name = match self.format {
            None | Some(FormatArgument::Png) => "standard-output.png",
            Some(FormatArgument::Exr) => "standard-output.exr",
            Some(FormatArgument::Gif) => "standard-output.gif",
            Some(FormatArgument::Apng) => "standard-output.apng",
        };
        Path::new(name).into()
    }

    /// The format of an animation, if the file is one.
    ///
    /// # Errors
    /// Bits that it does not have.
    pub fn animation(&self) -> Result<Option<AnimationFormat>, Failure> {
        AnimationFormat::new(&self.name(), self.bits).map_err(|error| Failure::usage(error.to_string()))
    }

    /// Makes sure that standard output is asked for one thing only, which somebody reads.
    ///
    /// # Errors
    /// What does not go together.
    pub fn check_standard_output(&self, json: bool) -> Result<(), Failure> {
        if !self.is_standard_output() {
            return match self.format {
                None => Ok(()),
                Some(_) => Err(Failure::usage(
                    "The name of a file says its format: leave --format out, or give -o - for standard output.",
                )),
            };
        }
        if !self.aov.0.is_empty() {
            return Err(Failure::usage(
                "Standard output takes a picture alone: leave --aov out, or give -o a name.",
            ));
        }
        if json {
            return Err(Failure::usage(
                "Standard output takes a picture or JSON: leave --json out, or give -o a name.",
            ));
        }
        if std::io::stdout().is_terminal() {
            return Err(Failure::usage(
                "A terminal cannot show the bytes of a picture: send standard output somewhere else, or give -o a name.",
            ));
        }
        Ok(())
    }
}
