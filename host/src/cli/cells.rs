//! `oktant render --cells`.

use super::Failure;
use super::arguments::FileArguments;
use oktant::output::Format;
use oktant::scene::Scene;
use oktant::wires::{Layer, Selection, of_scene};
use oktant_shared::frame::Frame;
use oktant_shared::stereo::MONO;

/// Makes sure that cells can be drawn in a file of that format.
pub fn check(files: &FileArguments, format: Format) -> Result<(), Failure> {
    if files.cells.is_some() && format == Format::Exr {
        return Err(Failure::usage(format!(
            "EXR files hold what was computed, without drawings: leave --cells out, or give {} a name that ends in .png.",
            files.output.display()
        )));
    }
    Ok(())
}

/// The cells that are to be drawn over the picture of a frame, if any are; says what they are.
pub fn layer(files: &FileArguments, scene: &Scene, frame: &Frame) -> Result<Option<Layer>, Failure> {
    let Some(selection) = files.cells else { return Ok(None) };
    if frame.stereo != MONO {
        return Err(Failure::usage(
            "Cells are drawn as one eye sees them: leave --cells out, or give --stereo none.",
        ));
    }
    let size = frame.size();
    if let Selection::Pixel([x, y]) = selection
        && (x >= size.x || y >= size.y)
    {
        return Err(Failure::usage(format!(
            "--cells {x},{y} is outside of the picture: give a pixel from 0,0 to {},{}.",
            size.x - 1,
            size.y - 1
        )));
    }
    let (layer, chosen) = of_scene(scene, selection, frame);
    eprintln!("{chosen}");
    Ok(Some(layer))
}
