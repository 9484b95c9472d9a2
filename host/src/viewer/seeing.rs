//! What the person wants to see of the work behind the picture.

use crate::insight::Aspect;
use crate::view::View;
use oktant_shared::parts::TraversalKind;

/// What is shown of the work behind the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Seeing {
    /// What pixels tell, in the place of the picture, if anything.
    pub aspect: Option<Aspect>,
    /// Which cells of the structure are drawn over it.
    pub cells: CellKind,
    /// Their level, if one is drawn; the root's is 0.
    pub level: u32,
    /// The ray that is pinned, if one is.
    pub pin: Option<Pin>,
    traversal: TraversalKind,
}

/// Which cells are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CellKind {
    /// None.
    None,
    /// All leaves.
    Leaves,
    /// Those of a level.
    Level,
    /// Those that the ray under the pointer visits.
    Pointer,
}

/// The ray of a pixel, wherever the camera goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pin {
    /// The pixel, from the upper left corner.
    pub pixel: [u32; 2],
    /// The view when it was pinned.
    pub view: View,
    /// Width and height of the window's inside then.
    pub size: [u32; 2],
}

/// What can be asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum See {
    /// The next of what pixels tell; the picture follows the last.
    Next,
    /// The one before.
    Previous,
    /// This, or the picture.
    Aspect(Option<Aspect>),
    /// Other cells, or none.
    NextCells,
    /// Cells so many levels deeper; negative ones are higher.
    Deeper(i32),
    /// Pin the ray of that pixel of the window.
    Pin([f64; 2]),
    /// Pin none.
    Unpin,
}

/// Deepest level that can be asked for: that of [`oktant_shared::bvh2`].
const DEEPEST: u32 = oktant_shared::bvh2::MAX_LEVEL;

impl Seeing {
    /// The picture alone, with rays traced in that way.
    pub fn new(traversal: TraversalKind) -> Self {
        Seeing {
            aspect: None,
            cells: CellKind::None,
            level: 0,
            pin: None,
            traversal,
        }
    }

    /// Rays are traced in another way: what means nothing with that is no longer shown.
    pub fn trace(&mut self, traversal: TraversalKind) {
        self.traversal = traversal;
        self.aspect = self.aspect.filter(|aspect| self.is_told(*aspect));
    }

    /// Takes a wish, of somebody who sees that view in a window of that size.
    pub fn apply(&mut self, wish: See, view: &View, size: [u32; 2]) {
        match wish {
            See::Next => self.step(1),
            See::Previous => self.step(-1),
            See::Aspect(aspect) => self.aspect = aspect.filter(|aspect| self.is_told(*aspect)),
            See::NextCells => {
                self.cells = match self.cells {
                    CellKind::None => CellKind::Leaves,
                    CellKind::Leaves => CellKind::Level,
                    CellKind::Level => CellKind::Pointer,
                    CellKind::Pointer => CellKind::None,
                }
            }
            See::Deeper(levels) => self.level = self.level.saturating_add_signed(levels).min(DEEPEST),
            See::Pin(at) => {
                let pixel = [0, 1].map(|axis| (at[axis].max(0.0) as u32).min(size[axis].saturating_sub(1)));
                self.pin = Some(Pin {
                    pixel,
                    view: *view,
                    size,
                });
            }
            See::Unpin => self.pin = None,
        }
    }

    /// Whether it means something with the traversal.
    pub fn is_told(&self, aspect: Aspect) -> bool {
        aspect.check(self.traversal).is_ok()
    }

    /// So many further in the list of the picture and all that is told.
    fn step(&mut self, by: isize) {
        let told = Aspect::ALL.into_iter().filter(|aspect| self.is_told(*aspect));
        let all: Vec<Option<Aspect>> = std::iter::once(None).chain(told.map(Some)).collect();
        let place = all.iter().position(|aspect| *aspect == self.aspect).unwrap_or(0);
        self.aspect = all[(place as isize + by).rem_euclid(all.len() as isize) as usize];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn apply(seeing: &mut Seeing, wish: See) {
        seeing.apply(wish, &View::default(), [80, 60]);
    }

    #[test]
    fn keys_go_round_what_is_told() {
        for (traversal, count) in [(TraversalKind::Octants, 12), (TraversalKind::Brute, 8)] {
            let mut seeing = Seeing::new(traversal);
            let mut seen = Vec::new();
            loop {
                apply(&mut seeing, See::Next);
                let Some(aspect) = seeing.aspect else { break };
                seen.push(aspect);
            }
            assert_eq!(seen.len(), count, "{traversal}");
            // Whoever wonders why something is slow presses the key once. Without a structure there are no steps.
            let first = if traversal == TraversalKind::Brute {
                Aspect::Tests
            } else {
                Aspect::Steps
            };
            assert_eq!(seen[0], first, "{traversal}");
            for aspect in seen.into_iter().rev() {
                apply(&mut seeing, See::Previous);
                assert_eq!(seeing.aspect, Some(aspect));
            }
            apply(&mut seeing, See::Aspect(Some(Aspect::LeafDepth)));
            assert_eq!(seeing.aspect.is_some(), traversal == TraversalKind::Octants);
        }
    }

    #[test]
    fn what_means_nothing_with_another_traversal_is_not_shown() {
        let mut seeing = Seeing::new(TraversalKind::Octants);
        apply(&mut seeing, See::Aspect(Some(Aspect::LeafDepth)));
        seeing.trace(TraversalKind::Octree);
        assert_eq!(seeing.aspect, Some(Aspect::LeafDepth));
        seeing.trace(TraversalKind::Brute);
        assert_eq!(seeing.aspect, None);
        apply(&mut seeing, See::Aspect(Some(Aspect::LeafDepth)));
        assert_eq!(seeing.aspect, None, "nor does anybody get it");
        seeing.trace(TraversalKind::Octants);
        apply(&mut seeing, See::Aspect(Some(Aspect::LeafDepth)));
        assert_eq!(seeing.aspect, Some(Aspect::LeafDepth));
    }

    #[test]
    fn cells_and_levels() {
        let mut seeing = Seeing::new(TraversalKind::Octree);
        let mut kinds = Vec::new();
        for _ in 0..4 {
            apply(&mut seeing, See::NextCells);
            kinds.push(seeing.cells);
        }
        assert_eq!(
            kinds,
            [CellKind::Leaves, CellKind::Level, CellKind::Pointer, CellKind::None]
        );
        apply(&mut seeing, See::Deeper(-1));
        assert_eq!(seeing.level, 0);
        apply(&mut seeing, See::Deeper(1000));
        assert_eq!(seeing.level, DEEPEST);
    }

    #[test]
    fn pins_are_within_the_window() {
        let mut seeing = Seeing::new(TraversalKind::Octree);
        for (at, pixel) in [([12.7, 3.2], [12, 3]), ([-5.0, 99.0], [0, 59])] {
            apply(&mut seeing, See::Pin(at));
            assert_eq!(seeing.pin.unwrap().pixel, pixel);
        }
        apply(&mut seeing, See::Unpin);
        assert_eq!(seeing.pin, None);
    }
}
