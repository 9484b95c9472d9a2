//! Meshes as plain binary arrays, little-endian.
//!
//! | begins with | then |
//! |---|---|
//! | `PTRI`, u32 version 1, u32 triangles, u32 0 | per triangle 9 f32: its three corners; vertices are not shared |
//! | `MSH1`, u32 vertices, u32 triangles | 3 f32 per vertex, then 3 u32 per triangle: its corners |
//!
//! Memory is taken as a file proves to have what its header claims.

use crate::array_file::{ArrayFile, FileFault, UnusableFile};
use crate::mesh::Mesh;
use crate::progress::Progress;
use glam::Vec3;
use std::path::Path;
use thiserror::Error;

/// A mesh file that cannot be used.
pub type BinaryMeshError = UnusableFile<Fault>;

/// What is wrong with a mesh file.
#[derive(Debug, Error)]
pub enum Fault {
    /// Its bytes cannot be had.
    #[error(transparent)]
    File(#[from] FileFault),
    /// A version that is not known.
    #[error("version {0} of PTRI is not supported; write the file as version 1")]
    Version(u32),
    /// Nothing to see.
    #[error("there are no triangles in the file; write the mesh again")]
    NoTriangles,
    /// More vertices than ids can count.
    #[error("{0} triangles have more corners than the {most} vertices that ids can count; split the mesh", most = u32::MAX)]
    TooMany(u32),
    /// A triangle with a corner that is not there.
    #[error(
        "triangle {triangle} (counted from 0) has the corner {corner}, and there are {vertices} vertices; write the mesh again"
    )]
    Corner {
        /// Which triangle.
        triangle: usize,
        /// The index.
        corner: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A vertex that is nowhere.
    #[error("vertex {0} (counted from 0) has a coordinate that is not finite; correct it")]
    NotFinite(usize),
}

/// Loads a file; `progress` hears of the stage "reading". Triangles are in file order; those
/// without area are kept.
///
/// # Errors
/// Says in one sentence what is wrong with the file: see [`Fault`].
pub fn read(path: &Path, progress: Progress<'_>) -> Result<Mesh, BinaryMeshError> {
    load(path, progress).map_err(|fault| BinaryMeshError {
        file: path.display().to_string(),
        fault,
    })
}

fn load(path: &Path, progress: Progress<'_>) -> Result<Mesh, Fault> {
    let mut file = ArrayFile::open(path)?;
    let report = |fraction| progress("reading", fraction);
    let mesh = if file.head(4)? == b"PTRI" {
        separate(&mut file, report)?
    } else {
        indexed(&mut file, report)?
    };
    if let Some(index) = mesh.positions.iter().position(|position| !position.is_finite()) {
        return Err(Fault::NotFinite(index));
    }
    Ok(mesh)
}

/// What follows `PTRI`.
fn separate(file: &mut ArrayFile, progress: impl Fn(f32)) -> Result<Mesh, Fault> {
    let [version, count, _] = file.words()?;
    if version != 1 {
        return Err(Fault::Version(version));
    }
    if count == 0 {
        return Err(Fault::NoTriangles);
    }
    let vertices = count.checked_mul(3).ok_or(Fault::TooMany(count))?;
    file.promise(u64::from(vertices) * 12)?;
    let positions = file.array::<Vec3>(u64::from(vertices), progress)?;
    Ok(Mesh {
        positions,
        triangles: (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        ..Mesh::default()
    })
}

/// What follows `MSH1`.
fn indexed(file: &mut ArrayFile, progress: impl Fn(f32)) -> Result<Mesh, Fault> {
    let [vertices, count] = file.words()?;
    if count == 0 {
        return Err(Fault::NoTriangles);
    }
    file.promise((u64::from(vertices) + u64::from(count)) * 12)?;
    let positions = file.array::<Vec3>(u64::from(vertices), &progress)?;
    let triangles = file.array::<[u32; 3]>(u64::from(count), &progress)?;
    let is_outside = |&corner: &u32| corner >= vertices;
    if let Some(triangle) = triangles.iter().position(|corners| corners.iter().any(is_outside)) {
        return Err(Fault::Corner {
            triangle,
            corner: *triangles[triangle]
                .iter()
                .find(|corner| is_outside(corner))
                .unwrap_or(&0),
            vertices: positions.len(),
        });
    }
    Ok(Mesh {
        positions,
        triangles,
        ..Mesh::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::silent;
    use glam::vec3;
    use std::fs;

    const SQUARE: [Vec3; 4] = [Vec3::ZERO, Vec3::X, vec3(1.0, 1.0, 0.0), Vec3::Y];
    const HALVES: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

    fn file(magic: &[u8; 4], header: &[u32], arrays: &[&[u8]]) -> Vec<u8> {
        let header = header.iter().flat_map(|word| word.to_le_bytes());
        magic.iter().copied().chain(header).chain(arrays.concat()).collect()
    }

    fn msh1(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<u8> {
        let header = [positions.len() as u32, triangles.len() as u32];
        file(
            b"MSH1",
            &header,
            &[bytemuck::cast_slice(positions), bytemuck::cast_slice(triangles)],
        )
    }

    fn ptri(version: u32, corners: &[Vec3]) -> Vec<u8> {
        file(
            b"PTRI",
            &[version, corners.len() as u32 / 3, 0],
            &[bytemuck::cast_slice(corners)],
        )
    }

    fn read_bytes(bytes: &[u8]) -> Result<Mesh, String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.mesh");
        fs::write(&path, bytes).unwrap();
        read(&path, &silent).map_err(|error| error.to_string())
    }

    #[test]
    fn both_formats_give_the_same_triangles() {
        let indexed = read_bytes(&msh1(&SQUARE, &HALVES)).unwrap();
        assert_eq!(
            (indexed.positions.as_slice(), indexed.triangles.as_slice()),
            (&SQUARE[..], &HALVES[..])
        );
        let corners: Vec<_> = HALVES
            .as_flattened()
            .iter()
            .map(|&corner| SQUARE[corner as usize])
            .collect();
        let separate = read_bytes(&ptri(1, &corners)).unwrap();
        assert_eq!(
            (separate.positions, separate.triangles),
            (corners, vec![[0, 1, 2], [3, 4, 5]])
        );
    }

    #[test]
    fn files_that_are_cut_short() {
        for whole in [msh1(&SQUARE, &HALVES), ptri(1, &SQUARE[..3])] {
            for length in 4..whole.len() {
                let error = read_bytes(&whole[..length]).unwrap_err();
                assert!(error.contains("a.mesh: the file is cut short"), "{length}: {error}");
            }
        }
        let huge = file(b"MSH1", &[u32::MAX, u32::MAX], &[&[0; 64]]);
        assert!(read_bytes(&huge).unwrap_err().contains("promises 103079215092 bytes"));
        let huge = file(b"PTRI", &[1, u32::MAX / 3, 0], &[&[0; 64]]);
        assert!(read_bytes(&huge).unwrap_err().contains("cut short"));
    }

    #[test]
    fn meshes_that_break_a_rule() {
        let mut nowhere = SQUARE;
        nowhere[2].y = f32::NAN;
        for (bytes, words) in [
            (
                msh1(&SQUARE, &[[0, 1, 2], [0, 2, 4]]),
                "triangle 1 (counted from 0) has the corner 4",
            ),
            (msh1(&nowhere, &HALVES), "vertex 2"),
            (msh1(&SQUARE, &[]), "no triangles"),
            (ptri(1, &[]), "no triangles"),
            (ptri(2, &SQUARE[..3]), "version 2"),
            (file(b"PTRI", &[1, u32::MAX, 0], &[]), "split the mesh"),
        ] {
            let error = read_bytes(&bytes).unwrap_err();
            assert!(error.contains(words), "{error}");
        }
    }
}
