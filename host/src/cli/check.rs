//! `oktant check`.

use super::Failure;
use super::arguments::CheckArguments;
use super::progress_bar::ProgressBar;
use super::render::counted;
use super::scene_source::refused;
use oktant::scene::Scene;
use oktant::source::Source;
use oktant::structure::StructureOptions;
use std::path::Path;

/// Says of each scene or mesh file what is in it, or what is wrong; fails where something is wrong with any.
pub fn run(arguments: &CheckArguments) -> Result<(), Failure> {
    let mut result = Ok(());
    for path in &arguments.scenes {
        match check(path) {
            Ok(line) => super::print(&line)?,
            Err(failure) => {
                failure.tell();
                result = Err(Failure::told());
            }
        }
    }
    result
}

/// Reads a file with all that it refers to, builds its structure, and returns a line about what is in it.
fn check(path: &Path) -> Result<String, Failure> {
    let bar = ProgressBar::new();
    let progress = |stage, fraction| bar.show(stage, fraction);
    let source = Source::from_path(path.to_path_buf());
    let model = source.load(&progress)?.model;
    let counts = [
        counted(model.mesh.triangles.len(), "triangle"),
        counted(model.planes.len(), "plane"),
        counted(model.materials.len(), "material"),
        counted(model.lights.len(), "light"),
        counted(model.textures.len(), "texture"),
    ];
    Scene::of_model(model, &StructureOptions::default(), &progress).map_err(|error| refused(source, error))?;
    Ok(format!("{}: {}: ok\n", path.display(), counts.join(", ")))
}
