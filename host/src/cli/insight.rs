//! `oktant render --show`.

use super::Failure;
use super::arguments::{RenderArguments, Switch};
use super::cells;
use super::prepared::Prepared;
use super::progress_bar::ProgressBar;
use super::render::counted;
use oktant::backend::BackendChoice;
use oktant::insight::{Aspect, Drawing, Insight, Legend};
use oktant::output::{Format, PictureFile};
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// Asks the pixels of a picture, writes what they tell into a file, and says what it is.
pub fn run(arguments: &RenderArguments, aspect: Aspect) -> Result<(), Failure> {
    let RenderArguments { mesh, files, look, .. } = arguments;
    look.check(&mesh.source()?)?;
    let format = format(arguments, aspect)?;
    files.check_standard_output(arguments.json)?;
    let file = if files.is_standard_output() {
        PictureFile::standard_output()?
    } else {
        PictureFile::create(&files.output)?
    };
    let prepared = Prepared::load(mesh, arguments.size, look, None)?;
    if prepared.is_pair() {
        return Err(Failure::usage(
            "What pixels tell is one picture, and sequential eyes have two: give --stereo none, or another kind.",
        ));
    }
    let (scene, size) = (&prepared.scene, prepared.size);
    let frame = prepared.frame(&prepared.view);
    let cells = cells::layer(files, scene, &frame)?;
    let start = Instant::now();
    let bar = ProgressBar::new();
    let never = AtomicBool::new(false);
    let insight = Insight::new(aspect, scene, &frame, &never, &|stage, fraction| {
        bar.show(stage, fraction)
    })?;
    drop(bar);
    let Some(insight) = insight else { return Ok(()) };
    let seconds = start.elapsed().as_secs_f64();
    let legend = Legend::new(&insight, scene.parts.traversal, arguments.insight.range);
    if format == Format::Exr {
        file.save_insight(&insight)?;
    } else {
        let mut drawing = Drawing::new(&insight, &legend);
        if let Some(cells) = cells {
            cells.over(&mut drawing.pixels);
        }
        if arguments.insight.legend != Some(Switch::Off) {
            drawing = drawing.with(&legend);
        }
        file.save_described(&drawing.pixels, drawing.size, legend.sentence())?;
    }
    eprintln!(
        "{}: {} x {} pixels, {}, --traversal {}, CPU, {seconds:.3} s",
        files.output.display(),
        size.width,
        size.height,
        counted(prepared.triangles, "triangle"),
        scene.parts.traversal,
    );
    eprintln!("{}", legend.sentence());
    if arguments.json {
        super::print(&format!("{}\n", serde_json::to_string(&legend)?))?;
    }
    Ok(())
}

/// The format that is asked for, if everything that is asked for goes with it and with the aspect.
fn format(arguments: &RenderArguments, aspect: Aspect) -> Result<Format, Failure> {
    let usage = |error: &dyn std::error::Error| Failure::usage(error.to_string());
    aspect
        .check(arguments.mesh.structure.traversal)
        .map_err(|error| usage(&error))?;
    if arguments.engine.choice() == BackendChoice::Gpu {
        return Err(Failure::usage(
            "What pixels tell is counted on the CPU: leave --backend gpu out.",
        ));
    }
    let output = &arguments.files.name();
    let format = Format::new(output, None).map_err(|error| usage(&error))?;
    cells::check(&arguments.files, format)?;
    let options = &arguments.insight;
    if format == Format::Exr && (options.range.is_some() || options.legend.is_some()) {
        return Err(Failure::usage(format!(
            "EXR files hold the numbers as they are, without colours: leave --range and --legend out, or give {} a name \
             that ends in .png.",
            output.display()
        )));
    }
    if options.range.is_some() && !aspect.is_number() {
        return Err(Failure::usage(format!(
            "Pixels tell no numbers of {aspect}: leave --range out, or show something else, for example --show steps."
        )));
    }
    Ok(format)
}
