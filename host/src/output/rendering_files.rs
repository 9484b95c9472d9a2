//! All files of a rendering, which appear together or not at all.

use super::{Format, OutputError, PictureFile, aov_png, open_exr, publish};
use crate::aov::Aov;
use crate::output::png::{Pixels, Png};
use crate::picture::Picture;
use crate::seen::Seen;
use crate::tone::Tone;
use crate::wires::Layer;
use std::ffi::OsString;
use std::iter::once;
use std::path::{Path, PathBuf};

/// Files in the making, see [`PictureFile`]: one for each eye's picture, and beside each one for everything else that is
/// to be told of its pixels, unless the picture's own file holds that too.
#[derive(Debug)]
pub struct RenderingFiles {
    format: Format,
    aovs: Vec<Aov>,
    eyes: Vec<EyeFiles>,
    /// What is drawn over the picture, if anything.
    layer: Option<Layer>,
}

#[derive(Debug)]
struct EyeFiles {
    picture: PictureFile,
    beside: Vec<(Aov, PictureFile)>,
}

/// A file that was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// Its name.
    pub path: PathBuf,
    /// How to read it, where it is no picture of the scene.
    pub description: Option<String>,
}

impl RenderingFiles {
    /// Makes sure that all files can be written, without touching what is there. Those of a pair have `-left` and `-right`
    /// at the end of their names, PNG files beside a picture the name of what they show: `NAME-depth.png`.
    ///
    /// # Errors
    /// [`OutputError`] of the first that cannot.
    pub fn create(path: &Path, format: Format, aovs: &[Aov], is_pair: bool) -> Result<Self, OutputError> {
        let eye = |name: &PathBuf| {
            Ok(EyeFiles {
                picture: PictureFile::create(name)?,
                beside: beside(name, format, aovs)
                    .map(|(aov, name)| Ok((aov, PictureFile::create(&name)?)))
                    .collect::<Result<_, _>>()?,
            })
        };
        Ok(RenderingFiles {
            format,
            aovs: aovs.to_vec(),
            eyes: eyes(path, is_pair).iter().map(eye).collect::<Result<_, _>>()?,
            layer: None,
        })
    }

    /// The picture alone, for whoever reads standard output.
    ///
    /// # Errors
    /// [`OutputError`] where there is no place to keep it until it is complete.
    pub fn standard_output(format: Format) -> Result<Self, OutputError> {
        Ok(RenderingFiles {
            format,
            aovs: Vec::new(),
            eyes: vec![EyeFiles {
                picture: PictureFile::standard_output()?,
                beside: Vec::new(),
            }],
            layer: None,
        })
    }

    /// The names of all files that [`RenderingFiles::create`] is to write.
    pub fn names(path: &Path, format: Format, aovs: &[Aov], is_pair: bool) -> Vec<PathBuf> {
        let mut names = Vec::new();
        for name in eyes(path, is_pair) {
            let others: Vec<_> = beside(&name, format, aovs).map(|(_, name)| name).collect();
            names.push(name);
            names.extend(others);
        }
        names
    }

    /// With something drawn over the picture where that is a PNG file of 8 bits; not for pairs.
    pub fn under(self, layer: Option<Layer>) -> Self {
        RenderingFiles { layer, ..self }
    }

    /// Whether there is a file for each of two eyes.
    pub fn is_pair(&self) -> bool {
        self.eyes.len() == 2
    }

    /// Writes everything, then gives all files their names. Of a pair, the upper half of the picture is the left eye's.
    /// The tone is for PNG files. What is seen may be empty where nothing is to be told beside the colour.
    ///
    /// # Errors
    /// [`OutputError::Io`]; nothing is left behind and what was there before is untouched, unless the very last step, the
    /// renaming, failed for some of the files.
    pub fn save(mut self, picture: Picture, seen: Seen, tone: &Tone) -> Result<Vec<Written>, OutputError> {
        let parts = if self.is_pair() {
            let rows = picture.height / 2;
            let rows_seen = if self.aovs.is_empty() { 0 } else { rows };
            picture.split(rows).into_iter().zip(seen.split(rows_seen)).collect()
        } else {
            vec![(picture, seen)]
        };
        let mut written = Vec::new();
        for (files, (picture, seen)) in self.eyes.iter_mut().zip(&parts) {
            let file = &mut files.picture;
            match &self.format {
                Format::Exr => file.write(|writer| open_exr::write(writer, picture, seen, &self.aovs))?,
                Format::Png(bits) => {
                    let mut pixels = Pixels::of(picture, tone, *bits);
                    if let (Some(layer), Pixels::Rgb8(channels)) = (&self.layer, &mut pixels) {
                        layer.over(channels.to_mut());
                    }
                    let png = Png {
                        width: picture.width,
                        height: picture.height,
                        pixels,
                        description: None,
                    };
                    file.write(|writer| png.write(writer))?;
                }
            }
            written.push(Written {
                path: file.path.clone(),
                description: None,
            });
            for (aov, file) in &mut files.beside {
                let png = aov_png::png(*aov, picture, seen);
                file.write(|writer| png.write(writer))?;
                written.push(Written {
                    path: file.path.clone(),
                    description: png.description,
                });
            }
        }
        publish(self.eyes.into_iter().flat_map(|files| {
            let beside = files.beside.into_iter().map(|(_, file)| file);
            once(files.picture).chain(beside)
        }))?;
        Ok(written)
    }
}

/// The name of each eye's picture.
pub(super) fn eyes(path: &Path, is_pair: bool) -> Vec<PathBuf> {
    if is_pair {
        vec![with_suffix(path, "left"), with_suffix(path, "right")]
    } else {
        vec![path.to_path_buf()]
    }
}

/// The names of the files beside a picture's; an EXR file holds all itself.
fn beside(name: &Path, format: Format, aovs: &[Aov]) -> impl Iterator<Item = (Aov, PathBuf)> {
    let aovs = if format == Format::Exr { &[] } else { aovs };
    aovs.iter().map(move |aov| (*aov, with_suffix(name, aov.name())))
}

/// `NAME-suffix.EXT` for `NAME.EXT`.
fn with_suffix(path: &Path, suffix: &str) -> PathBuf {
    let mut name = OsString::from(path.file_stem().unwrap_or_default());
    name.push("-");
    name.push(suffix);
    if let Some(extension) = path.extension() {
        name.push(".");
        name.push(extension);
    }
    path.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::Bits;
    use glam::{Vec3, Vec4};
    use oktant_shared::hit::Hit;
    use std::fs;

    fn stacked() -> (Picture, Seen) {
        let sums = (0..8).map(|i| Vec4::new(if i < 4 { 1.0 } else { 0.0 }, 0.0, 0.0, 1.0));
        let seen = Seen {
            width: 2,
            hits: vec![Hit::miss(1.0); 8],
            normals: vec![Vec3::ZERO; 8],
        };
        (Picture::of_sums(2, 4, sums.collect()), seen)
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<_> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn names_get_suffixes() {
        for (path, wanted) in [
            ("a.png", "a-left.png"),
            ("b/c.d.EXR", "b/c.d-left.EXR"),
            ("../a.png", "../a-left.png"),
        ] {
            assert_eq!(with_suffix(Path::new(path), "left"), Path::new(wanted));
        }
    }

    #[test]
    fn each_eye_has_its_half_and_what_is_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let format = Format::Png(Bits::Sixteen);
        let files = RenderingFiles::create(&path, format, &[Aov::Depth, Aov::Rays], true).unwrap();
        let (picture, seen) = stacked();
        let written = files.save(picture, seen, &Tone::default()).unwrap();
        let read = |name| image::open(folder.path().join(name)).unwrap();
        assert_eq!(read("a-left.png").into_rgb16().into_raw()[..3], [65_535, 0, 0]);
        assert_eq!(read("a-right.png").into_rgb16().into_raw(), [0; 12]);
        assert_eq!(read("a-right-depth.png").into_luma16().dimensions(), (2, 2));
        let all = [
            "a-left-depth.png",
            "a-left-rays.png",
            "a-left.png",
            "a-right-depth.png",
            "a-right-rays.png",
            "a-right.png",
        ];
        assert_eq!(names(folder.path()), all);
        let mut told = RenderingFiles::names(&path, format, &[Aov::Depth, Aov::Rays], true);
        told.sort();
        assert_eq!(told, all.map(|name| folder.path().join(name)));
        assert_eq!(written.len(), all.len());
        assert_eq!(written.iter().filter(|file| file.description.is_none()).count(), 2);
    }

    #[test]
    fn a_pair_without_more_needs_nothing_seen() {
        let folder = tempfile::tempdir().unwrap();
        let files = RenderingFiles::create(&folder.path().join("a.exr"), Format::Exr, &[], true).unwrap();
        files.save(stacked().0, Seen::default(), &Tone::default()).unwrap();
        assert_eq!(names(folder.path()), ["a-left.exr", "a-right.exr"]);
    }

    #[test]
    fn layers_of_an_exr_file_are_in_it() {
        let folder = tempfile::tempdir().unwrap();
        let files = RenderingFiles::create(&folder.path().join("a.exr"), Format::Exr, &Aov::ALL, false).unwrap();
        let (picture, seen) = stacked();
        files.save(picture, seen, &Tone::default()).unwrap();
        assert_eq!(names(folder.path()), ["a.exr"]);
    }

    #[test]
    fn where_one_file_cannot_be_there_is_none() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("a-rays.png")).unwrap();
        let path = folder.path().join("a.png");
        let format = Format::Png(Bits::Eight);
        let refused = RenderingFiles::create(&path, format, &[Aov::Id, Aov::Rays], false);
        assert!(matches!(refused, Err(OutputError::NotAFile(name)) if name.ends_with("a-rays.png")));
        assert_eq!(names(folder.path()), ["a-rays.png"]);
    }
}
