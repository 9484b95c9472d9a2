//! From the mesh's ids back to the slots of a structure.

use crate::scene::Scene;
use oktant_shared::hit::Hit;
use oktant_shared::plane::PLANE;
use oktant_shared::triangle::Triangle;

/// The slots of a scene's triangles by id: what back ends report are ids, what shading takes are slots.
pub struct Slots(Vec<u32>);

impl Slots {
    /// Those of a scene.
    pub fn of(scene: &Scene) -> Self {
        let count = scene.ids.iter().max().map_or(0, |id| *id as usize + 1);
        let mut slots = vec![0; count];
        for (slot, id) in scene.ids.iter().enumerate() {
            slots[*id as usize] = slot as u32;
        }
        Slots(slots)
    }

    /// A reported hit with the slot in place of the id; misses and planes stay.
    pub fn placed(&self, hit: &Hit) -> Hit {
        if hit.triangle & PLANE != 0 {
            *hit
        } else {
            Hit {
                triangle: self.0[hit.triangle as usize],
                ..*hit
            }
        }
    }

    /// The triangle of an id that was reported.
    pub fn triangle(&self, scene: &Scene, id: u32) -> Triangle {
        scene.view().triangle(self.0[id as usize])
    }
}
