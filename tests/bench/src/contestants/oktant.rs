//! oktant's default parts, built in three ways.

use crate::contestant::{Contestant, Entry, Failure};
use oktant::mesh::Mesh;
use oktant::model::Model;
use oktant::progress::silent;
use oktant::scene::{Memory, Scene};
use oktant::structure::StructureOptions;
use oktant::tree::BuildPreset;
use oktant_shared::hit::Hit;
use oktant_shared::ray::Ray;
use oktant_shared::traversal::{Standard, Traversal};

struct Oktant(Scene);

impl Contestant for Oktant {
    fn closest(&self, rays: &[Ray], hits: &mut [Hit]) {
        let scene = self.0.view();
        Standard::closest_hits(&scene, rays, hits);
        for hit in hits {
            *hit = scene.identified(*hit);
        }
    }

    fn any(&self, rays: &[Ray], found: &mut [bool]) {
        Standard::any_hits(&self.0.view(), rays, found);
    }

    fn bytes(&self) -> Option<usize> {
        Some(Memory::of(&self.0).traced())
    }
}

fn build(who: &'static str, mesh: Mesh, preset: BuildPreset) -> Result<Box<dyn Contestant>, Failure> {
    let options = StructureOptions {
        preset,
        ..StructureOptions::default()
    };
    let scene = Scene::of_model(Model::of_mesh(mesh), &options, &silent).map_err(|error| Failure {
        who,
        reason: error.to_string(),
    })?;
    Ok(Box::new(Oktant(scene)))
}

macro_rules! entry {
    ($name:literal, $preset:ident) => {
        Entry {
            name: $name,
            is_ours: true,
            build: |mesh, _| build($name, mesh, BuildPreset::$preset),
        }
    };
}

/// The default first.
pub fn entries() -> Vec<Entry> {
    vec![
        entry!("oktant balanced", Balanced),
        entry!("oktant fast", Fast),
        entry!("oktant quality", Quality),
    ]
}
