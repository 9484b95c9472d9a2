//! What is traced: meshes from files, and generated ones.

use super::subject::Subject;
use crate::generated::{Interior, bumpy_ball, knot, room, soup, split, teapot_in_stadium};
use crate::mesh::Mesh;
use crate::progress::Progress;
use crate::ray_sets::SetKind;
use crate::source::{Source, SourceError};
use glam::UVec2;
use std::fmt;
use std::path::Path;
use std::str::FromStr;

/// Something to measure on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Workload {
    /// The mesh of a file or scene, or a built-in one, seen from outside.
    Source(Source),
    /// [`room`], seen from inside.
    Room,
    /// [`teapot_in_stadium`], seen from beside the teapot.
    Stadium,
    /// [`soup`] of so many triangles.
    Soup(u32),
    /// [`bumpy_ball`] of at most so many triangles.
    Ball(u32),
    /// [`knot`] of at most so many triangles.
    Knot(u32),
    /// Another one, each triangle cut into four.
    Split(Box<Workload>),
}

/// Triangles of generated meshes where nobody asks for a number, and at most: more do not fit a GPU's buffers.
const TRIANGLES: u32 = 100_000;
const MOST: u32 = 40_000_000;

impl Workload {
    /// The mesh of a file, or a built-in one.
    pub fn of_argument(mesh: &Path) -> Self {
        Workload::Source(Source::from_argument(Some(mesh)))
    }

    /// Loads or makes the mesh, and the sets of rays of a picture of `size` with what the oracle says of them.
    ///
    /// # Errors
    /// Where a file cannot be read.
    pub fn subject(&self, kinds: &[SetKind], size: UVec2, progress: Progress<'_>) -> Result<Subject, SourceError> {
        let (mesh, view) = self.mesh(progress)?;
        Ok(Subject::new(self.to_string(), mesh, view, kinds, size))
    }

    /// The mesh, and from where to where it is seen if from inside.
    fn mesh(&self, progress: Progress<'_>) -> Result<(Mesh, Option<[glam::DVec3; 2]>), SourceError> {
        let inside = |Interior { mesh, eye, target }| (mesh, Some([eye, target]));
        Ok(match self {
            Workload::Source(source) => (source.load(progress)?.model.mesh, None),
            Workload::Room => inside(room()),
            Workload::Stadium => inside(teapot_in_stadium()),
            Workload::Soup(triangles) => (soup(*triangles), None),
            Workload::Ball(triangles) => (bumpy_ball(*triangles), None),
            Workload::Knot(triangles) => (knot(*triangles), None),
            Workload::Split(whole) => {
                let (mesh, view) = whole.mesh(progress)?;
                (split(&mesh), view)
            }
        })
    }
}

impl fmt::Display for Workload {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Workload::Source(source) => source.fmt(f),
            Workload::Room => f.write_str("room"),
            Workload::Stadium => f.write_str("teapot in a stadium"),
            Workload::Soup(triangles) => write!(f, "soup={triangles}"),
            Workload::Ball(triangles) => write!(f, "ball={triangles}"),
            Workload::Knot(triangles) => write!(f, "knot={triangles}"),
            Workload::Split(whole) => write!(f, "{whole}, split"),
        }
    }
}

/// Reads the name of a generated mesh.
impl FromStr for Workload {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wanted = || {
            format!(
                "give any of room, stadium, soup, ball and knot, the last three with =N or without, N up to {MOST} triangles, \
                 separated by commas"
            )
        };
        let (name, number) = match text.split_once('=') {
            Some((name, number)) => (name, Some(number)),
            None => (text, None),
        };
        let triangles = match number {
            None => TRIANGLES,
            Some(number) => match number.trim().parse() {
                Ok(count) if (1..=MOST).contains(&count) => count,
                _ => return Err(wanted()),
            },
        };
        match (name.trim(), number) {
            ("room", None) => Ok(Workload::Room),
            ("stadium", None) => Ok(Workload::Stadium),
            ("soup", _) => Ok(Workload::Soup(triangles)),
            ("ball", _) => Ok(Workload::Ball(triangles)),
            ("knot", _) => Ok(Workload::Knot(triangles)),
            _ => Err(wanted()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::silent;
    use glam::uvec2;

    #[test]
    fn names_of_generated_meshes() {
        assert_eq!("room".parse(), Ok(Workload::Room));
        assert_eq!("soup".parse(), Ok(Workload::Soup(TRIANGLES)));
        assert_eq!("ball=14000000".parse(), Ok(Workload::Ball(14_000_000)));
        assert_eq!("knot".parse(), Ok(Workload::Knot(TRIANGLES)));
        for bad in [
            "",
            "bunny",
            "knots=5",
            "room=5",
            "soup=",
            "soup=0",
            "ball=-1",
            "ball=99999999",
        ] {
            assert!(bad.parse::<Workload>().is_err(), "{bad}");
        }
    }

    #[test]
    fn splitting_keeps_what_is_seen() {
        let whole = Workload::Ball(800);
        let [coarse, fine] = [whole.clone(), Workload::Split(Box::new(whole))]
            .map(|workload| workload.subject(&SetKind::ALL, uvec2(32, 24), &silent).unwrap());
        assert_eq!(fine.name, "ball=800, split");
        assert_eq!(fine.mesh.triangles.len(), 4 * coarse.mesh.triangles.len());
        for (coarse, fine) in coarse.sets.iter().zip(&fine.sets) {
            assert!(coarse.truth.hits().abs_diff(fine.truth.hits()) <= 2 + coarse.rays.len() / 100);
        }
    }
}
