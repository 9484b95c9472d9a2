//! `oktant render`.

use super::Failure;
use super::arguments::{
    EngineArguments, FileArguments, LookArguments, MeshArguments, RenderArguments, Size, StereoArgument,
};
use super::engine::Engine;
use super::progress_bar::ProgressBar;
use oktant::effort::Effort;
use oktant::output::{Format, OutputError, RenderingFiles, Written};
use oktant::scene::Scene;
use oktant::seen::Seen;
use oktant::stereo::StereoMode;
use oktant::view::View;
use oktant_shared::parts::Parts;
use oktant_shared::variant::Variant;
use std::sync::Arc;
use std::time::Instant;

pub fn run(arguments: &RenderArguments) -> Result<(), Failure> {
    render(
        &arguments.mesh,
        &arguments.files,
        arguments.size,
        &arguments.look,
        &arguments.engine,
        arguments.repeat,
        arguments.variant.map(|variant| variant.0),
    )
}

/// Renders a picture into its files and says what was done.
pub fn render(
    mesh: &MeshArguments,
    files: &FileArguments,
    size: Option<Size>,
    look: &LookArguments,
    engine: &EngineArguments,
    repeat: u32,
    variant: Option<Variant>,
) -> Result<(), Failure> {
    look.check(&mesh.source())?;
    let format = format(files, look)?;
    let engine = engine.options()?;
    let aovs = files.aov.0.as_slice();
    let create = |is_pair| RenderingFiles::create(&files.output, format, aovs, is_pair);
    // First of all, so that nobody waits for a picture that cannot be stored.
    let mut output = create(look.stereo == Some(StereoArgument(Some(StereoMode::Sequential))))?;
    let loaded = mesh.load()?;
    let triangles = loaded.triangles;
    let size = size.or(loaded.size.map(Size::from)).unwrap_or_default();
    let view = look.applied(loaded.view);
    look.check_eyes(view.stereo.is_some())?;
    look.check_sampling(view.adaptive)?;
    output = for_view(output, &view, create)?;
    check_halves(&view, size)?;
    let scene = Arc::new(by_variant(loaded.scene, variant)?);
    let frame = view.frame(&scene, size.width, size.height);
    let mut engine = Engine::new(&engine, &scene)?;
    let start = Instant::now();
    let bar = ProgressBar::new();
    let picture = engine.render(&frame, &|stage, fraction| bar.show(stage, fraction))?;
    drop(bar);
    let seconds = start.elapsed().as_secs_f64();
    let effort = Effort::new(&picture, Some(&frame));
    let samples = if view.adaptive {
        format!(
            "up to {} samples, {:.2} in the mean,",
            view.samples.count(),
            picture.mean_samples()
        )
    } else {
        counted(frame.sample_count as usize, "sample")
    };
    let seen = if aovs.is_empty() {
        Seen::default()
    } else {
        Seen::new(&frame, &scene, |frame| engine.hits(frame))?
    };
    let written = output.save(picture, seen, &view.tone)?;
    eprintln!(
        "{}: {} x {} pixels, {samples} each, {}, {}, {seconds:.3} s",
        pictures(&written),
        size.width,
        size.height,
        counted(triangles, "triangle"),
        engine.name(),
    );
    describe(&written);
    if !scene.is_plain() {
        eprintln!("{}", told(&effort, seconds));
    }
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

/// The scene, to be rendered by a variant of the kernel if one is asked for.
fn by_variant(scene: Scene, variant: Option<Variant>) -> Result<Scene, Failure> {
    let Some(variant) = variant else { return Ok(scene) };
    if scene.parts != Parts::default() {
        return Err(Failure::usage(
            "Only the default parts have variants: leave --variant out, or --traversal, --triangle and --box.",
        ));
    }
    let least = scene.variant;
    scene.rendered_by(variant).ok_or_else(|| {
        Failure::usage(format!(
            "The variant `{variant}` leaves out what this scene needs: leave --variant out, or give {least} or a greater one."
        ))
    })
}

/// The format that is asked for, if everything that is asked for goes with it.
pub fn format(files: &FileArguments, look: &LookArguments) -> Result<Format, Failure> {
    let format = Format::new(&files.output, files.bits).map_err(|error| Failure::usage(error.to_string()))?;
    if format == Format::Exr && (look.exposure.is_some() || look.tone.is_some()) {
        return Err(Failure::usage(format!(
            "EXR files hold the light as it is: leave --exposure and --tone out, or give {} a name that ends in .png.",
            files.output.display()
        )));
    }
    Ok(format)
}

/// The files for as many eyes as a view has: a scene may say more than the command line did.
pub fn for_view(
    files: RenderingFiles,
    view: &View,
    create: impl Fn(bool) -> Result<RenderingFiles, OutputError>,
) -> Result<RenderingFiles, OutputError> {
    let is_pair = view.stereo.is_some_and(|stereo| stereo.mode == StereoMode::Sequential);
    if files.is_pair() == is_pair {
        Ok(files)
    } else {
        create(is_pair)
    }
}

/// Screens take a picture for two eyes apart in its middle.
pub fn check_halves(view: &View, size: Size) -> Result<(), Failure> {
    let is_halved = view.stereo.is_some_and(|stereo| stereo.mode == StereoMode::SideBySide);
    if is_halved && size.width % 2 == 1 {
        return Err(Failure::usage(format!(
            "Pictures side by side are equally wide, and {} pixels have no half: give --size {}x{}.",
            size.width,
            size.width + 1,
            size.height
        )));
    }
    Ok(())
}

/// Says how to read the files that are no pictures of the scene.
pub fn describe(written: &[Written]) {
    for file in written {
        if let Some(description) = &file.description {
            eprintln!("{}: {description}", file.path.display());
        }
    }
}

/// Names of the pictures of the scene.
pub fn pictures(written: &[Written]) -> String {
    let pictures = written.iter().filter(|file| file.description.is_none());
    let names: Vec<_> = pictures.map(|file| file.path.display().to_string()).collect();
    names.join(" and ")
}

/// The rays that were traced, and a bound of what is missing for those that were not.
pub fn told(effort: &Effort, seconds: f64) -> String {
    let mut text = format!(
        "{} rays ({} for closest hits, {} for shadows), {} a second; rays that were cut off would add at most {} of the \
         brightest light to a pixel, {} in the mean",
        many(effort.rays()),
        many(effort.closest),
        many(effort.shadow),
        many(effort.rays() / seconds),
        percent(effort.greatest_cut),
        percent(effort.mean_cut),
    );
    if effort.greatest_steps > 0.0 {
        text += &format!(
            ", and change the output by at most {} steps of 8 bits, {} in the mean",
            hundredths(effort.greatest_steps),
            hundredths(effort.mean_steps),
        );
    }
    text
}

/// A number of things, in millions where there are as many.
fn many(count: f64) -> String {
    if count < 1e6 {
        format!("{count:.0}")
    } else {
        format!("{:.2} million", count / 1e6)
    }
}

/// A part of one, rounded up, so that a bound stays one.
fn percent(part: f64) -> String {
    format!("{:.2} %", (part * 1e4).ceil() / 1e2)
}

/// A bound, rounded up to hundredths.
fn hundredths(bound: f64) -> String {
    format!("{:.2}", (bound * 1e2).ceil() / 1e2)
}

/// A number with its noun.
pub fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_rounded_up() {
        assert_eq!(percent(0.0), "0.00 %");
        assert_eq!(percent(0.003_12), "0.32 %");
        assert_eq!(percent(1e-9), "0.01 %");
        assert_eq!(percent(1.0), "100.00 %");
    }

    #[test]
    fn a_few_are_no_millions() {
        assert_eq!(many(0.0), "0");
        assert_eq!(many(4_096.0), "4096");
        assert_eq!(many(1_250_000.0), "1.25 million");
    }

    #[test]
    fn what_was_cut_is_told() {
        let effort = Effort {
            closest: 3e6,
            shadow: 1.5e6,
            greatest_cut: 0.0031,
            mean_cut: 0.00001,
            greatest_steps: 0.891,
            mean_steps: 0.02,
        };
        assert_eq!(
            told(&effort, 0.5),
            "4.50 million rays (3.00 million for closest hits, 1.50 million for shadows), 9.00 million a second; rays \
             that were cut off would add at most 0.31 % of the brightest light to a pixel, 0.01 % in the mean, \
             and change the output by at most 0.90 steps of 8 bits, 0.02 in the mean"
        );
    }
}
