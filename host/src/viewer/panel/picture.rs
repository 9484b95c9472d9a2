//! How the picture is taken and shown.

use super::Facts;
use super::fields::Fields;
use crate::projection::Projection;
use crate::sampling::{Filter, Pattern, SampleCount};
use crate::tone::Curve;
use crate::view::Shading;
use crate::viewer::adjustment::{Adjustment, BLOCKS, PictureAdjustment, STEREO, stereo_name};
use crate::viewer::caption::name;
use crate::viewer::session::DISTANCES;
use clap::ValueEnum;
use oktant_shared::whitted::MAX_DEPTH;

/// What most want, stops; more can be typed.
const EXPOSURES: [f32; 2] = [-8.0, 8.0];

/// Rows for all of it.
pub fn show(fields: &mut Fields<'_>, facts: &Facts<'_>) {
    fields.table("picture", |fields| {
        sampling(fields, facts);
        following(fields, facts);
        camera(fields, facts);
        eyes(fields, facts);
        tone(fields, facts);
    });
}

fn of(adjustment: PictureAdjustment) -> Adjustment {
    Adjustment::Picture(adjustment)
}

fn sampling(fields: &mut Fields<'_>, facts: &Facts<'_>) {
    let view = &facts.session.view;
    let count = SampleCount {
        samples: view.samples,
        adaptive: view.adaptive,
    };
    fields.choice(
        "samples",
        count,
        &SampleCount::ALL,
        |count| count.name().into(),
        |count| of(PictureAdjustment::Samples(count)),
    );
    if view.adaptive {
        fields.number("error", view.tolerance, 1e-4..=1.0, |part| {
            of(PictureAdjustment::Error(part))
        });
        fields.choice(
            "block",
            view.block,
            &BLOCKS,
            |edge| edge.to_string(),
            |edge| of(PictureAdjustment::Block(edge)),
        );
    }
    fields.choice(
        "pattern",
        view.pattern,
        Pattern::value_variants(),
        |pattern| name(&pattern),
        |pattern| of(PictureAdjustment::Pattern(pattern)),
    );
    fields.choice(
        "filter",
        view.filter,
        Filter::value_variants(),
        |filter| name(&filter),
        |filter| of(PictureAdjustment::Filter(filter)),
    );
}

fn following(fields: &mut Fields<'_>, facts: &Facts<'_>) {
    let view = &facts.session.view;
    fields.choice(
        "shading",
        view.shading,
        Shading::value_variants(),
        |shading| name(&shading),
        |shading| of(PictureAdjustment::Shading(shading)),
    );
    fields.counter("depth", view.depth, 0..=MAX_DEPTH, |depth| {
        of(PictureAdjustment::Depth(depth))
    });
    fields.number("cutoff", view.cutoff, 0.0..=255.0, |steps| {
        of(PictureAdjustment::Cutoff(steps))
    });
}

fn camera(fields: &mut Fields<'_>, facts: &Facts<'_>) {
    let view = &facts.session.view;
    let [nearest, farthest] = DISTANCES;
    let place = view.camera;
    fields.slider("azimuth", place.azimuth, -180.0..=180.0, |degrees| {
        of(PictureAdjustment::Azimuth(degrees))
    });
    fields.slider("elevation", place.elevation, -90.0..=90.0, |degrees| {
        of(PictureAdjustment::Elevation(degrees))
    });
    fields.number("distance", place.distance, nearest..=farthest, |radii| {
        of(PictureAdjustment::Distance(radii))
    });
    fields.choice(
        "projection",
        view.projection,
        &Projection::ALL,
        |projection| name(&projection),
        |projection| of(PictureAdjustment::Projection(projection)),
    );
    if view.is_orthographic() {
        fields.number("ortho-height", view.seen_height(), nearest..=farthest, |radii| {
            of(PictureAdjustment::OrthoHeight(radii))
        });
    } else {
        fields.slider("fov", view.field_of_view, 1.0..=170.0, |degrees| {
            of(PictureAdjustment::FieldOfView(degrees))
        });
    }
}

fn eyes(fields: &mut Fields<'_>, facts: &Facts<'_>) {
    let stereo = facts.session.view.stereo;
    fields.choice(
        "stereo",
        stereo.map(|stereo| stereo.mode),
        &STEREO,
        stereo_name,
        |mode| of(PictureAdjustment::Stereo(mode)),
    );
    if let Some(stereo) = stereo {
        let lengths = 1e-9..=1e9;
        fields.number("eye-distance", facts.session.eye_distance(), lengths.clone(), |units| {
            of(PictureAdjustment::EyeDistance(units))
        });
        let convergence = stereo.convergence.unwrap_or(facts.session.target_distance());
        fields.number("convergence", convergence, lengths, |units| {
            of(PictureAdjustment::Convergence(units))
        });
    }
}

fn tone(fields: &mut Fields<'_>, facts: &Facts<'_>) {
    let tone = facts.session.view.tone;
    fields.choice(
        "tone",
        tone.curve,
        &Curve::ALL,
        |curve| name(&curve),
        |curve| of(PictureAdjustment::Tone(curve)),
    );
    let [least, greatest] = EXPOSURES;
    fields.slider("exposure", tone.exposure, least..=greatest, |stops| {
        of(PictureAdjustment::Exposure(stops))
    });
}
