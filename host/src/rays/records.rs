//! `.rays`: a record for each ray, laid out as [`Ray`] is.

use super::{Fault, Header, Layout, query, shifted};
use crate::array_file::ArrayFile;
use glam::DVec3;
use oktant_shared::ray::Ray;

/// What follows `PRAY`.
pub fn header(file: &mut ArrayFile) -> Result<Header, Fault> {
    let [version, count, code] = file.words()?;
    if version != 1 {
        return Err(Fault::Version {
            format: "PRAY",
            found: version,
            known: "1",
        });
    }
    let query = Some(query(code)?);
    file.promise(u64::from(count) * size_of::<Ray>() as u64)?;
    Ok(Header {
        layout: Layout::Records,
        count: u64::from(count),
        query,
    })
}

/// The records.
pub fn read(file: &mut ArrayFile, count: u64, shift: DVec3, progress: impl Fn(f32)) -> Result<Vec<Ray>, Fault> {
    let mut rays = file.array::<Ray>(count, progress)?;
    if shift != DVec3::ZERO {
        for ray in &mut rays {
            ray.origin = shifted(ray.origin, shift);
        }
    }
    Ok(rays)
}
