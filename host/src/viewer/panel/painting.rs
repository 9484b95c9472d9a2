//! The panel as triangles, for whoever draws it.

use egui::epaint::ImageDelta;
use egui::{ClippedPrimitive, Color32, ColorImage, ImageData, TextureId, TextureOptions, TexturesDelta};
use std::collections::HashMap;
use std::sync::Arc;

/// Triangles with their textures.
#[derive(Default)]
pub struct Painting {
    /// Triangles, those in front last, each list with where it may be drawn; points.
    pub primitives: Vec<ClippedPrimitive>,
    /// Physical pixels to a point.
    pub scale: f32,
    /// What lies on the triangles.
    pub textures: HashMap<TextureId, Texture>,
    changes: u64,
}

/// A texture, whole.
pub struct Texture {
    /// Its texels.
    pub image: Arc<ColorImage>,
    /// How it is looked up.
    pub options: TextureOptions,
    /// Another number than all textures and all states of this one before have.
    pub version: u64,
}

impl Painting {
    /// Takes another layout, and what has changed in the textures.
    pub fn update(&mut self, primitives: Vec<ClippedPrimitive>, scale: f32, mut changed: TexturesDelta) {
        (self.primitives, self.scale) = (primitives, scale);
        for (id, deltas) in std::mem::take(&mut changed.set) {
            for delta in deltas {
                self.change(id, delta);
            }
        }
        for id in std::mem::take(&mut changed.free) {
            self.textures.remove(&id);
        }
    }

    fn change(&mut self, id: TextureId, delta: ImageDelta) {
        self.changes += 1;
        let version = self.changes;
        let ImageDelta { image, options, pos } = delta;
        let ImageData::Color(image) = image;
        match (pos, self.textures.get_mut(&id)) {
            (Some(at), Some(texture)) => {
                copy(&image, at, Arc::make_mut(&mut texture.image));
                (texture.options, texture.version) = (options, version);
            }
            (_, _) => {
                self.textures.insert(
                    id,
                    Texture {
                        image,
                        options,
                        version,
                    },
                );
            }
        }
    }
}

/// Copies a part of a picture to its place in it.
fn copy(part: &ColorImage, [left, top]: [usize; 2], whole: &mut ColorImage) {
    let [width, _] = part.size;
    let stride = whole.size[0];
    for (row, y) in part.pixels.chunks_exact(width).zip(top..) {
        let start = y * stride + left;
        whole.pixels[start..start + width].copy_from_slice(row);
    }
}

impl Texture {
    /// The texel in a column and a row; beyond the edges, the one at the edge.
    pub fn texel(&self, column: i32, row: i32) -> Color32 {
        let [width, height] = self.image.size;
        let column = column.clamp(0, width as i32 - 1) as usize;
        let row = row.clamp(0, height as i32 - 1) as usize;
        self.image.pixels[row * width + column]
    }
}
