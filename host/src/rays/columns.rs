//! `RAY1`: an array of all origins, one of all directions, and so on.

use super::{Fault, Header, Layout, UNLIMITED, query, shifted};
use crate::array_file::ArrayFile;
use glam::{DVec3, Vec3};
use oktant_shared::ray::Ray;

/// Bytes for each ray: origin, direction, `t_max`, pixel, and an oracle's triangle and `t`.
const BYTES: u64 = 12 + 12 + 4 + 4 + 4 + 8;

/// What follows `RAY1`.
pub fn header(file: &mut ArrayFile) -> Result<Header, Fault> {
    let [count, code, ..] = file.words::<7>()?;
    let query = Some(query(code)?);
    file.promise(u64::from(count) * BYTES)?;
    Ok(Header {
        layout: Layout::Columns,
        count: u64::from(count),
        query,
    })
}

/// The arrays, up to the last that belongs to the rays.
pub fn read(file: &mut ArrayFile, count: u64, shift: DVec3, progress: impl Fn(f32)) -> Result<Vec<Ray>, Fault> {
    let mut rays = Vec::new();
    let add = |origins: &[Vec3]| {
        rays.extend(origins.iter().map(|&origin| Ray {
            origin: if shift == DVec3::ZERO {
                origin
            } else {
                shifted(origin, shift)
            },
            ..UNLIMITED
        }));
    };
    file.pieces(count, add, &progress)?;
    let mut rest = rays.iter_mut();
    let direct = |directions: &[Vec3]| {
        for (direction, ray) in directions.iter().zip(&mut rest) {
            ray.direction = *direction;
        }
    };
    file.pieces(count, direct, &progress)?;
    let mut rest = rays.iter_mut();
    let limit = |limits: &[f32]| {
        for (limit, ray) in limits.iter().zip(&mut rest) {
            ray.t_max = *limit;
        }
    };
    file.pieces(count, limit, &progress)?;
    Ok(rays)
}
