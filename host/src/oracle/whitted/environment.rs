//! What rays see that leave the scene.

use super::texture;
use crate::model::Model;
use glam::{DVec2, DVec3};
use oktant_shared::texture::NO_TEXTURE;
use std::f64::consts::{PI, TAU};

/// The light from a unit direction, linear RGB.
pub(super) fn radiance(model: &Model, direction: DVec3) -> DVec3 {
    let environment = &model.environment;
    let up = environment.up.as_dvec3();
    let sine = direction.dot(up).clamp(-1.0, 1.0);
    if environment.texture == NO_TEXTURE {
        let pole = if sine > 0.0 {
            environment.zenith
        } else {
            environment.nadir
        };
        return environment.horizon.as_dvec3().lerp(pole.as_dvec3(), sine.abs());
    }
    // Seen from the middle by who looks at the front, +X is at the left.
    let front = if environment.up.z > 0.5 {
        -direction.y
    } else {
        direction.z
    };
    let turn = (-direction.x).atan2(front) / TAU + f64::from(environment.rotation);
    // The upper and the lower edge are not each other's neighbours.
    let margin = 0.5 / f64::from(model.textures[environment.texture as usize].height);
    let height = (0.5 + sine.asin() / PI).clamp(margin, 1.0 - margin);
    texture::color(model, environment.texture, DVec2::new(0.5 + turn, height)) * f64::from(environment.strength)
}
