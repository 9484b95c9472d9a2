//! What shines.

use super::Facts;
use super::fields::Fields;
use crate::viewer::adjustment::{Adjustment, LightAdjustment, hue};
use crate::viewer::input::Input;
use crate::viewer::session::{DISTANCES, Session};
use oktant_shared::light::{AREA, DIRECTIONAL, Light};

/// A list of the lights, each with rows for all of it, and what adds one.
pub fn show(fields: &mut Fields<'_>, facts: &Facts<'_>) {
    let session = facts.session;
    for (index, light) in session.staging.lights.iter().enumerate() {
        let kind = match light.kind {
            DIRECTIONAL => "directional",
            AREA => "area",
            _ => "point",
        };
        fields.item(index, &format!("light {index}: {kind}"), |fields| {
            fields.table("light", |fields| {
                strength(fields, index, light);
                place(fields, index, light, session);
                reach(fields, index, light);
            });
            if fields.button("remove") {
                fields.ask(Input::RemoveLight(index));
            }
        });
    }
    if fields.button("add a light") {
        fields.ask(Input::AddLight);
    }
}

fn of(index: usize) -> impl Fn(LightAdjustment) -> Adjustment + Copy {
    move |adjustment| Adjustment::Light(index, adjustment)
}

fn strength(fields: &mut Fields<'_>, index: usize, light: &Light) {
    let of = of(index);
    fields.color("color", hue(light), |color| of(LightAdjustment::Color(color)));
    fields.number("intensity", light.color.max_element(), 0.0..=1e9, |intensity| {
        of(LightAdjustment::Intensity(intensity))
    });
}

fn place(fields: &mut Fields<'_>, index: usize, light: &Light, session: &Session) {
    let Some(place) = session.light_place(index) else {
        return;
    };
    let of = of(index);
    let [nearest, farthest] = DISTANCES;
    fields.slider("azimuth", place.azimuth, -180.0..=180.0, |degrees| {
        of(LightAdjustment::Azimuth(degrees))
    });
    fields.slider("elevation", place.elevation, -90.0..=90.0, |degrees| {
        of(LightAdjustment::Elevation(degrees))
    });
    if light.kind != DIRECTIONAL {
        fields.number("distance", place.distance, nearest..=farthest, |radii| {
            of(LightAdjustment::Distance(radii))
        });
        fields.position("position", session.position(&place), |position| {
            of(LightAdjustment::Position(position))
        });
    }
}

fn reach(fields: &mut Fields<'_>, index: usize, light: &Light) {
    if light.kind == DIRECTIONAL {
        return;
    }
    let of = of(index);
    fields.number("range", light.range, 0.0..=1e9, |range| {
        of(LightAdjustment::Range(range))
    });
    fields.choice(
        "falloff",
        light.falloff_radius > 0.0,
        &[false, true],
        |falls| LightAdjustment::FALLOFFS[usize::from(falls)].into(),
        |falls| of(LightAdjustment::FallsOff(falls)),
    );
    if light.falloff_radius > 0.0 {
        fields.number("radius", light.falloff_radius, 1e-9..=1e9, |radius| {
            of(LightAdjustment::Radius(radius))
        });
    }
}
