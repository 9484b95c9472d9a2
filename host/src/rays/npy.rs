//! NumPy's `.npy`: one array of any shape. Format: NEP 1, "A Simple File Format for NumPy Arrays" (2007), and the
//! versions 2 and 3 that followed.

use super::{Fault, Header, UNLIMITED};
use crate::array_file::{ArrayFile, FileFault};
use bytemuck::Pod;
use glam::DVec3;
use oktant_shared::ray::Ray;

mod dictionary;

use dictionary::Dictionary;

/// Longest header that is read, bytes: what version 1 can have. One of an array of numbers has about 120.
const LONGEST: u64 = 65_535;

/// How the numbers lie in the file.
#[derive(Debug)]
pub struct Layout {
    width: Width,
    is_big_endian: bool,
    /// All first numbers of the rays, then all second ones, and so on, instead of ray by ray.
    is_fortran: bool,
    /// Numbers of each ray, 6 or 8.
    columns: usize,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Width {
    Single,
    Double,
}

/// What follows the first four bytes.
pub fn header(file: &mut ArrayFile) -> Result<Header, Fault> {
    let short = || Fault::Header("it is cut short".into());
    let bytes = file.head(4)?;
    let &[b'P', b'Y', major, _] = bytes.as_slice() else {
        return Err(Fault::Unknown);
    };
    let size = match major {
        1 => 2,
        2 | 3 => 4,
        _ => {
            return Err(Fault::Version {
                format: ".npy",
                found: u32::from(major),
                known: "1, 2 or 3",
            });
        }
    };
    let bytes = file.head(size)?;
    if bytes.len() < size {
        return Err(short());
    }
    let found = bytes
        .iter()
        .rev()
        .fold(0, |length, &byte| length << 8 | u64::from(byte));
    if found > LONGEST {
        return Err(Fault::LongHeader { found, most: LONGEST });
    }
    let text = file.head(found as usize)?;
    if (text.len() as u64) < found {
        return Err(short());
    }
    let text = str::from_utf8(&text).map_err(|_| Fault::Header("it is no text".into()))?;
    let dictionary = Dictionary::parse(text).map_err(Fault::Header)?;
    let (count, layout) = layout(&dictionary)?;
    let bytes = if layout.width == Width::Single { 4 } else { 8 };
    file.promise(count.saturating_mul(layout.columns as u64 * bytes))?;
    Ok(Header {
        layout: super::Layout::Npy(layout),
        count,
        query: None,
    })
}

fn layout(dictionary: &Dictionary<'_>) -> Result<(u64, Layout), Fault> {
    let (is_big_endian, width) = match dictionary.descr {
        "<f4" => (false, Width::Single),
        ">f4" => (true, Width::Single),
        "<f8" => (false, Width::Double),
        ">f8" => (true, Width::Double),
        other => return Err(Fault::Type(other.escape_debug().take(40).collect())),
    };
    let (count, columns) = match *dictionary.shape.as_slice() {
        [count, columns @ (6 | 8)] => (count, columns as usize),
        ref other => {
            let sizes: Vec<_> = other.iter().take(8).map(u64::to_string).collect();
            return Err(Fault::Shape(sizes.join(", ")));
        }
    };
    let layout = Layout {
        width,
        is_big_endian,
        is_fortran: dictionary.fortran_order,
        columns,
    };
    Ok((count, layout))
}

/// The array.
pub fn read(
    file: &mut ArrayFile,
    layout: &Layout,
    count: u64,
    shift: DVec3,
    progress: impl Fn(f32),
) -> Result<Vec<Ray>, Fault> {
    let rays = match (layout.width, layout.is_big_endian) {
        (Width::Single, false) => rays(file, layout, count, shift, |bits| f32::from_bits(bits).into(), progress),
        (Width::Single, true) => {
            let number = |bits: u32| f32::from_bits(bits.swap_bytes()).into();
            rays(file, layout, count, shift, number, progress)
        }
        (Width::Double, false) => rays(file, layout, count, shift, f64::from_bits, progress),
        (Width::Double, true) => {
            let number = |bits: u64| f64::from_bits(bits.swap_bytes());
            rays(file, layout, count, shift, number, progress)
        }
    };
    Ok(rays?)
}

fn rays<T: Pod>(
    file: &mut ArrayFile,
    layout: &Layout,
    count: u64,
    shift: DVec3,
    number: impl Fn(T) -> f64,
    progress: impl Fn(f32),
) -> Result<Vec<Ray>, FileFault> {
    let mut rays = Vec::new();
    if layout.is_fortran {
        // The first column, which proves how many rays there are.
        let add = |piece: &[T]| {
            rays.extend(piece.iter().map(|&bits| {
                let mut ray = UNLIMITED;
                set(&mut ray, 0, number(bits), shift);
                ray
            }));
        };
        file.pieces(count, add, &progress)?;
        for column in 1..layout.columns {
            let mut rest = rays.iter_mut();
            let fill = |piece: &[T]| {
                for (&bits, ray) in piece.iter().zip(&mut rest) {
                    set(ray, column, number(bits), shift);
                }
            };
            file.pieces(count, fill, &progress)?;
        }
        return Ok(rays);
    }
    // Pieces may end within a row.
    let (mut ray, mut column) = (UNLIMITED, 0);
    let add = |piece: &[T]| {
        for &bits in piece {
            set(&mut ray, column, number(bits), shift);
            column += 1;
            if column == layout.columns {
                rays.push(ray);
                column = 0;
            }
        }
    };
    file.pieces(count.saturating_mul(layout.columns as u64), add, progress)?;
    Ok(rays)
}

/// Puts the number of a column into a ray, rounded to f32.
fn set(ray: &mut Ray, column: usize, value: f64, shift: DVec3) {
    match column {
        0..3 => ray.origin[column] = (value - shift[column]) as f32,
        3..6 => ray.direction[column - 3] = value as f32,
        6 => ray.t_min = value as f32,
        _ => ray.t_max = value as f32,
    }
}
