//! What a file has and a picture lacks.

use super::document::Document;
use super::fault::Fault;
use std::collections::BTreeSet;

/// Extensions that are read, or that change no picture made here.
const KNOWN: [&str; 9] = [
    "KHR_lights_punctual",
    "KHR_materials_ior",
    "KHR_materials_transmission",
    "KHR_materials_volume",
    "KHR_materials_specular",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "KHR_xmp_json_ld",
    "KHR_animation_pointer",
];

/// Extensions that a picture lacks, but not so that it means nothing.
const DISPENSABLE: [&str; 10] = [
    "KHR_materials_unlit",
    "KHR_materials_emissive_strength",
    "KHR_materials_clearcoat",
    "KHR_materials_sheen",
    "KHR_materials_iridescence",
    "KHR_materials_anisotropy",
    "KHR_materials_dispersion",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_variants",
    "EXT_lights_image_based",
];

/// Names of what is left out.
#[derive(Default)]
pub(super) struct Notices(BTreeSet<String>);

impl Notices {
    /// Takes note of something.
    pub(super) fn add(&mut self, what: &str) {
        if !self.0.contains(what) {
            self.0.insert(what.to_owned());
        }
    }

    /// Takes note of skins, and of the extensions that are not known.
    ///
    /// # Errors
    /// One without which the file cannot be understood.
    pub(super) fn whole(&mut self, document: &Document) -> Result<(), Fault> {
        let short = |name: &String| name.escape_debug().take(60).collect::<String>();
        for name in &document.extensions_required {
            if !KNOWN.contains(&name.as_str()) && !DISPENSABLE.contains(&name.as_str()) {
                return Err(Fault::Extension(short(name)));
            }
        }
        for name in &document.extensions_used {
            if !KNOWN.contains(&name.as_str()) {
                self.add(&short(name));
            }
        }
        if document.nodes.iter().any(|node| node.skin.is_some()) {
            self.add("skins");
        }
        Ok(())
    }

    /// Tells a person, who calls the file so.
    pub(super) fn tell(self, name: &str) {
        if !self.0.is_empty() {
            let all: Vec<String> = self.0.into_iter().collect();
            tracing::warn!("{name}: left out are {}; docs/files.md says why", all.join(", "));
        }
    }
}
