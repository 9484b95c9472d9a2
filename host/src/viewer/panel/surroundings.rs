//! What is around.

use super::Facts;
use super::fields::Fields;
use crate::viewer::adjustment::{Adjustment, SurroundingsAdjustment};
use oktant_shared::texture::NO_TEXTURE;

/// Rows for all of it.
pub fn show(fields: &mut Fields<'_>, facts: &Facts<'_>) {
    let staging = &facts.session.staging;
    let environment = &staging.environment;
    let of = Adjustment::Environment;
    fields.table("environment", |fields| {
        if environment.texture == NO_TEXTURE {
            fields.color("color", environment.horizon, |color| {
                of(SurroundingsAdjustment::Color(color))
            });
            fields.color("zenith", environment.zenith, |color| {
                of(SurroundingsAdjustment::Zenith(color))
            });
            fields.color("horizon", environment.horizon, |color| {
                of(SurroundingsAdjustment::Horizon(color))
            });
            fields.color("nadir", environment.nadir, |color| {
                of(SurroundingsAdjustment::Nadir(color))
            });
        } else {
            fields.text("image", facts.names.environment.as_deref().unwrap_or("there is one"));
            fields.number("strength", environment.strength, 0.0..=1e9, |strength| {
                of(SurroundingsAdjustment::Strength(strength))
            });
            fields.slider("rotation", environment.rotation * 360.0, 0.0..=360.0, |degrees| {
                of(SurroundingsAdjustment::Rotation(degrees))
            });
        }
        fields.color("ambient", staging.ambient, |color| {
            of(SurroundingsAdjustment::Ambient(color))
        });
    });
}
