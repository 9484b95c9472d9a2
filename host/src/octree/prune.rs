//! Which cells of an octree are worth their splits.

use crate::costs::Costs;
use oktant_shared::octree::{INNER, Node};
use rayon::prelude::*;

/// Part of the rays through a cell that also pass through a given child: the ratio of their surfaces.
pub(super) const CHILD_CHANCE: f32 = 0.25;

/// Price of a reference, in the costs of a ray through the root, that is tried first where there are too many.
const LEAST_PRICE: f32 = 1e-9;
/// By how much it is raised until they fit.
const RAISE: f32 = 16.0;
/// How often the price is brought nearer to the least that does.
const NEARER: usize = 12;

/// The cells of an octree, which know how many triangles are in them.
pub(super) struct Cells {
    /// The cells, the root first, the children of a cell side by side behind it.
    pub nodes: Vec<Node>,
    /// Triangles in each cell, also of those that are split.
    pub counts: Vec<u32>,
    /// Ids of triangles, leaf by leaf, ascending in each.
    pub references: Vec<u32>,
}

/// What is expected of a cell with all below it.
#[derive(Clone, Copy, Default)]
struct Expected {
    /// Cost of a ray that passes through the cell.
    cost: f32,
    /// References in it.
    references: usize,
}

/// The octree of those splits with which the expected cost of a ray is least and there are at most so many references.
///
/// Each reference has a price, the least with which they fit, and a split stays where it pays with the best of what is below
/// it. Cells whose references fit stay as they are.
pub(super) fn pruned(cells: Cells, costs: &Costs, budget: usize) -> Cells {
    if cells.references.len() <= budget {
        return cells;
    }
    let levels = levels(&cells.nodes);
    let at_price = |price: f32| decide(&cells, &levels, costs, price);
    let (mut low, mut high) = (LEAST_PRICE, LEAST_PRICE);
    while at_price(high).1.references > budget {
        (low, high) = (high, high * RAISE);
    }
    for _ in 0..NEARER {
        let middle = (low * high).sqrt();
        if at_price(middle).1.references > budget {
            low = middle;
        } else {
            high = middle;
        }
    }
    relaid(&cells, &at_price(high).0)
}

/// The level of each cell; the root's is 0.
pub(super) fn levels(nodes: &[Node]) -> Vec<u8> {
    let mut levels = vec![0; nodes.len()];
    for (index, node) in nodes.iter().enumerate().filter(|(_, node)| node.is_inner()) {
        let level = levels[index] + 1;
        levels[node.first as usize..][..8].fill(level);
    }
    levels
}

/// Which splits are kept, at a price of each reference in costs of a ray through the root, and what is expected of the root.
fn decide(cells: &Cells, levels: &[u8], costs: &Costs, price: f32) -> (Vec<bool>, Expected) {
    let mut kept = vec![false; cells.nodes.len()];
    let mut expected = vec![Expected::default(); cells.nodes.len()];
    for index in (0..cells.nodes.len()).rev() {
        let node = &cells.nodes[index];
        let count = cells.counts[index];
        let leaf = Expected {
            cost: costs.node + costs.triangle * count as f32,
            references: count as usize,
        };
        expected[index] = leaf;
        if node.is_inner() {
            let children = &expected[node.first as usize..][..8];
            let split = Expected {
                cost: CHILD_CHANCE * children.iter().map(|child| child.cost).sum::<f32>(),
                references: children.iter().map(|child| child.references).sum(),
            };
            // Of the rays through the root, this part passes through the cell.
            let chance = CHILD_CHANCE.powi(i32::from(levels[index]));
            let in_all = |one: &Expected| chance * one.cost + price * one.references as f32;
            if in_all(&split) < in_all(&leaf) {
                kept[index] = true;
                expected[index] = split;
            }
        }
    }
    (kept, expected[0])
}

/// Leaves gathered at a time.
const PIECE: usize = 1024;

/// The tree with the splits that are kept, level by level.
fn relaid(cells: &Cells, kept: &[bool]) -> Cells {
    // Where each new cell was before.
    let mut sources = vec![0_u32];
    let mut nodes = vec![Node { first: 0, count: 0 }];
    let mut index = 0;
    while index < sources.len() {
        let source = sources[index] as usize;
        if kept[source] {
            nodes[index] = Node {
                first: sources.len() as u32,
                count: INNER,
            };
            let first = cells.nodes[source].first;
            sources.extend(first..first + 8);
            nodes.resize(sources.len(), Node { first: 0, count: 0 });
        }
        index += 1;
    }
    let pieces: Vec<(Vec<u32>, Vec<u32>)> = sources
        .par_chunks(PIECE)
        .map(|sources| {
            let mut references = Vec::new();
            let counts = sources.iter().map(|source| {
                let source = *source as usize;
                let before = references.len();
                if !kept[source] {
                    gather(cells, source, &mut references);
                }
                (references.len() - before) as u32
            });
            (counts.collect(), references)
        })
        .collect();
    let mut references = Vec::with_capacity(pieces.iter().map(|(_, list)| list.len()).sum());
    let mut first = 0;
    for ((counts, list), nodes) in pieces.iter().zip(nodes.chunks_mut(PIECE)) {
        for (node, count) in nodes.iter_mut().zip(counts).filter(|(node, _)| !node.is_inner()) {
            *node = Node { first, count: *count };
            first += count;
        }
        references.extend_from_slice(list);
    }
    Cells {
        counts: sources.iter().map(|source| cells.counts[*source as usize]).collect(),
        nodes,
        references,
    }
}

/// Appends the triangles of a cell, ascending, each once.
fn gather(cells: &Cells, index: usize, references: &mut Vec<u32>) {
    let begin = references.len();
    let mut open = vec![index];
    let mut leaves = 0;
    while let Some(index) = open.pop() {
        let node = &cells.nodes[index];
        if node.is_inner() {
            open.extend((node.first as usize..).take(8));
        } else if node.count > 0 {
            leaves += 1;
            references.extend_from_slice(&cells.references[node.first as usize..][..node.count as usize]);
        }
    }
    if leaves > 1 {
        let list = &mut references[begin..];
        list.sort_unstable();
        let mut end = begin + usize::from(!list.is_empty());
        for i in begin + 1..references.len() {
            if references[i] != references[i - 1] {
                references[end] = references[i];
                end += 1;
            }
        }
        references.truncate(end);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COSTS: Costs = Costs {
        node: 2.0,
        triangle: 1.0,
    };

    /// A root with ten triangles, five of them in each child, each of those in another grandchild: the first split does not
    /// pay by itself, 14 instead of 12, but with those below it, 10.5.
    fn two_levels() -> Cells {
        let mut cells = Cells {
            nodes: vec![Node { first: 1, count: INNER }],
            counts: vec![10],
            references: Vec::new(),
        };
        for child in 0..8 {
            cells.nodes.push(Node {
                first: 9 + 8 * child,
                count: INNER,
            });
            cells.counts.push(5);
        }
        for child in 0..8 {
            for grandchild in 0..8 {
                let count = u32::from(grandchild < 5);
                cells.nodes.push(Node {
                    first: cells.references.len() as u32,
                    count,
                });
                cells.counts.push(count);
                if count > 0 {
                    cells.references.push((child + grandchild) % 10);
                }
            }
        }
        cells
    }

    #[test]
    fn a_split_stays_for_what_is_below_it() {
        let cells = two_levels();
        let (kept, root) = decide(&cells, &levels(&cells.nodes), &COSTS, 0.0);
        assert_eq!((root.cost, root.references), (10.5, 40));
        assert_eq!(kept.iter().filter(|kept| **kept).count(), 9);
        let same = pruned(two_levels(), &COSTS, 40);
        assert_eq!((same.nodes, same.references), (cells.nodes, cells.references));
    }

    /// The first child's splits gain more and need no reference more than the second's.
    #[test]
    fn references_go_where_they_gain_most() {
        let mut cells = Cells {
            nodes: vec![Node { first: 1, count: INNER }],
            counts: vec![32],
            references: Vec::new(),
        };
        for child in 0..8 {
            let (first, count) = if child < 2 { (9 + 8 * child, INNER) } else { (0, 0) };
            cells.nodes.push(Node { first, count });
            cells.counts.push(if child < 2 { 16 } else { 0 });
        }
        for (first, each) in [(0, 2), (16, 6)] {
            for grandchild in 0..8 {
                cells.nodes.push(Node {
                    first: cells.references.len() as u32,
                    count: each,
                });
                cells.counts.push(each);
                let mut inside: Vec<u32> = (0..each).map(|i| first + (each * grandchild + i) % 16).collect();
                inside.sort_unstable();
                cells.references.extend(inside);
            }
        }
        let pruned = pruned(cells, &COSTS, 40);
        let is_inner: Vec<bool> = pruned.nodes[..3].iter().map(Node::is_inner).collect();
        assert_eq!(is_inner, [true, true, false]);
        let second = &pruned.nodes[2];
        let inside = &pruned.references[second.first as usize..][..second.count as usize];
        assert_eq!(inside, (16..32).collect::<Vec<u32>>());
        assert_eq!(pruned.references.len(), 32);
    }

    #[test]
    fn a_cell_that_is_put_together_has_each_triangle_once() {
        for budget in [39, 10] {
            let alone = pruned(two_levels(), &COSTS, budget);
            assert_eq!(alone.nodes, [Node { first: 0, count: 10 }], "all splits are alike");
            assert_eq!(alone.references, (0..10).collect::<Vec<u32>>());
        }
        let dear = Costs {
            node: 100.0,
            triangle: 1.0,
        };
        assert_eq!(pruned(two_levels(), &dear, 39).nodes.len(), 1);
    }
}
