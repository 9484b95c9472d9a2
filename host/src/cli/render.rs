//! `oktant render`.

use super::Failure;
use super::arguments::{EngineArguments, LookArguments, MeshArguments, RenderArguments, Size};
use super::engine::Engine;
use super::progress_bar::ProgressBar;
use oktant::output::PictureFile;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

pub fn run(arguments: &RenderArguments) -> Result<(), Failure> {
    render(
        &arguments.mesh,
        &arguments.output,
        arguments.size,
        &arguments.look,
        &arguments.engine,
        arguments.repeat,
    )
}

/// Renders a picture into a file and says what was done.
pub fn render(
    mesh: &MeshArguments,
    output: &Path,
    size: Option<Size>,
    look: &LookArguments,
    engine: &EngineArguments,
    repeat: u32,
) -> Result<(), Failure> {
    if !output
        .extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("png"))
    {
        return Err(Failure::usage(format!(
            "Pictures are PNG files: give {} a name that ends in .png.",
            output.display()
        )));
    }
    // First of all, so that nobody waits for a picture that cannot be stored.
    let file = PictureFile::create(output)?;
    let loaded = mesh.load()?;
    let triangles = loaded.triangles;
    let size = size.or(loaded.size.map(Size::from)).unwrap_or_default();
    let view = look.applied(loaded.view);
    let scene = Arc::new(loaded.scene);
    let frame = view.frame(&scene, size.width, size.height);
    let mut engine = Engine::new(engine, &scene)?;
    let start = Instant::now();
    let bar = ProgressBar::new();
    let picture = engine.render(&frame, &|stage, fraction| bar.show(stage, fraction))?;
    drop(bar);
    let seconds = start.elapsed().as_secs_f64();
    file.save(&picture)?;
    eprintln!(
        "{}: {} x {} pixels, {} each, {}, {}, {seconds:.3} s",
        output.display(),
        size.width,
        size.height,
        counted(frame.sample_count as usize, "sample"),
        counted(triangles, "triangle"),
        engine.name(),
    );
    if repeat > 1 {
        let mut times = engine.time_render(&frame, repeat)?;
        times.sort_by(f64::total_cmp);
        super::print(&format!(
            "kernel: median {:.3} ms, least {:.3}, greatest {:.3} of {repeat}\n",
            times[times.len() / 2],
            times[0],
            times[times.len() - 1],
        ))?;
    }
    Ok(())
}

/// A number with its noun.
pub fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}
