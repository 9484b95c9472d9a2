//! Perspective, and pictures without it.

use crate::model::Focus;
use crate::view::View;
use clap::ValueEnum;
use serde::{Deserialize, Serialize};

/// How the camera makes a picture of what is in space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, Deserialize, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Projection {
    /// What is farther away is smaller.
    #[default]
    Perspective,
    /// What is parallel stays parallel, and what is equally large stays so at any distance.
    Orthographic,
}

impl Projection {
    /// Both.
    pub const ALL: [Self; 2] = [Projection::Perspective, Projection::Orthographic];
}

impl View {
    /// Whether rays are parallel.
    pub fn is_orthographic(&self) -> bool {
        self.projection == Projection::Orthographic
    }

    /// Half of the height that a picture in perspective shows at distance 1.
    pub fn half_height(&self) -> f32 {
        (self.field_of_view.to_radians() / 2.0).tan()
    }

    /// From the lower edge of the picture to the upper one, at the distance of what the camera looks at, in radii of the
    /// focus.
    pub fn seen_height(&self) -> f32 {
        let in_perspective = 2.0 * self.camera.distance * self.half_height();
        match self.projection {
            Projection::Perspective => in_perspective,
            Projection::Orthographic => self.ortho_height.unwrap_or(in_perspective),
        }
    }

    /// Lets an orthographic picture show so many scene units from its lower edge to the upper one, and the camera circle a
    /// sphere of that height, where it stood about the focus; returns the sphere.
    pub fn show_height(&mut self, focus: Focus, height: f32) -> Focus {
        let radius = height / 2.0;
        self.camera.distance *= focus.radius / radius;
        self.ortho_height = Some(2.0);
        Focus { radius, ..focus }
    }

    /// Takes the other projection; what the camera looks at stays as large as it is.
    pub fn toggle_projection(&mut self) {
        match self.projection {
            Projection::Perspective => self.projection = Projection::Orthographic,
            Projection::Orthographic => {
                if let Some(height) = self.ortho_height.take() {
                    self.camera.distance = height / (2.0 * self.half_height());
                }
                self.projection = Projection::Perspective;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_looked_at_stays_as_large() {
        let before = View::default();
        let mut view = before;
        view.toggle_projection();
        assert!(view.is_orthographic());
        assert_eq!(view.seen_height(), before.seen_height());
        view.toggle_projection();
        assert_eq!(view, before, "there and back");
        view.toggle_projection();
        view.ortho_height = Some(1.5);
        view.toggle_projection();
        assert!((view.seen_height() - 1.5).abs() < 1e-6);
        assert_eq!(view.camera.azimuth, before.camera.azimuth);
    }
}
