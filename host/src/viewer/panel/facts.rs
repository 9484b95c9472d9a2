//! What the panel shows.

use crate::names::Names;
use crate::scene::{Memory, Scene};
use crate::structure;
use crate::viewer::caption::Caption;
use crate::viewer::figures::Figures;
use crate::viewer::recent::Recent;
use crate::viewer::session::Session;

/// All that the panel shows.
pub struct Facts<'a> {
    /// What is set.
    pub session: &'a Session,
    /// What the scene consists of, once that is counted.
    pub inventory: Option<&'a Inventory>,
    /// What its file calls its parts.
    pub names: &'a Names,
    /// What was opened before.
    pub recent: &'a Recent,
    /// Whether the GPU is to render.
    pub wants_gpu: bool,
    /// What was measured.
    pub figures: &'a Figures,
    /// What the overlay says of it.
    pub caption: Caption,
}

/// What a scene consists of.
#[derive(Clone, Debug)]
pub struct Inventory {
    /// Bytes of its arrays.
    pub memory: Memory,
    /// What its structure consists of.
    pub structure: structure::Figures,
}

impl Inventory {
    /// Of a scene.
    pub fn of(scene: &Scene) -> Self {
        Inventory {
            memory: Memory::of(scene),
            structure: structure::Figures::new(scene.parts.traversal, &scene.nodes),
        }
    }
}
