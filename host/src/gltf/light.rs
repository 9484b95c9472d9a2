//! Punctual lights (KHR_lights_punctual).

use super::document::Document;
use super::fault::{Fault, Place};
use super::nodes::Placed;
use super::notices::Notices;
use crate::model::white_light;
use glam::{DVec3, DVec4, Vec3};
use oktant_shared::light::{DIRECTIONAL, Light, POINT};
use std::f64::consts::PI;

/// Nearer than this a light increases no more, scene units.
const RADIUS: f32 = 1e-3;

/// A light as the kernel reads it.
///
/// A matt surface of reflectance `c` sends on `c / pi` of the light that arrives, and the kernel's one sends on `c`: so the
/// light's colour is its intensity (candela, or lux) divided by pi, and pictures are in candela per square metre.
pub(super) fn light(document: &Document, placed: &Placed, shift: DVec3, notices: &mut Notices) -> Result<Light, Fault> {
    let light = document.light(placed.id)?;
    let place = Place::of("KHR_lights_punctual.lights", placed.id);
    let intensity = light.intensity.unwrap_or(1.0);
    let color = DVec3::from_array(light.color.unwrap_or([1.0; 3])) * intensity / PI;
    let color = color.as_vec3();
    if !(color.is_finite() && color.min_element() >= 0.0) {
        return Err(Fault::Value {
            place: place.field("intensity"),
            value: intensity,
            wanted: "an intensity and colours of 0 and up",
        });
    }
    let base = Light { color, ..white_light() };
    Ok(match light.kind.as_str() {
        "directional" => Light {
            kind: DIRECTIONAL,
            // It shines along -z, and the kernel asks for the way towards it.
            position: (placed.transform * DVec4::Z)
                .truncate()
                .try_normalize()
                .map_or(Vec3::Y, |towards| towards.as_vec3()),
            ..base
        },
        kind => {
            match kind {
                "point" => {}
                "spot" => notices.add("the cones of spot lights"),
                _ => notices.add("lights of kinds that are not known, which are points here"),
            }
            let range = match light.range {
                None => 0.0,
                Some(value) if value > 0.0 => {
                    let range = (value as f32).max(f32::MIN_POSITIVE);
                    if range.is_finite() { range } else { 0.0 }
                }
                Some(value) => {
                    return Err(Fault::Value {
                        place: place.field("range"),
                        value,
                        wanted: "a distance above 0",
                    });
                }
            };
            Light {
                kind: POINT,
                position: (placed.transform.w_axis.truncate() - shift).as_vec3(),
                falloff_radius: RADIUS,
                range,
                ..base
            }
        }
    })
}
