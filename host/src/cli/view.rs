//! `oktant view`, and `oktant` alone.

use super::Failure;
use super::arguments::{FileArguments, SwitchArgument, ViewArguments};
use super::render::{Order, render};
use super::scene_source::unsettable;
use directories::ProjectDirs;
use oktant::viewer::{LoadError, Look, ViewerError, ViewerOptions};
use std::path::PathBuf;
use std::time::Duration;

/// The picture that stands in for the window where there is no display.
const PICTURE: &str = "oktant.png";

pub fn run(arguments: &ViewArguments) -> Result<(), Failure> {
    let source = arguments.mesh.source()?;
    arguments.look.check(&source)?;
    let look = arguments.look.clone();
    let file = look.view_file()?;
    let options = ViewerOptions {
        source,
        structure: arguments.mesh.structure.options()?,
        look: Look::new(move |view, origin| look.applied_with(file.as_ref(), view, origin)),
        set: arguments.look.set.clone(),
        size: arguments.size.map(|size| [size.width, size.height]),
        backend: arguments.engine.choice(),
        module: arguments.engine.module(),
        kernel: arguments.engine.kernel_file()?.map(PathBuf::from),
        target: Duration::from_millis(u64::from(arguments.target_ms)),
        script: arguments.script.clone(),
        panel: arguments.panel.map(|panel| panel == SwitchArgument::On),
        state: state_file(arguments.script.is_some()),
        pictures: PathBuf::from("."),
    };
    match oktant::viewer::run(options) {
        Ok(()) => Ok(()),
        Err(ViewerError::Script(error)) => Err(Failure::usage(error.to_string())),
        Err(ViewerError::Load(LoadError::Unsettable(error))) => Err(unsettable(error)),
        Err(ViewerError::NoDisplay(reason)) if arguments.script.is_none() => {
            eprintln!("There is no display to open a window on ({reason}): rendering {PICTURE} instead.");
            render(&Order {
                mesh: &arguments.mesh,
                files: &FileArguments::picture(PICTURE),
                size: arguments.size,
                look: &arguments.look,
                engine: &arguments.engine,
                repeat: 1,
                variant: None,
                json: false,
            })
        }
        Err(error) => Err(error.into()),
    }
}

/// Where the viewer remembers its state: what the environment names, else the platform's place. Scripts remember nothing
/// unless they are told to.
fn state_file(is_script: bool) -> Option<PathBuf> {
    match std::env::var_os("OKTANT_STATE") {
        Some(path) => Some(PathBuf::from(path)).filter(|path| !path.as_os_str().is_empty()),
        None if is_script => None,
        None => {
            let folders = ProjectDirs::from("", "", "oktant")?;
            let folder = folders.state_dir().unwrap_or_else(|| folders.data_local_dir());
            Some(folder.join("viewer.toml"))
        }
    }
}
