//! What is asked of the work behind a picture, and the answers.

use super::pinned::Pinned;
use crate::insight::{Aspect, Drawing, Insight, Legend};
use crate::picture::Picture;
use crate::progress::silent;
use crate::sampling::Samples;
use crate::scene::Scene;
use crate::source::Source;
use crate::structure::StructureOptions;
use crate::tone::Tone;
use crate::view::View;
use crate::viewer::draft::Draft;
use crate::wires::{Layer, Selection, of_scene};
use glam::{DVec3, Vec3};
use oktant_shared::color::linear_from_srgb;
use oktant_shared::stereo::{MONO, STACKED};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Something to find out about a picture.
#[derive(Clone)]
pub struct Question {
    scene: Arc<Scene>,
    view: View,
    /// Width and height of the window's inside.
    size: [u32; 2],
    ask: Ask,
}

/// What.
#[derive(Clone, PartialEq)]
pub enum Ask {
    /// What all pixels tell.
    Pixels(Aspect),
    /// Where cells are.
    Cells(Selection),
    /// What becomes of a ray.
    Pin {
        /// The pixel that it goes through.
        pixel: [u32; 2],
        /// What the scene was made from.
        source: Source,
        /// What the loader moved its mesh by.
        shift: DVec3,
        /// How the structure was built.
        structure: StructureOptions,
    },
}

/// What was found out.
#[derive(Debug)]
pub enum Answer {
    /// What pixels tell.
    Pixels {
        /// In colours, to be shown without a tone curve.
        picture: Arc<Picture>,
        /// Whether it is two, the left eye's above the right eye's.
        is_stacked: bool,
        /// What those mean.
        legend: Legend,
    },
    /// Where cells are.
    Cells {
        /// Their lines; none where two eyes see the picture.
        layer: Option<Layer>,
        /// What they are.
        text: String,
        /// How many.
        count: usize,
    },
    /// What becomes of a ray.
    Pinned(Box<Pinned>),
}

/// Simplified, so that it is there soon: a pixel for sixteen.
const DRAFT: Draft = Draft {
    edge: 4,
    is_shallow: false,
    samples: Samples::One,
};

impl PartialEq for Question {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.scene, &other.scene)
            && self.view == other.view
            && self.size == other.size
            && self.ask == other.ask
    }
}

impl Question {
    /// A question about the picture of a scene in a window of that size. Of the view counts what can change the answer.
    pub fn new(scene: &Arc<Scene>, view: &View, size: [u32; 2], ask: Ask) -> Self {
        let takes_samples = matches!(ask, Ask::Pixels(aspect) if aspect.is_of_samples());
        let view = if takes_samples {
            View {
                tone: Tone::default(),
                ..*view
            }
        } else {
            let fixed = View::default();
            View {
                camera: view.camera,
                target: view.target,
                projection: view.projection,
                field_of_view: view.field_of_view,
                ortho_height: view.ortho_height,
                up: view.up,
                stereo: view.stereo,
                shading: view.shading,
                ..fixed
            }
        };
        Question {
            scene: scene.clone(),
            view,
            size,
            ask,
        }
    }

    /// Finds it out and tells it, at first roughly if that helps; false where `cancel` was raised before the end.
    ///
    /// # Errors
    /// A sentence that says why there is no answer.
    pub fn answer(&self, cancel: &AtomicBool, tell: &dyn Fn(Answer)) -> Result<bool, String> {
        let Question { scene, view, size, ask } = self;
        let frame = view.frame(scene, size[0], size[1]);
        match ask {
            Ask::Pixels(aspect) => {
                let draft = DRAFT.frame(view, scene, *size);
                for frame in [draft, frame] {
                    let insight = Insight::new(*aspect, scene, &frame, cancel, &silent);
                    let Some(insight) = insight.map_err(|error| error.to_string())? else {
                        return Ok(false);
                    };
                    let legend = Legend::new(&insight, scene.parts.traversal, None);
                    let picture = Arc::new(picture(&Drawing::new(&insight, &legend)));
                    tell(Answer::Pixels {
                        picture,
                        is_stacked: frame.stereo == STACKED,
                        legend,
                    });
                }
            }
            Ask::Cells(_) if frame.stereo != MONO => tell(Answer::Cells {
                layer: None,
                text: "cells are drawn for one eye only: press L".into(),
                count: 0,
            }),
            Ask::Cells(selection) => {
                let (layer, chosen) = of_scene(scene, *selection, &frame);
                tell(Answer::Cells {
                    layer: Some(layer),
                    text: chosen.to_string(),
                    count: chosen.cells.len(),
                });
            }
            Ask::Pin {
                pixel,
                source,
                shift,
                structure,
            } => {
                let pinned = Pinned::new(scene, &frame, *pixel);
                let pinned = pinned.replayed(scene, &frame, source, *shift, structure);
                tell(Answer::Pinned(Box::new(pinned)));
            }
        }
        Ok(true)
    }
}

/// The picture that is shown as these colours.
fn picture(drawing: &Drawing) -> Picture {
    let linear: Vec<f32> = (0..=u8::MAX)
        .map(|byte| linear_from_srgb(f32::from(byte) / 255.0))
        .collect();
    let pixels = drawing.pixels.as_chunks::<3>().0.iter();
    let sums = pixels.map(|pixel| Vec3::from_array(pixel.map(|byte| linear[usize::from(byte)])).extend(1.0));
    Picture::of_sums(drawing.size[0], drawing.size[1], sums.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_come_back_from_the_picture() {
        let pixels: Vec<u8> = (0..=254).collect();
        let drawing = Drawing {
            size: [85, 1],
            pixels: pixels.clone(),
        };
        assert_eq!(picture(&drawing).to_rgb8(&Tone::default()), pixels);
    }
}
