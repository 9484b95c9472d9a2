//! What rays are traced through: the arrays of the structure that a traversal reads.

mod bvh2;
mod figures;
mod octants;
mod validate;

pub use figures::Figures;
pub use validate::InvalidStructure;

use crate::build_error::BuildError;
use crate::costs::Costs;
use crate::grid::{Grid, GridOptions};
use crate::hittable::Hittable;
use crate::mesh::Mesh;
use crate::octree::{Octree, OctreeOptions, root};
use crate::profile::Profile;
use crate::progress::Progress;
use crate::tree::{BinaryTree, BuildPreset, CellTree, CollapseOptions, MortonOrder, WideNode, zeroed};
use glam::{UVec3, UVec4, Vec3, Vec4, uvec4};
use oktant_shared::grid::Raster;
use oktant_shared::octahedral;
use oktant_shared::octree::{Node, Root};
use oktant_shared::parts::{Parts, TraversalKind};
use oktant_shared::triangle::Triangle;
use rayon::prelude::*;

/// Which structure to build, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StructureOptions {
    /// What rays are traced with; the structure is the one that the traversal reads.
    pub parts: Parts,
    /// What the build spends its time on, if it is a tree of boxes.
    pub preset: BuildPreset,
    /// What a ray's work costs, if it is the tree of boxes in the slots of octants.
    pub boxes: Costs,
    /// What decides its splits, if it is the octree.
    pub octree: OctreeOptions,
    /// Limits, if it is the grid.
    pub grid: GridOptions,
}

impl Default for StructureOptions {
    fn default() -> Self {
        StructureOptions {
            parts: Parts::default(),
            preset: BuildPreset::default(),
            boxes: Costs::OCTANTS,
            octree: OctreeOptions::default(),
            grid: GridOptions::default(),
        }
    }
}

impl StructureOptions {
    /// The structure that a traversal reads, else the defaults.
    pub fn of(traversal: TraversalKind) -> Self {
        StructureOptions {
            parts: Parts {
                traversal,
                ..Parts::default()
            },
            ..StructureOptions::default()
        }
    }

    /// Counts with what was measured.
    pub fn apply(&mut self, profile: &Profile) {
        self.boxes = profile.octants;
        self.octree.costs = profile.octree;
    }
}

/// A structure over the triangles of a mesh, as flat arrays.
#[derive(Clone, Debug)]
pub struct Structure {
    /// What it was built for.
    pub traversal: TraversalKind,
    /// The cube around everything.
    pub root: Root,
    /// The nodes, as the traversal reads them.
    pub nodes: Vec<UVec4>,
    /// Slots of triangles, leaf by leaf; empty where each triangle is in one leaf. Where triangles are indexed, the corners
    /// of each slot.
    pub references: Vec<u32>,
    /// The triangles by slot; empty where they are indexed. Those that no ray is to hit, for they lie exactly on one with a
    /// lower id, have no area.
    pub triangles: Vec<Triangle>,
    /// The corners of indexed triangles by vertex, scene units, and their normals as words, in rows; else empty.
    pub corners: Vec<Vec4>,
    /// The triangles' ids by slot.
    pub ids: Vec<u32>,
    /// Triangles left out because they have no area.
    pub degenerate: u32,
    /// Triangles left out because they lie exactly on one with a lower id.
    pub duplicates: u32,
    /// [`Mesh::bounds`], where the build came by them.
    pub bounds: Option<(Vec3, Vec3)>,
}

impl Structure {
    /// Builds what the options ask for; the same one for the same mesh, whatever the number of threads.
    ///
    /// # Errors
    /// [`BuildError`] where the mesh has nothing to build it from.
    pub fn build(mesh: &Mesh, options: &StructureOptions, progress: Progress<'_>) -> Result<Self, BuildError> {
        match options.parts.traversal {
            TraversalKind::Octree => {
                let octree = Octree::build(mesh, &options.octree, progress)?;
                let ids: Vec<u32> = (0..mesh.triangles.len() as u32).collect();
                Ok(Structure {
                    traversal: options.parts.traversal,
                    root: octree.root,
                    nodes: in_pairs(&octree.nodes),
                    references: octree.references,
                    triangles: rows(mesh, &ids),
                    corners: Vec::new(),
                    ids,
                    degenerate: octree.degenerate,
                    duplicates: octree.duplicates,
                    bounds: None,
                })
            }
            TraversalKind::Octants | TraversalKind::Compact | TraversalKind::Bvh2 => {
                Self::of_boxes(mesh, options, progress)
            }
            TraversalKind::Grid => {
                let grid = Grid::build(mesh, &options.grid, progress)?;
                let mut nodes = grid.raster.words().to_vec();
                nodes.append(&mut in_pairs(&grid.cells));
                Ok(Structure {
                    traversal: options.parts.traversal,
                    root: grid.root,
                    nodes,
                    references: grid.references,
                    triangles: rows(mesh, &grid.ids),
                    corners: Vec::new(),
                    ids: grid.ids,
                    degenerate: grid.degenerate,
                    duplicates: grid.duplicates,
                    bounds: None,
                })
            }
            TraversalKind::Brute => {
                let hittable = Hittable::of(mesh)?;
                Ok(Structure {
                    traversal: options.parts.traversal,
                    root: root(hittable.low, hittable.high, 0)?,
                    nodes: vec![uvec4(hittable.ids.len() as u32, 0, 0, 0)],
                    references: Vec::new(),
                    triangles: rows(mesh, &hittable.ids),
                    corners: Vec::new(),
                    ids: hittable.ids,
                    degenerate: hittable.degenerate,
                    duplicates: hittable.duplicates,
                    bounds: None,
                })
            }
        }
    }

    /// A tree of tight boxes.
    fn of_boxes(mesh: &Mesh, options: &StructureOptions, progress: Progress<'_>) -> Result<Self, BuildError> {
        let traversal = options.parts.traversal;
        let order = MortonOrder::new(mesh)?;
        let (low, high) = (order.low, order.high);
        let cube = root(low, high, 0)?;
        let margin = octants::margin(&cube);
        let encode = |node: &WideNode| octants::words(node, margin);
        // None yet where they are indexed.
        let rows = |ids: &[u32]| {
            if traversal.is_indexed() {
                Vec::new()
            } else {
                rows(mesh, ids)
            }
        };
        let (nodes, ids, mut triangles) = if traversal == TraversalKind::Bvh2 {
            let tree = BinaryTree::of(&order, mesh, options.preset, progress);
            let triangles = rows(&tree.order);
            (bvh2::words(&tree), tree.order, triangles)
        } else if options.preset == BuildPreset::Fast {
            let cells = CellTree::build(&order, mesh, encode, octants::move_children, progress);
            (bytemuck::allocation::cast_vec(cells.nodes), cells.ids, cells.triangles)
        } else {
            let tree = BinaryTree::of(&order, mesh, options.preset, progress);
            let collapse = CollapseOptions {
                costs: options.boxes,
                ..CollapseOptions::of(options.preset)
            };
            let wide = tree.to_wide(&collapse, encode);
            let triangles = rows(&wide.order);
            (bytemuck::allocation::cast_vec(wide.nodes), wide.order, triangles)
        };
        let duplicates = order.duplicates(mesh);
        if !duplicates.is_empty() {
            // Which of two triangles at the same place is nearer would be a matter of rounding. Without area, it is hit by
            // nothing.
            let pairs = triangles.par_iter_mut().zip(&ids).with_min_len(ROWS);
            pairs.for_each(|(triangle, id)| {
                if duplicates.binary_search(id).is_ok() {
                    (triangle.b, triangle.c) = (triangle.a, triangle.a);
                }
            });
        }
        let (mut references, mut corners) = (Vec::new(), Vec::new());
        if traversal.is_indexed() {
            triangles = Vec::new();
            references = indices(mesh, &ids, &duplicates);
            corners = self::corners(mesh);
        }
        // As much room as the octree's cube has: for rays from so far away that f32 does not tell where they pass.
        let room = Vec3::splat((high - low).max_element() / 64.0);
        Ok(Structure {
            traversal,
            root: Root {
                low: low - room,
                high: high + room,
                ..cube
            },
            nodes,
            references,
            triangles,
            corners,
            ids,
            degenerate: order.degenerate,
            duplicates: duplicates.len() as u32,
            bounds: (order.degenerate == 0).then_some((low, high)),
        })
    }

    /// A structure without triangles.
    pub fn empty(traversal: TraversalKind) -> Self {
        let words = match traversal {
            TraversalKind::Octants | TraversalKind::Compact => oktant_shared::octants::NODE_VECTORS,
            TraversalKind::Octree | TraversalKind::Brute => 1,
            TraversalKind::Bvh2 => oktant_shared::bvh2::NODE_VECTORS,
            TraversalKind::Grid => 3,
        };
        let root = Octree::empty().root;
        let mut nodes = vec![UVec4::ZERO; words as usize];
        if traversal == TraversalKind::Bvh2 {
            nodes[0].w = oktant_shared::bvh2::LEAF;
            nodes[2].w = oktant_shared::bvh2::LEAF;
        }
        if traversal == TraversalKind::Grid {
            let one = Raster {
                cells: UVec3::ONE,
                low: root.low,
                cell: root.size(),
            };
            nodes[..2].copy_from_slice(&one.words());
        }
        Structure {
            traversal,
            root,
            nodes,
            references: Vec::new(),
            triangles: Vec::new(),
            corners: Vec::new(),
            ids: Vec::new(),
            degenerate: 0,
            duplicates: 0,
            bounds: None,
        }
    }
}

/// Triangles that are worth a thread.
const ROWS: usize = 1 << 13;

/// The triangles of some ids.
fn rows(mesh: &Mesh, ids: &[u32]) -> Vec<Triangle> {
    let mut triangles: Vec<Triangle> = zeroed(ids.len());
    let pairs = triangles.par_iter_mut().zip(ids).with_min_len(ROWS);
    pairs.for_each(|(triangle, id)| *triangle = mesh.triangle(*id));
    triangles
}

/// The vertices of the triangles of some ids, three each; of duplicates the first one three times.
fn indices(mesh: &Mesh, ids: &[u32], duplicates: &[u32]) -> Vec<u32> {
    let mut indices: Vec<u32> = zeroed(3 * ids.len());
    let pairs = indices.par_chunks_exact_mut(3).zip(ids).with_min_len(ROWS);
    pairs.for_each(|(indices, id)| {
        let corners = mesh.triangles[*id as usize];
        let is_left_out = !duplicates.is_empty() && duplicates.binary_search(id).is_ok();
        indices.copy_from_slice(&if is_left_out { [corners[0]; 3] } else { corners });
    });
    indices
}

/// The vertices of a mesh in rows: where they are, and their normals as words.
fn corners(mesh: &Mesh) -> Vec<Vec4> {
    let row = |(index, position): (usize, &Vec3)| {
        let normal = mesh.normals.get(index).copied().unwrap_or_default();
        position.extend(f32::from_bits(octahedral::word(normal)))
    };
    mesh.positions.par_iter().enumerate().map(row).collect()
}

/// Nodes two by two in words; an odd one is followed by an empty leaf.
fn in_pairs(nodes: &[Node]) -> Vec<UVec4> {
    nodes
        .chunks(2)
        .map(|pair| {
            let second = pair.get(1).copied().unwrap_or(Node { first: 0, count: 0 });
            uvec4(pair[0].first, pair[0].count, second.first, second.count)
        })
        .collect()
}
