//! Pictures in f64: the reference that every other renderer is measured by.
//!
//! T. Whitted, "An improved illumination model for shaded display" (CACM 23(6), 1980), by recursion, with all that
//! docs/scene-files.md says of surfaces, light and limits, on top of [`Oracle`]. It is written on its own and shares no line
//! with `oktant-shared`, of which it reads data only: what a person described, as [`Model`] and [`View`] hold it. It is slow
//! and exact: what a picture of another renderer differs in is that one's error.

mod camera;
mod environment;
mod light;
mod media;
mod optics;
mod picture;
mod sampling;
mod shadow;
mod sitting;
mod surface;
#[cfg(test)]
mod tests;
mod texture;
mod trace;
mod world;

pub use sitting::{FirstHit, Sitting, Takes};

use super::Oracle;
use crate::build_error::BuildError;
use crate::model::Model;
use crate::scene::{SceneError, validate_model};
use crate::view::View;
use oktant_shared::material::Material;
use std::sync::Arc;

/// A model ready for pictures in f64.
#[derive(Debug)]
pub struct Reference {
    model: Arc<Model>,
    oracle: Oracle,
    is_transparent: bool,
}

impl Reference {
    /// Takes a model over and builds the oracle's hierarchy, on all of rayon's threads.
    ///
    /// # Errors
    /// As [`crate::scene::Scene::of_model`]: where there is nothing to see, and where the model breaks a rule.
    pub fn new(model: Arc<Model>) -> Result<Self, SceneError> {
        validate_model(&model)?;
        let oracle = Oracle::new(&model.mesh);
        let is_empty = !oracle.bounds().0.is_finite();
        if is_empty && model.planes.is_empty() {
            return Err(BuildError::NoArea.into());
        }
        Ok(Reference {
            is_transparent: model.materials.iter().any(transmits),
            oracle,
            model,
        })
    }

    /// What pictures are taken of.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Gets ready for a picture of `size` pixels in all, as [`View::frame`] does for the other renderers; `takes` says which
    /// samples of each pixel.
    pub fn sitting(&self, view: &View, size: [u32; 2], takes: Takes) -> Sitting<'_> {
        Sitting::new(self, view, size, takes)
    }
}

/// Whether light goes through a material.
fn transmits(material: &Material) -> bool {
    material.transmission.max_element() > 0.0
}
