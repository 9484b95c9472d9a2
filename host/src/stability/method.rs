//! A method beside those that are offered.

use super::clock::quickest;
use super::exhibits::cell_grid::{CellGrid, GridForm};
use super::exhibits::quantised;
use super::exhibits::revelles::{Form, Revelles};
use super::subject::Subject;
use oktant_shared::hit::Hit;
use oktant_shared::octants::Octants;
use oktant_shared::parts::TraversalKind;
use oktant_shared::ray::Ray;
use oktant_shared::traversal::Traversal;
use oktant_shared::triangle_test::TriangleTest;
use rayon::prelude::*;
use std::time::Duration;

/// An exhibit, ready to run on subjects.
#[derive(Clone, Copy)]
pub enum Method {
    /// A triangle test, in the leaves of the default traversal.
    Triangle {
        /// What tables call it.
        name: &'static str,
        /// Whether it is the default as a GPU may round it, which must not fail either.
        is_twin: bool,
        /// Closest hits.
        closest: fn(&Subject) -> Option<Vec<Hit>>,
        /// Rays that cross too many triangles.
        doubled: fn(&Subject) -> usize,
    },
    /// A form of the parametric traversal, with its own octree.
    Revelles(&'static str, Form),
    /// A form of the walk through a grid, with its own one.
    Grid(&'static str, GridForm),
    /// See [`quantised::closest_hits`].
    Quantised(&'static str),
}

impl Method {
    /// A triangle test.
    pub const fn triangle<T: TriangleTest + Send + Sync>(name: &'static str) -> Self {
        Method::Triangle {
            name,
            is_twin: false,
            closest: closest::<T>,
            doubled: Subject::doubled::<T>,
        }
    }

    /// The default triangle test as a GPU may round it.
    pub const fn twin<T: TriangleTest + Send + Sync>(name: &'static str) -> Self {
        Method::Triangle {
            name,
            is_twin: true,
            closest: closest::<T>,
            doubled: Subject::doubled::<T>,
        }
    }

    /// Whether it must not fail.
    pub fn is_twin(&self) -> bool {
        matches!(self, Method::Triangle { is_twin: true, .. })
    }

    /// A form of the parametric traversal.
    pub const fn revelles(name: &'static str, form: Form) -> Self {
        Method::Revelles(name, form)
    }

    /// A form of the walk through a grid.
    pub const fn grid(name: &'static str, form: GridForm) -> Self {
        Method::Grid(name, form)
    }

    /// What tables call it.
    pub fn name(&self) -> &'static str {
        match self {
            Method::Triangle { name, .. }
            | Method::Revelles(name, _)
            | Method::Grid(name, _)
            | Method::Quantised(name) => name,
        }
    }

    /// Its closest hits, with ids, and how long they took; none where the subject lacks the structure.
    pub fn closest_hits(&self, subject: &Subject) -> Option<(Vec<Hit>, Duration)> {
        let timed = |hits: &dyn Fn() -> Option<Vec<Hit>>| {
            let (hits, time) = quickest(hits);
            hits.map(|hits| (hits, time))
        };
        match self {
            Method::Triangle { closest, .. } => timed(&|| closest(subject)),
            Method::Revelles(_, form) => {
                let tree = Revelles::new(&subject.mesh, *form);
                timed(&|| Some(subject.rays.par_iter().map(|ray| tree.closest_hit(ray)).collect()))
            }
            Method::Grid(_, form) => {
                let grid = CellGrid::new(&subject.mesh, *form);
                timed(&|| Some(subject.rays.par_iter().map(|ray| grid.closest_hit(ray)).collect()))
            }
            Method::Quantised(_) => timed(&|| {
                let scene = subject.scene(TraversalKind::Octants)?;
                Some(quantised::closest_hits(scene, &subject.rays))
            }),
        }
    }

    /// Rays that cross too many triangles, where it is a triangle test.
    pub fn doubled(&self, subject: &Subject) -> Option<usize> {
        match self {
            Method::Triangle { doubled, .. } => Some(doubled(subject)),
            _ => None,
        }
    }
}

fn closest<T: TriangleTest>(subject: &Subject) -> Option<Vec<Hit>> {
    let scene = subject.scene(TraversalKind::Octants)?;
    let view = scene.view();
    let closest = |ray: &Ray| view.identified(Octants::<T>::closest_hit(&view, ray));
    Some(subject.rays.par_iter().map(closest).collect())
}
