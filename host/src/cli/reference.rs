//! `oktant render --reference`.

use super::Failure;
use super::arguments::{RenderArguments, Size};
use super::progress_bar::ProgressBar;
use super::render::{check_halves, counted, create, describe, for_view, format, pictures, told};
use super::scene_source::{refused, unsettable};
use oktant::effort::Effort;
use oktant::oracle::whitted::{Reference, Takes};
use oktant::seen::Seen;
use oktant::standpoint::Origin;
use oktant::viewer::GivenSetting;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// Renders a picture in f64 into its files and says what was done.
pub fn run(arguments: &RenderArguments, takes: Takes) -> Result<(), Failure> {
    let RenderArguments { mesh, files, look, .. } = arguments;
    if takes != Takes::View && (look.samples.is_some() || look.pattern.is_some()) {
        return Err(Failure::usage(
            "--reference=SAMPLES says itself how many samples there are, and where; leave --samples and --pattern out, or \
             give --reference alone.",
        ));
    }
    let source = mesh.source()?;
    look.check(&source)?;
    if look.samples.is_some_and(|count| count.adaptive) {
        return Err(Failure::usage(
            "A reference takes as many samples everywhere: give --samples a number alone.",
        ));
    }
    let format = format(files, look)?;
    files.check_standard_output(false)?;
    let aovs = files.aov.0.as_slice();
    let mut output = create(files, format, look.asks_for_pair())?;
    let bar = ProgressBar::new();
    let mut setting = source.load(&|stage, fraction| bar.show(stage, fraction))?;
    GivenSetting::put_all(&look.set, &mut setting).map_err(unsettable)?;
    let size = arguments
        .size
        .or(setting.size.map(Size::from))
        .unwrap_or_else(Size::preferred);
    let mesh = &setting.model.mesh;
    let origin = Origin {
        focus: setting.model.focus.unwrap_or_else(|| mesh.bounding_sphere()),
        shift: mesh.shift,
    };
    let view = look.applied_with(look.view_file()?.as_ref(), setting.view, &origin);
    look.check_eyes(view.stereo.is_some())?;
    look.check_projection(&view)?;
    look.check_sampling(false)?;
    output = for_view(output, &view, |is_pair| create(files, format, is_pair))?;
    check_halves(&view, size)?;
    let reference = Reference::new(Arc::new(setting.model)).map_err(|error| refused(source, error))?;
    let sitting = reference.sitting(&view, [size.width, size.height], takes);
    let start = Instant::now();
    let never = AtomicBool::new(false);
    let Some(picture) = sitting.render(&never, &|stage, fraction| bar.show(stage, fraction)) else {
        return Ok(());
    };
    drop(bar);
    let seconds = start.elapsed().as_secs_f64();
    let effort = Effort::new(&picture, None);
    let seen = if aovs.is_empty() {
        Seen::default()
    } else {
        sitting.seen()
    };
    let written = output.save(picture, seen, &view.tone)?;
    eprintln!(
        "{}: {} x {} pixels, {} each, {}, in double precision, {seconds:.3} s",
        pictures(&written),
        size.width,
        size.height,
        counted(sitting.sample_count(), "sample"),
        counted(reference.model().mesh.triangles.len(), "triangle"),
    );
    describe(&written);
    eprintln!("{}", told(&effort, seconds));
    Ok(())
}
