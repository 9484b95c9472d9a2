//! What surfaces are made of.

use super::Facts;
use super::fields::{Fields, shortened};
use crate::viewer::adjustment::{Adjustment, MaterialAdjustment, SWITCHES};
use egui::ComboBox;
use oktant_shared::material::Material;
use oktant_shared::texture::NO_TEXTURE;

/// Which material is looked at, and rows for all of it.
pub fn show(fields: &mut Fields<'_>, facts: &Facts<'_>, chosen: &mut usize) {
    let materials = &facts.session.staging.materials;
    *chosen = (*chosen).min(materials.len().saturating_sub(1));
    let Some(material) = materials.get(*chosen) else { return };
    let label = |index: usize| match facts.names.material(index) {
        Some(name) => format!("{index}: {}", shortened(name)),
        None => format!("{index}"),
    };
    ComboBox::from_label("material")
        .selected_text(label(*chosen))
        .show_ui(fields.ui(), |ui| {
            for index in 0..materials.len() {
                ui.selectable_value(chosen, index, label(index));
            }
        });
    let index = *chosen;
    fields.table("material", |fields| {
        reflection(fields, index, material);
        beyond(fields, index, material);
        switches(fields, index, material);
    });
}

fn of(index: usize) -> impl Fn(MaterialAdjustment) -> Adjustment + Copy {
    move |adjustment| Adjustment::Material(index, adjustment)
}

fn reflection(fields: &mut Fields<'_>, index: usize, material: &Material) {
    let of = of(index);
    fields.color("base", material.base, |color| of(MaterialAdjustment::Base(color)));
    fields.slider("ambient", material.ambient, 0.0..=1.0, |part| {
        of(MaterialAdjustment::Ambient(part))
    });
    fields.slider("diffuse", material.diffuse, 0.0..=1.0, |part| {
        of(MaterialAdjustment::Diffuse(part))
    });
    fields.color("specular", material.specular, |color| {
        of(MaterialAdjustment::Specular(color))
    });
    fields.number("exponent", material.exponent, 0.0..=1e6, |exponent| {
        // Between 0, for none, and 1, the widest, there is nothing.
        of(MaterialAdjustment::Exponent(if exponent > 0.0 {
            exponent.max(1.0)
        } else {
            0.0
        }))
    });
}

fn beyond(fields: &mut Fields<'_>, index: usize, material: &Material) {
    let of = of(index);
    fields.part("mirror", material.mirror, |part| of(MaterialAdjustment::Mirror(part)));
    fields.part("transmission", material.transmission, |part| {
        of(MaterialAdjustment::Transmission(part))
    });
    if material.is_transmissive() {
        fields.number("ior", material.ior, 0.1..=10.0, |ior| of(MaterialAdjustment::Ior(ior)));
        fields.color("absorption", material.absorption, |color| {
            of(MaterialAdjustment::Absorption(color))
        });
        fields.counter("priority", material.priority, 0..=100, |priority| {
            of(MaterialAdjustment::Priority(priority))
        });
    }
    if material.bump != NO_TEXTURE {
        fields.number("bump_height", material.bump_height, -1e6..=1e6, |height| {
            of(MaterialAdjustment::BumpHeight(height))
        });
    }
}

fn switches(fields: &mut Fields<'_>, index: usize, material: &Material) {
    let of = of(index);
    for (name, bit, states) in SWITCHES {
        fields.choice(
            name,
            material.flags & bit != 0,
            &[false, true],
            |is_on| states[usize::from(is_on)].into(),
            |is_on| of(MaterialAdjustment::Flag(bit, is_on)),
        );
    }
}
