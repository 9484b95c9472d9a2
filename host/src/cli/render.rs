//! `oktant render`.

use super::Failure;
use super::arguments::{EngineArguments, FileArguments, LookArguments, MeshArguments, RenderArguments, Size};
use super::cells;
use super::frames;
use super::prepared::{Prepared, is_pair};
use super::progress_bar::ProgressBar;
use super::rendering_report::{Figures, RenderingReport};
use oktant::effort::Effort;
use oktant::output::{Format, RenderingFiles, Written};
use oktant::stereo::StereoMode;
use oktant::view::View;
use oktant_shared::variant::Variant;

pub fn run(arguments: &RenderArguments) -> Result<(), Failure> {
    if let Some(range) = &arguments.frames.frames {
        return frames::run(arguments, range);
    }
    render(&Order {
        mesh: &arguments.mesh,
        files: &arguments.files,
        size: arguments.size,
        look: &arguments.look,
        engine: &arguments.engine,
        repeat: arguments.repeat,
        variant: arguments.variant.map(|variant| variant.0),
        json: arguments.json,
    })
}

/// A picture that is asked for.
pub struct Order<'a> {
    pub mesh: &'a MeshArguments,
    pub files: &'a FileArguments,
    pub size: Option<Size>,
    pub look: &'a LookArguments,
    pub engine: &'a EngineArguments,
    /// How often its kernel is timed, where more than once.
    pub repeat: u32,
    pub variant: Option<Variant>,
    /// Whether standard output is told of it as JSON.
    pub json: bool,
}

/// Renders a picture into its files and says what was done.
pub fn render(order: &Order<'_>) -> Result<(), Failure> {
    let Order { mesh, files, look, .. } = order;
    look.check(&mesh.source()?)?;
    let format = format(files, look)?;
    files.check_standard_output(order.json)?;
    let engine = order.engine.options()?;
    let aovs = files.aov.0.as_slice();
    // First of all, so that nobody waits for a picture that cannot be stored.
    let mut output = create(files, format, look.asks_for_pair())?;
    let mut prepared = Prepared::load(mesh, order.size, look, order.variant)?;
    output = for_view(output, &prepared.view, |is_pair| create(files, format, is_pair))?;
    let frame = prepared.frame(&prepared.view);
    let output = output.under(cells::layer(files, &prepared.scene, &frame)?);
    let mut engine = prepared.engine(mesh, look, &engine)?;
    let bar = ProgressBar::new();
    let rendered = prepared.render(&mut engine, &prepared.view, aovs, &|stage, fraction| {
        bar.show(stage, fraction);
    })?;
    drop(bar);
    let mut figures = Figures::new(&rendered);
    let written = output.save(rendered.picture, rendered.seen, &prepared.view.tone)?;
    eprintln!(
        "{}: {} x {} pixels, {} each, {}, {}, {:.3} s",
        pictures(&written),
        prepared.size.width,
        prepared.size.height,
        prepared.samples(figures.mean_samples),
        counted(prepared.triangles, "triangle"),
        engine.name(),
        figures.seconds,
    );
    describe(&written);
    if !prepared.scene.is_plain() {
        eprintln!("{}", told(&figures.effort, figures.seconds));
    }
    figures.time(&mut engine, &rendered.frame, order.repeat)?;
    if order.json {
        return RenderingReport::of_picture(&prepared, &engine, &written, &figures).print();
    }
    print_kernel(&figures, files)
}

/// Prints the times of the kernel, if they were measured, where no picture goes.
pub fn print_kernel(figures: &Figures, files: &FileArguments) -> Result<(), Failure> {
    match figures.kernel_line() {
        Some(line) if files.is_standard_output() => {
            eprint!("{line}");
            Ok(())
        }
        Some(line) => super::print(&line),
        None => Ok(()),
    }
}

/// The files of a picture, in the making.
///
/// # Errors
/// Where one of them cannot be written, or standard output would have to take two pictures.
pub fn create(files: &FileArguments, format: Format, is_pair: bool) -> Result<RenderingFiles, Failure> {
    if !files.is_standard_output() {
        return Ok(RenderingFiles::create(&files.output, format, &files.aov.0, is_pair)?);
    }
    check_one_picture(is_pair)?;
    Ok(RenderingFiles::standard_output(format)?)
}

/// Makes sure that standard output is to take one picture only.
pub fn check_one_picture(is_pair: bool) -> Result<(), Failure> {
    if is_pair {
        return Err(Failure::usage(
            "Standard output takes one picture, and --stereo sequential makes two: give -o a name, or another kind of \
             --stereo.",
        ));
    }
    Ok(())
}

/// The format of a picture that is asked for, if everything that is asked for goes with it.
pub fn format(files: &FileArguments, look: &LookArguments) -> Result<Format, Failure> {
    let name = files.name();
    if files.animation()?.is_some() {
        return Err(Failure::usage(format!(
            "{} holds an animation: say with --frames how many pictures it has, or give a name that ends in .png or .exr.",
            name.display()
        )));
    }
    let format = Format::new(&name, files.bits).map_err(|error| Failure::usage(error.to_string()))?;
    if format == Format::Exr && (look.exposure.is_some() || look.tone.is_some()) {
        return Err(Failure::usage(format!(
            "EXR files hold the light as it is: leave --exposure and --tone out, or give {} a name that ends in .png.",
            name.display()
        )));
    }
    cells::check(files, format)?;
    Ok(format)
}

/// The files for as many eyes as a view has: a scene may say more than the command line did.
pub fn for_view(
    files: RenderingFiles,
    view: &View,
    create: impl Fn(bool) -> Result<RenderingFiles, Failure>,
) -> Result<RenderingFiles, Failure> {
    if files.is_pair() == is_pair(view) {
        Ok(files)
    } else {
        create(is_pair(view))
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
