//! Files of hits: an archive of NumPy arrays, as `numpy.savez` writes them.

use super::{OutputError, PictureFile};
use bytemuck::NoUninit;
use glam::Vec3;
use oktant_shared::hit::Hit;
use rayon::prelude::*;
use std::io::{self, Seek, Write};
use std::path::Path;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// A `.npz` file in the making, see [`PictureFile`]. Its arrays have an element for each ray, in the order of the rays.
#[derive(Debug)]
pub struct HitsFile(PictureFile);

/// Arrays from this size on need the format's large sizes, bytes; below the limit of 2^32 by more than any header.
const LARGE: usize = (1 << 32) - (1 << 16);

impl HitsFile {
    /// Makes sure that the file can be written, without touching what is there.
    ///
    /// # Errors
    /// [`OutputError`] where it cannot.
    pub fn create(path: &Path) -> Result<Self, OutputError> {
        PictureFile::create(path).map(HitsFile)
    }

    /// Writes closest hits: `t` (f32, +infinity on a miss), `triangle` (u32, 0xffffffff on a miss), `u` and `v` (f32, 0
    /// on a miss) and `normal` (N x 3 f32, what [`face_normal`] makes of the triangle's corners, 0 on a miss).
    ///
    /// # Errors
    /// [`OutputError::Io`], with nothing left behind and what was there before untouched.
    pub fn save_closest(mut self, hits: &[Hit], corners: impl Fn(u32) -> [Vec3; 3] + Sync) -> Result<(), OutputError> {
        let column = |of: fn(&Hit) -> f32| hits.par_iter().map(of).collect::<Vec<f32>>();
        let normals = || {
            let normal = |hit: &Hit| {
                if hit.is_hit() {
                    face_normal(corners(hit.triangle)).to_array()
                } else {
                    [0.0; 3]
                }
            };
            hits.par_iter().map(normal).collect::<Vec<_>>()
        };
        self.0.write(|writer| {
            let mut archive = Archive(ZipWriter::new(writer));
            let t = column(|hit| if hit.is_hit() { hit.t } else { f32::INFINITY });
            archive.add("t", "<f4", None, &t)?;
            let triangles: Vec<u32> = hits.par_iter().map(|hit| hit.triangle).collect();
            archive.add("triangle", "<u4", None, &triangles)?;
            archive.add("u", "<f4", None, &column(|hit| hit.u))?;
            archive.add("v", "<f4", None, &column(|hit| hit.v))?;
            archive.add("normal", "<f4", Some(3), &normals())?;
            archive.finish()
        })?;
        self.0.publish()
    }

    /// Writes whether anything was hit: `hit` (bool).
    ///
    /// # Errors
    /// As [`HitsFile::save_closest`].
    pub fn save_any(mut self, hits: &[Hit]) -> Result<(), OutputError> {
        self.0.write(|writer| {
            let mut archive = Archive(ZipWriter::new(writer));
            let flags: Vec<bool> = hits.iter().map(Hit::is_hit).collect();
            archive.add("hit", "|b1", None, &flags)?;
            archive.finish()
        })?;
        self.0.publish()
    }
}

/// The unit normal of a triangle, on the side that sees its corners counter-clockwise; zero without an area. In f64, so
/// that no triangle that f32 holds is too small or too slender.
pub fn face_normal(corners: [Vec3; 3]) -> Vec3 {
    let [a, b, c] = corners.map(|corner| corner.as_dvec3());
    (b - a).cross(c - a).normalize_or_zero().as_vec3()
}

struct Archive<W: Write + Seek>(ZipWriter<W>);

impl<W: Write + Seek> Archive<W> {
    /// Adds `NAME.npy`: as many rows as there are elements, and where `columns` is given, so many numbers in each. The
    /// arrays are stored as they are: floating-point numbers hardly shrink, and other programs can map them.
    fn add<T: NoUninit>(&mut self, name: &str, descr: &str, columns: Option<usize>, elements: &[T]) -> io::Result<()> {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .large_file(size_of_val(elements) >= LARGE);
        self.0.start_file(format!("{name}.npy"), options)?;
        self.0.write_all(&npy_header(descr, elements.len(), columns))?;
        self.0.write_all(bytemuck::cast_slice(elements))
    }

    fn finish(self) -> io::Result<()> {
        self.0.finish()?;
        Ok(())
    }
}

/// The header of a `.npy` file (NEP 1, version 1.0): a Python dictionary, padded to a multiple of 64 bytes.
fn npy_header(descr: &str, rows: usize, columns: Option<usize>) -> Vec<u8> {
    const START: usize = 10;
    let columns = columns.map_or(String::new(), |columns| format!(" {columns}"));
    let mut text = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': ({rows},{columns}), }}");
    while !(START + text.len() + 1).is_multiple_of(64) {
        text.push(' ');
    }
    text.push('\n');
    let mut header = b"\x93NUMPY\x01\x00".to_vec();
    header.extend((text.len() as u16).to_le_bytes());
    header.extend(text.as_bytes());
    header
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;
    use std::fs::{self, File};
    use std::io::Read;
    use zip::ZipArchive;

    const CORNERS: [Vec3; 3] = [Vec3::ZERO, Vec3::X, Vec3::Y];

    fn hits() -> Vec<Hit> {
        let hit = Hit {
            t: 2.5,
            triangle: 7,
            u: 0.25,
            v: 0.5,
        };
        vec![hit, Hit::miss(1e30)]
    }

    /// Name, header and data of each array.
    fn arrays(path: &Path) -> Vec<(String, String, Vec<u8>)> {
        let mut archive = ZipArchive::new(File::open(path).unwrap()).unwrap();
        (0..archive.len())
            .map(|i| {
                let mut entry = archive.by_index(i).unwrap();
                assert_eq!(entry.compression(), CompressionMethod::Stored);
                let mut bytes = Vec::new();
                entry.read_to_end(&mut bytes).unwrap();
                assert_eq!(&bytes[..8], b"\x93NUMPY\x01\x00");
                let data = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
                assert_eq!(data % 64, 0);
                let header = String::from_utf8(bytes[10..data].to_vec()).unwrap();
                (
                    entry.name().unwrap().into_owned(),
                    header.trim_end().to_owned(),
                    bytes[data..].to_vec(),
                )
            })
            .collect()
    }

    fn floats(numbers: &[f32]) -> Vec<u8> {
        numbers.iter().flat_map(|x| x.to_le_bytes()).collect()
    }

    #[test]
    fn closest_hits() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("hits.npz");
        fs::write(&path, "old").unwrap();
        let file = HitsFile::create(&path).unwrap();
        file.save_closest(&hits(), |triangle| {
            assert_eq!(triangle, 7);
            CORNERS
        })
        .unwrap();
        let header = |descr, shape| format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': ({shape}), }}");
        let wanted = [
            ("t.npy", header("<f4", "2,"), floats(&[2.5, f32::INFINITY])),
            (
                "triangle.npy",
                header("<u4", "2,"),
                [7_u32, u32::MAX].map(u32::to_le_bytes).concat(),
            ),
            ("u.npy", header("<f4", "2,"), floats(&[0.25, 0.0])),
            ("v.npy", header("<f4", "2,"), floats(&[0.5, 0.0])),
            (
                "normal.npy",
                header("<f4", "2, 3"),
                floats(&[0.0, 0.0, 1.0, 0.0, 0.0, 0.0]),
            ),
        ];
        assert_eq!(
            arrays(&path),
            wanted.map(|(name, header, data)| (name.to_owned(), header, data))
        );
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn any_hits() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("hits.npz");
        HitsFile::create(&path).unwrap().save_any(&hits()).unwrap();
        let wanted = "{'descr': '|b1', 'fortran_order': False, 'shape': (2,), }";
        assert_eq!(arrays(&path), [("hit.npy".to_owned(), wanted.to_owned(), vec![1, 0])]);
    }

    #[test]
    fn normals_of_the_smallest_triangles() {
        let tiny = 1e-38;
        assert_eq!(face_normal(CORNERS.map(|corner| corner * tiny)), Vec3::Z);
        assert_eq!(face_normal([Vec3::ZERO, Vec3::Y, Vec3::X]), Vec3::NEG_Z);
        assert_eq!(face_normal([Vec3::ZERO, Vec3::X, vec3(2.0, 0.0, 0.0)]), Vec3::ZERO);
    }
}
