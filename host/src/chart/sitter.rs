//! What pictures are taken of, for charts of their error.

use super::plan::MeasureError;
use crate::bench::Tracer;
use crate::compare::{Comparison, Shot, compare};
use crate::effort::Effort;
use crate::model::Model;
use crate::oracle::whitted::{Reference, Takes};
use crate::picture::Picture;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::source::Source;
use crate::structure::StructureOptions;
use crate::view::View;
use glam::UVec2;
use oktant_shared::frame::Frame;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// A scene in f32 and in f64, with its view for one eye.
pub(super) struct Sitter {
    /// In a few letters.
    pub name: String,
    pub scene: Arc<Scene>,
    pub view: View,
    reference: Reference,
    size: UVec2,
}

/// A picture of a back end.
pub(super) struct Taken {
    pub picture: Picture,
    /// How far it is from the one that it should be.
    pub comparison: Comparison,
    /// What it took, and what was left out of it.
    pub effort: Effort,
}

impl Sitter {
    /// Loads it.
    pub fn load(source: &Source, size: UVec2, progress: Progress<'_>) -> Result<Self, MeasureError> {
        let setting = source.load(progress)?;
        let model = Arc::new(setting.model);
        let scene = Scene::of_model(Model::clone(&model), &StructureOptions::default(), progress)?;
        Ok(Sitter {
            name: super::plan::mesh_name(&source.to_string()).into(),
            scene: Arc::new(scene),
            view: View {
                stereo: None,
                ..setting.view
            },
            reference: Reference::new(model)?,
            size,
        })
    }

    /// A picture in f64.
    pub fn wanted(&self, view: &View, takes: Takes, progress: Progress<'_>) -> Result<Shot, MeasureError> {
        let sitting = self.reference.sitting(view, self.size.to_array(), takes);
        let never = AtomicBool::new(false);
        let picture = sitting.render(&never, progress);
        Ok(Shot::of_picture(&picture.expect("nobody cancels")))
    }

    /// The frame of a picture of a back end.
    pub fn frame(&self, view: &View) -> Frame {
        view.frame(&self.scene, self.size.x, self.size.y)
    }

    /// A picture of a back end, beside the one that it should be.
    pub fn taken(&self, tracer: &mut Tracer, view: &View, wanted: &Shot) -> Result<Taken, MeasureError> {
        let frame = self.frame(view);
        let picture = tracer.render(&frame)?;
        let (comparison, _) = compare(wanted, &Shot::of_picture(&picture), 0.0).map_err(Box::new)?;
        Ok(Taken {
            effort: Effort::new(&picture, Some((&self.scene, &frame))),
            picture,
            comparison,
        })
    }

    /// The shortest of some times that a picture takes, milliseconds.
    pub fn milliseconds(&self, tracer: &mut Tracer, view: &View, repeats: u32) -> Result<f64, MeasureError> {
        let times = tracer.time_render(&self.frame(view), repeats)?;
        Ok(super::plan::quickest(&times))
    }
}
