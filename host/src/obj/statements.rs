//! What stands in an OBJ file.

use super::fault::Fault;
use super::lines::{lines, number, words};
use crate::excerpt::excerpt;
use glam::{DVec3, Vec2, Vec3};
use std::collections::HashMap;

/// An index of nothing.
pub(super) const NONE: u32 = u32::MAX;
/// Lines between two reports of progress.
const BLOCK: usize = 1 << 14;

/// A corner of a face: indices from 0, or [`NONE`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Corner {
    pub(super) position: u32,
    pub(super) coordinate: u32,
    pub(super) normal: u32,
}

/// A face of at least three corners.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    /// Index of its first corner.
    pub(super) first: usize,
    /// How many corners it has.
    pub(super) corners: usize,
    /// Its line, from 1.
    pub(super) line: usize,
    /// Index of its material's name, or [`NONE`].
    pub(super) material: u32,
    /// Its smoothing group; 0 is none.
    pub(super) group: u32,
}

/// All statements of a file that mean something here.
#[derive(Debug, Default)]
pub(super) struct Statements {
    pub(super) positions: Vec<DVec3>,
    /// Empty, or one colour a position.
    pub(super) colors: Vec<[u8; 4]>,
    pub(super) coordinates: Vec<Vec2>,
    /// Of unit length, or zero.
    pub(super) normals: Vec<Vec3>,
    /// The corners of all faces, which are in range.
    pub(super) corners: Vec<Corner>,
    pub(super) faces: Vec<Face>,
    /// Faces with too few corners.
    pub(super) skipped: usize,
    /// Names of the materials that faces have.
    pub(super) materials: Vec<String>,
    /// What `mtllib` says, in order.
    pub(super) libraries: Vec<String>,
}

/// What faces that follow have.
struct State {
    material: u32,
    group: u32,
    known: HashMap<String, u32>,
}

/// Reads all lines.
pub(super) fn read(bytes: &[u8], progress: &dyn Fn(f32)) -> Result<Statements, Fault> {
    let mut all = Statements::default();
    let mut state = State {
        material: NONE,
        group: 1,
        known: HashMap::new(),
    };
    let mut read = 0;
    for (i, line) in lines(bytes).enumerate() {
        let (keyword, rest) = line.split();
        // As long as most lines are what they look like.
        read += keyword.len() + rest.len() + 2;
        if i.is_multiple_of(BLOCK) {
            progress((read as f32 / bytes.len() as f32).min(1.0));
        }
        match keyword {
            b"v" => all.add_position(rest, line.number)?,
            b"vt" => {
                // One number is enough.
                let [u, v] = numbers(rest, line.number, "vt", 1)?;
                all.coordinates.push(Vec2::new(u as f32, v as f32).map(finite_or_zero));
            }
            b"vn" => {
                let normal = DVec3::from_array(numbers(rest, line.number, "vn", 3)?);
                all.normals.push(normal.try_normalize().unwrap_or_default().as_vec3());
            }
            b"f" | b"fo" => all.add_face(rest, line.number, &state)?,
            b"s" => {
                let group = std::str::from_utf8(rest).ok().and_then(|word| word.parse().ok());
                state.group = group.unwrap_or(u32::from(rest.eq_ignore_ascii_case(b"on")));
            }
            b"usemtl" => {
                let name = String::from_utf8_lossy(rest).into_owned();
                state.material = *state.known.entry(name).or_insert_with_key(|name| {
                    all.materials.push(name.clone());
                    all.materials.len() as u32 - 1
                });
            }
            b"mtllib" => all.libraries.push(String::from_utf8_lossy(rest).into_owned()),
            _ => {}
        }
    }
    if all.faces.is_empty() {
        return Err(Fault::NoFaces);
    }
    all.check()?;
    Ok(all)
}

/// What `mtllib` says, in order.
pub(super) fn libraries(bytes: &[u8]) -> Vec<String> {
    lines(bytes)
        .filter_map(|line| match line.split() {
            (b"mtllib", names) => Some(String::from_utf8_lossy(names).into_owned()),
            _ => None,
        })
        .collect()
}

impl Statements {
    fn add_position(&mut self, rest: &[u8], line: usize) -> Result<(), Fault> {
        let [x, y, z, a, b, c, d] = numbers(rest, line, "v", 3)?;
        let position = DVec3::new(x, y, z);
        // Four are a place and a weight, which polygons do not use; seven are that and a colour.
        let color = match words(rest).count() {
            6 => Some([a, b, c]),
            7 => Some([b, c, d]),
            _ => None,
        };
        if let Some(color) = color {
            self.colors.resize(self.positions.len(), [255; 4]);
            let [red, green, blue] = color.map(|channel| (channel * 255.0).round() as u8);
            self.colors.push([red, green, blue, 255]);
        } else if !self.colors.is_empty() {
            self.colors.push([255; 4]);
        }
        self.positions.push(position);
        Ok(())
    }

    fn add_face(&mut self, rest: &[u8], line: usize, state: &State) -> Result<(), Fault> {
        let first = self.corners.len();
        let counts = [self.positions.len(), self.coordinates.len(), self.normals.len()];
        for word in words(rest) {
            self.corners.push(corner(word, counts, line)?);
        }
        let corners = self.corners.len() - first;
        if corners < 3 {
            self.corners.truncate(first);
            self.skipped += 1;
            return Ok(());
        }
        self.faces.push(Face {
            first,
            corners,
            line,
            material: state.material,
            group: state.group,
        });
        Ok(())
    }

    /// Makes sure that all corners are in range: what a face refers to may stand behind it.
    fn check(&self) -> Result<(), Fault> {
        let all = [
            ("vertices", self.positions.len()),
            ("texture coordinates", self.coordinates.len()),
            ("normals", self.normals.len()),
            ("corners", self.corners.len()),
        ];
        if let Some((what, _)) = all.iter().find(|(_, count)| *count >= NONE as usize) {
            return Err(Fault::TooMany(what));
        }
        for face in &self.faces {
            for corner in &self.corners[face.first..][..face.corners] {
                let indices = [corner.position, corner.coordinate, corner.normal];
                for ((index, (_, count)), what) in indices.into_iter().zip(all).zip(ONE_OF) {
                    if index != NONE && index as usize >= count {
                        return Err(Fault::OutOfRange {
                            line: face.line,
                            what,
                            index: i64::from(index) + 1,
                            count,
                        });
                    }
                }
            }
        }
        Ok(())
    }
}

/// What the three indices of a corner refer to.
const ONE_OF: [&str; 3] = ["vertex", "texture coordinate", "normal"];

/// At least `needed` numbers; the others are 0 where they are missing.
fn numbers<const N: usize>(rest: &[u8], line: usize, what: &'static str, needed: usize) -> Result<[f64; N], Fault> {
    let mut numbers = [0.0; N];
    let mut found = 0;
    for (value, word) in numbers.iter_mut().zip(words(rest)) {
        *value = number(word).ok_or_else(|| Fault::Number {
            line,
            word: excerpt(word),
        })?;
        found += 1;
    }
    if found < needed {
        return Err(Fault::TooFewNumbers {
            line,
            what,
            found,
            needed,
        });
    }
    Ok(numbers)
}

/// A corner, with so many positions, coordinates and normals before it. Positive indices may be out of range until all is
/// read.
fn corner(word: &[u8], counts: [usize; 3], line: usize) -> Result<Corner, Fault> {
    let wrong = || Fault::Corner {
        line,
        word: excerpt(word),
    };
    let mut indices = [NONE; 3];
    let mut parts = word.split(|byte| *byte == b'/');
    for (kind, (index, count)) in indices.iter_mut().zip(counts).enumerate() {
        let Some(part) = parts.next() else { break };
        if part.is_empty() && kind > 0 {
            continue;
        }
        let number: Option<i64> = std::str::from_utf8(part).ok().and_then(|part| part.parse().ok());
        let number = number.filter(|number| *number != 0).ok_or_else(wrong)?;
        let from_zero = if number > 0 {
            number - 1
        } else {
            number.saturating_add(count as i64)
        };
        *index = u32::try_from(from_zero)
            .ok()
            .filter(|index| *index != NONE)
            .ok_or(Fault::OutOfRange {
                line,
                what: ONE_OF[kind],
                index: number,
                count,
            })?;
    }
    if parts.next().is_some() {
        return Err(wrong());
    }
    let [position, coordinate, normal] = indices;
    Ok(Corner {
        position,
        coordinate,
        normal,
    })
}

fn finite_or_zero(number: f32) -> f32 {
    if number.is_finite() { number } else { 0.0 }
}
