//! What fails: methods as they were published, as others use them, as a compiler rounds them, and slips of the thesis of
//! 2011. None of them renders; they are here so that every row of the lab shows that its rays are hard.

pub mod box_tests;
pub mod cell_grid;
pub mod cells;
pub mod optics;
pub mod origins;
pub mod quantised;
pub mod revelles;
pub mod rounding;
pub mod structures;
pub mod triangle_tests;

#[cfg(test)]
mod tests;
