//! Files of rays.
//!
//! | format | begins with | then |
//! |---|---|---|
//! | NumPy's `.npy` | `\x93NUMPY` | N x 6 or N x 8 numbers, f32 or f64, of either byte order, in C or Fortran order: origin, direction, and perhaps `t_min` and `t_max` |
//! | `.rays` | `PRAY`, u32 version 1, u32 count, u32 query (0 closest, 1 any) | per ray 8 f32: origin, `t_min`, direction, `t_max` |
//! | `.ray` | `RAY1`, u32 count, u32 query, u32 width, u32 height, 3 u32 | f32 origins, f32 directions, f32 `t_max`; then u32 pixels, i32 triangles and f64 `t` of an oracle, which are not read |
//!
//! The last two are little-endian. Memory is taken as a file proves to have what its header claims.

mod columns;
mod fault;
mod npy;
mod records;

pub use fault::{Fault, RaysError};

use crate::array_file::ArrayFile;
use crate::backend::Query;
use crate::progress::Progress;
use glam::DVec3;
use oktant_shared::ray::Ray;
use std::path::Path;

/// A file of rays whose header has been read.
#[derive(Debug)]
pub struct RayFile {
    name: String,
    file: ArrayFile,
    layout: Layout,
    count: u64,
    query: Option<Query>,
}

#[derive(Debug)]
enum Layout {
    Npy(npy::Layout),
    Records,
    Columns,
}

/// What a header says.
struct Header {
    layout: Layout,
    /// How many rays.
    count: u64,
    query: Option<Query>,
}

impl RayFile {
    /// Opens a file and reads its header; where the file's size is known, it is checked too.
    ///
    /// # Errors
    /// Says in one sentence what is wrong with the file: see [`Fault`].
    pub fn open(path: &Path) -> Result<Self, RaysError> {
        let name = path.display().to_string();
        let open = || -> Result<(ArrayFile, Header), Fault> {
            let mut file = ArrayFile::open(path)?;
            let header = match file.head(4)?.as_slice() {
                b"PRAY" => records::header(&mut file)?,
                b"RAY1" => columns::header(&mut file)?,
                b"\x93NUM" => npy::header(&mut file)?,
                [b'P', b'K', ..] => return Err(Fault::Archive),
                [] => return Err(crate::array_file::FileFault::Empty.into()),
                _ => return Err(Fault::Unknown),
            };
            Ok((file, header))
        };
        match open() {
            Ok((file, header)) => Ok(RayFile {
                name,
                file,
                layout: header.layout,
                count: header.count,
                query: header.query,
            }),
            Err(fault) => Err(RaysError { file: name, fault }),
        }
    }

    /// How many rays the header promises.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// What the rays ask for, where the format says so.
    pub fn query(&self) -> Option<Query> {
        self.query
    }

    /// Reads the rays; `progress` hears of the stage "reading". `shift` is subtracted from every origin, in f64 before
    /// it is rounded to f32: that of the mesh that the rays are cast at, see [`crate::mesh::Mesh::shift`].
    ///
    /// Limits that the file does not have are 0 and infinity. Rays that can hit nothing are kept, see [`Ray`].
    ///
    /// # Errors
    /// As [`RayFile::open`].
    pub fn read(self, shift: DVec3, progress: Progress<'_>) -> Result<Vec<Ray>, RaysError> {
        let RayFile {
            name,
            mut file,
            layout,
            count,
            ..
        } = self;
        let progress = |fraction| progress("reading", fraction);
        let rays = match layout {
            Layout::Npy(layout) => npy::read(&mut file, &layout, count, shift, progress),
            Layout::Records => records::read(&mut file, count, shift, progress),
            Layout::Columns => columns::read(&mut file, count, shift, progress),
        };
        rays.map_err(|fault| RaysError { file: name, fault })
    }
}

/// A ray that reads fill in.
const UNLIMITED: Ray = Ray {
    origin: glam::Vec3::ZERO,
    t_min: 0.0,
    direction: glam::Vec3::ZERO,
    t_max: f32::INFINITY,
};

fn query(code: u32) -> Result<Query, Fault> {
    match code {
        0 => Ok(Query::Closest),
        1 => Ok(Query::Any),
        other => Err(Fault::Query(other)),
    }
}

/// Subtracts from an origin that is known in f32.
fn shifted(origin: glam::Vec3, shift: DVec3) -> glam::Vec3 {
    (origin.as_dvec3() - shift).as_vec3()
}

#[cfg(test)]
mod tests;
