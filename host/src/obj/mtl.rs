//! MTL files: what surfaces are made of.

use super::fault::Fault;
use super::lines::{lines, number, words};
use crate::excerpt::excerpt;
use glam::DVec3;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// Nobody writes a longer one, bytes.
pub(super) const LARGEST: u64 = 64 << 20;

/// A material as an MTL file describes it, with what the format says where it does not.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Description {
    /// `Kd`: diffuse colour, linear.
    pub(super) diffuse: DVec3,
    /// `Ks`: colour of highlights and mirror images, linear.
    pub(super) specular: DVec3,
    /// `Ns`: exponent of the highlight.
    pub(super) exponent: f64,
    /// `d`, or 1 less `Tr`: part that hides what is behind.
    pub(super) dissolve: f64,
    /// `Tf`: colour of what shines through.
    pub(super) filter: DVec3,
    /// `Ni`: index of refraction.
    pub(super) ior: f64,
    /// `illum`: what of all this counts.
    pub(super) illumination: u32,
    /// `map_Kd`: an image that the diffuse colour is multiplied with, and the folder that its name is relative to.
    pub(super) image: Option<PathBuf>,
    /// Whether it has images that are not read.
    pub(super) has_others: bool,
}

impl Default for Description {
    fn default() -> Self {
        Description {
            diffuse: DVec3::splat(0.8),
            specular: DVec3::ZERO,
            exponent: 0.0,
            dissolve: 1.0,
            filter: DVec3::ONE,
            ior: 1.0,
            illumination: 2,
            image: None,
            has_others: false,
        }
    }
}

/// Where a file may lie that `mtllib` names: the whole text is one name, or each of its words.
pub(super) fn candidates(library: &str, folder: &Path) -> Vec<PathBuf> {
    let whole = folder.join(plain(library));
    if whole.is_file() {
        return vec![whole];
    }
    library
        .split_whitespace()
        .map(|name| folder.join(plain(name)))
        .collect()
}

/// Reads all materials of a file in `folder`; of several with the same name, the first counts. `file` is what errors call it.
pub(super) fn read(
    bytes: &[u8],
    file: &str,
    folder: &Path,
    materials: &mut HashMap<String, Description>,
) -> Result<(), Fault> {
    let mut name = None;
    let mut current = Description::default();
    for line in lines(bytes) {
        let (keyword, rest) = line.split();
        let wrong = |word: &[u8]| Fault::Material {
            file: file.to_owned(),
            line: line.number,
            word: excerpt(word),
        };
        let value = |rest: &[u8]| {
            let word = words(rest).next().unwrap_or_default();
            number(word).ok_or_else(|| wrong(word))
        };
        match keyword {
            b"newmtl" => {
                let done = std::mem::take(&mut current);
                if let Some(name) = name.replace(String::from_utf8_lossy(rest).into_owned()) {
                    materials.entry(name).or_insert(done);
                }
            }
            b"Kd" => current.diffuse = color(rest, wrong)?,
            b"Ks" => current.specular = color(rest, wrong)?,
            b"Tf" => current.filter = color(rest, wrong)?,
            b"Ns" => current.exponent = value(rest)?,
            b"Ni" => current.ior = value(rest)?,
            b"d" => current.dissolve = value(rest.strip_prefix(b"-halo").unwrap_or(rest))?,
            b"Tr" => current.dissolve = 1.0 - value(rest)?,
            b"illum" => current.illumination = value(rest)? as u32,
            b"map_Kd" => current.image = image(rest).map(|name| folder.join(name)),
            _ if is_image(keyword) => current.has_others = true,
            _ => {}
        }
    }
    if let Some(name) = name {
        materials.entry(name).or_insert(current);
    }
    Ok(())
}

/// The images that are read with a file.
pub(super) fn images(bytes: &[u8]) -> Vec<PathBuf> {
    lines(bytes)
        .filter_map(|line| match line.split() {
            (b"map_Kd", rest) => image(rest),
            _ => None,
        })
        .collect()
}

/// A colour of three numbers, or a grey of one, 0 to 1; white for a spectrum or another space, which are not known.
fn color<'a>(rest: &'a [u8], wrong: impl Fn(&[u8]) -> Fault) -> Result<DVec3, Fault> {
    let channel = |word: &'a [u8]| number(word).ok_or_else(|| wrong(word));
    let mut words = words(rest);
    let first = words.next().unwrap_or_default();
    if matches!(first, b"spectral" | b"xyz") {
        return Ok(DVec3::ONE);
    }
    let red = channel(first)?;
    let color = match (words.next(), words.next()) {
        (Some(green), Some(blue)) => DVec3::new(red, channel(green)?, channel(blue)?),
        _ => DVec3::splat(red),
    };
    Ok(color.clamp(DVec3::ZERO, DVec3::ONE))
}

/// The name of an image, behind the options that have one to three numbers or a word each.
fn image(rest: &[u8]) -> Option<PathBuf> {
    let mut rest = rest.trim_ascii();
    let word = |text: &[u8]| text.iter().position(u8::is_ascii_whitespace).unwrap_or(text.len());
    while rest.first() == Some(&b'-') {
        let end = word(rest);
        let is_vector = matches!(&rest[..end], b"-o" | b"-s" | b"-t");
        rest = rest[end..].trim_ascii_start();
        let mut values = 0;
        while !rest.is_empty() && values < if is_vector { 3 } else { 1 } {
            let end = word(rest);
            if is_vector && number(&rest[..end]).is_none() {
                break;
            }
            rest = rest[end..].trim_ascii_start();
            values += 1;
        }
    }
    let name = String::from_utf8_lossy(rest);
    (!name.is_empty()).then(|| plain(&name))
}

/// A path as this system writes it.
fn plain(name: &str) -> PathBuf {
    PathBuf::from(name.trim().replace('\\', "/"))
}

fn is_image(keyword: &[u8]) -> bool {
    keyword.starts_with(b"map_") || matches!(keyword, b"bump" | b"disp" | b"decal" | b"refl" | b"norm")
}
