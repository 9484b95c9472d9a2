//! What kernels traverse.

use crate::contestant::{Failure, corners};
use crate::contestants::obvhs_triangles;
use bytemuck::cast_slice;
use glam::{UVec4, Vec3, Vec4};
use obvhs::BvhBuildParams;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use oktant::mesh::Mesh;
use oktant::model::Model;
use oktant::progress::silent;
use oktant::scene::Scene;
use oktant::structure::StructureOptions;
use oktant::tree::BuildPreset;
use oktant_shared::octants::MARGIN;
use oktant_shared::octree::Root;
use oktant_shared::parts::TraversalKind;
use std::sync::Arc;
use std::time::Duration;

/// A structure in the arrays of oktant's bindings.
pub struct Arrays {
    /// The box around everything.
    pub root: Root,
    /// The nodes.
    pub nodes: Vec<UVec4>,
    /// Triangles by slot, in rows of a corner each.
    pub triangles: Vec<Vec4>,
    /// Their ids.
    pub ids: Vec<u32>,
}

/// What the traversal of shaders/cwbvh.comp has room for, levels of nodes.
const MOST_LEVELS: usize = 32;

impl Arrays {
    /// One of oktant's structures that has no references.
    ///
    /// # Errors
    /// Where the mesh has nothing to trace.
    pub fn oktant(
        who: &'static str,
        mesh: Mesh,
        traversal: TraversalKind,
        preset: BuildPreset,
    ) -> Result<Self, Failure> {
        let options = StructureOptions {
            preset,
            ..StructureOptions::of(traversal)
        };
        let scene = Scene::of_model(Model::of_mesh(mesh), &options, &silent).map_err(|error| Failure {
            who,
            reason: error.to_string(),
        })?;
        Ok(Arrays {
            root: scene.root,
            triangles: bytemuck::cast_vec(Arc::unwrap_or_clone(scene.triangles)),
            nodes: Arc::unwrap_or_clone(scene.nodes),
            ids: Arc::unwrap_or_clone(scene.ids),
        })
    }

    /// The compressed tree of obvhs, its triangles in the order of the leaves.
    ///
    /// # Errors
    /// Where the tree is too deep.
    pub fn cwbvh(who: &'static str, mesh: &Mesh, parameters: BvhBuildParams) -> Result<Self, Failure> {
        let tree = build_cwbvh_from_tris(&obvhs_triangles(mesh), parameters, &mut Duration::default());
        let levels = levels(&tree);
        if levels > MOST_LEVELS {
            return Err(Failure {
                who,
                reason: format!("{levels} levels are more than {MOST_LEVELS}"),
            });
        }
        let all: Vec<[[f32; 3]; 3]> = corners(mesh).collect();
        let row = |corner: [f32; 3]| Vec3::from(corner).extend(0.0);
        Ok(Arrays {
            root: widened(tree.total_aabb.min.to_array(), tree.total_aabb.max.to_array()),
            nodes: cast_slice(&tree.nodes).chunks_exact(4).map(UVec4::from_slice).collect(),
            triangles: tree
                .primitive_indices
                .iter()
                .flat_map(|&id| all[id as usize].map(row))
                .collect(),
            ids: tree.primitive_indices,
        })
    }

    /// Bytes of nodes and triangles.
    pub fn bytes(&self) -> usize {
        size_of_val(self.nodes.as_slice()) + size_of_val(self.triangles.as_slice()) + size_of_val(self.ids.as_slice())
    }
}

/// A box that rounding makes no ray miss that hits what is in it.
fn widened(low: [f32; 3], high: [f32; 3]) -> Root {
    let (low, high) = (Vec3::from(low), Vec3::from(high));
    let most = low.abs().max(high.abs()).max_element() + 10.0 * (high - low).max_element();
    Root {
        low: low - MARGIN * most,
        high: high + MARGIN * most,
        ..bytemuck::Zeroable::zeroed()
    }
}

/// Levels of nodes of a tree.
fn levels(tree: &CwBvh) -> usize {
    let mut deepest = 0;
    let mut waiting = vec![(0, 1)];
    while let Some((node, level)) = waiting.pop() {
        deepest = deepest.max(level);
        let Some(node) = tree.nodes.get(node) else { continue };
        let children = node.imask.count_ones() as usize;
        waiting.extend((0..children).map(|child| (node.child_base_idx as usize + child, level + 1)));
    }
    deepest
}
