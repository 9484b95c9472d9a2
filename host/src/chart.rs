//! Charts of speed against error: what is measured, and how it is drawn.
//!
//! A [`Figure`] holds panels and records; [`Figure::save`] writes it as SVG, PNG and CSV. Whoever measures something only
//! fills records in.

mod accuracy;
mod axis;
mod canvas;
mod csv_file;
mod depth_error;
mod drawing;
mod figure;
mod font;
mod growth;
mod image_error;
mod labels;
mod leaks;
mod legend;
mod memory;
mod octree;
mod origin;
mod panel;
mod pareto;
mod peers;
mod plan;
mod plot;
mod range;
mod record;
mod render;
mod samples;
mod sitter;
mod style;

pub use accuracy::accuracy;
pub use axis::{Axis, Scale};
pub use csv_file::ChartFileError;
pub use depth_error::depth_error;
pub use figure::{Figure, Panel};
pub use growth::growth;
pub use image_error::image_error;
pub use leaks::{LEAKS, leak_rays};
pub use memory::memory;
pub use octree::octree;
pub use origin::{Origin, command_line, commit, processor};
pub use pareto::{Better, front};
pub use peers::peers;
pub use plan::{MeasureError, Plan, chart_name};
pub use range::range;
pub use record::{Record, Value};
pub use render::ChartError;
pub use samples::samples;
