//! `oktant check`.

use super::Failure;
use super::arguments::CheckArguments;
use super::progress_bar::ProgressBar;
use super::render::counted;
use super::scene_source::refused;
use oktant::scene::Scene;
use oktant::source::Source;
use oktant::structure::StructureOptions;

/// Reads each scene or mesh file with all that it refers to and builds its structure, and says what is in it.
pub fn run(arguments: &CheckArguments) -> Result<(), Failure> {
    for path in &arguments.scenes {
        let bar = ProgressBar::new();
        let progress = |stage, fraction| bar.show(stage, fraction);
        let source = Source::from_path(path.clone());
        let setting = source.load(&progress)?;
        let model = setting.model;
        let counts = [
            counted(model.mesh.triangles.len(), "triangle"),
            counted(model.planes.len(), "plane"),
            counted(model.materials.len(), "material"),
            counted(model.lights.len(), "light"),
            counted(model.textures.len(), "texture"),
        ];
        Scene::of_model(model, &StructureOptions::default(), &progress).map_err(|error| refused(source, error))?;
        drop(bar);
        super::print(&format!("{}: {}: ok\n", path.display(), counts.join(", ")))?;
    }
    Ok(())
}
