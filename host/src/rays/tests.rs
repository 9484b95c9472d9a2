//! Every format, whole and broken.

use super::*;
use crate::progress::silent;
use glam::{Vec3, dvec3, vec3};
use std::fs;

/// Rays whose numbers are all different, and exact in f32.
fn wanted(count: u32, limited: bool) -> Vec<Ray> {
    (0..count)
        .map(|i| Ray {
            origin: vec3(0.5, 1.5, 2.5) + i as f32,
            t_min: if limited { i as f32 + 0.125 } else { 0.0 },
            direction: vec3(-0.25, 7.0, 9.75) - i as f32,
            t_max: if limited { i as f32 + 100.0 } else { f32::INFINITY },
        })
        .collect()
}

fn row(ray: &Ray, columns: usize) -> Vec<f64> {
    let ([ox, oy, oz], [dx, dy, dz]) = (ray.origin.to_array(), ray.direction.to_array());
    let numbers = [ox, oy, oz, dx, dy, dz, ray.t_min, ray.t_max];
    numbers[..columns].iter().map(|&x| f64::from(x)).collect()
}

fn npy(version: u8, dictionary: &str, numbers: &[u8]) -> Vec<u8> {
    let mut file = b"\x93NUMPY".to_vec();
    file.extend([version, 0]);
    match version {
        1 => file.extend((dictionary.len() as u16).to_le_bytes()),
        _ => file.extend((dictionary.len() as u32).to_le_bytes()),
    }
    file.extend(dictionary.as_bytes());
    file.extend(numbers);
    file
}

fn array(rays: &[Ray], columns: usize, descr: &str, is_fortran: bool) -> Vec<u8> {
    let rows: Vec<_> = rays.iter().map(|ray| row(ray, columns)).collect();
    let numbers: Vec<f64> = if is_fortran {
        (0..columns)
            .flat_map(|column| rows.iter().map(move |row| row[column]))
            .collect()
    } else {
        rows.concat()
    };
    let bytes = |x: f64| match descr {
        "<f4" => (x as f32).to_le_bytes().to_vec(),
        ">f4" => (x as f32).to_be_bytes().to_vec(),
        "<f8" => x.to_le_bytes().to_vec(),
        _ => x.to_be_bytes().to_vec(),
    };
    let order = if is_fortran { "True" } else { "False" };
    let dictionary = format!(
        "{{'descr': '{descr}', 'fortran_order': {order}, 'shape': ({}, {columns}), }}\n",
        rays.len()
    );
    let numbers: Vec<u8> = numbers.into_iter().flat_map(bytes).collect();
    npy(if is_fortran { 2 } else { 1 }, &dictionary, &numbers)
}

fn records(rays: &[Ray], query: u32) -> Vec<u8> {
    let mut file = b"PRAY".to_vec();
    for word in [1, rays.len() as u32, query] {
        file.extend(word.to_le_bytes());
    }
    file.extend(bytemuck::cast_slice(rays));
    file
}

fn columns(rays: &[Ray], query: u32) -> Vec<u8> {
    let mut file = b"RAY1".to_vec();
    for word in [rays.len() as u32, query, 2, 3, 0, 0, 0] {
        file.extend(word.to_le_bytes());
    }
    let mut put = |numbers: &[f32]| file.extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
    rays.iter().for_each(|ray| put(&ray.origin.to_array()));
    rays.iter().for_each(|ray| put(&ray.direction.to_array()));
    rays.iter().for_each(|ray| put(&[ray.t_max]));
    file.resize(file.len() + rays.len() * 16, 7);
    file
}

fn read_shifted(file: &[u8], shift: DVec3) -> Result<(Option<Query>, Vec<Ray>), String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rays");
    fs::write(&path, file).unwrap();
    let read = || {
        let file = RayFile::open(&path)?;
        let (query, count) = (file.query(), file.count());
        let rays = file.read(shift, &silent)?;
        assert_eq!(rays.len() as u64, count);
        Ok((query, rays))
    };
    read().map_err(|error: RaysError| error.to_string())
}

fn read(file: &[u8]) -> Result<(Option<Query>, Vec<Ray>), String> {
    read_shifted(file, DVec3::ZERO)
}

#[test]
fn arrays_of_numpy() {
    for descr in ["<f4", ">f4", "<f8", ">f8"] {
        for is_fortran in [false, true] {
            for width in [6, 8] {
                for count in [0, 1, 5] {
                    let wanted = wanted(count, width == 8);
                    let file = array(&wanted, width, descr, is_fortran);
                    assert_eq!(read(&file), Ok((None, wanted)), "{descr} {is_fortran} {width}");
                }
            }
        }
    }
}

/// A row may lie in two pieces of what is read at a time.
#[test]
fn arrays_longer_than_a_piece() {
    let wanted = wanted(200_003, false);
    for is_fortran in [false, true] {
        assert_eq!(read(&array(&wanted, 6, "<f8", is_fortran)), Ok((None, wanted.clone())));
    }
}

#[test]
fn files_that_say_what_they_ask_for() {
    let limited = wanted(5, true);
    assert_eq!(read(&records(&limited, 0)), Ok((Some(Query::Closest), limited.clone())));
    assert_eq!(read(&records(&limited, 1)), Ok((Some(Query::Any), limited.clone())));
    let from_zero: Vec<_> = limited.iter().map(|ray| Ray { t_min: 0.0, ..*ray }).collect();
    assert_eq!(
        read(&columns(&limited, 0)),
        Ok((Some(Query::Closest), from_zero.clone()))
    );
    assert_eq!(read(&columns(&limited, 1)), Ok((Some(Query::Any), from_zero)));
}

/// Near (10^6, 0, 0), f32 has steps of 1/16; f64 origins lose nothing to them where they are shifted first.
#[test]
fn origins_are_shifted_before_they_are_rounded() {
    let shift = dvec3(1e6, 0.0, -2.0);
    let numbers: Vec<u8> = [1e6 + 0.015_625, 1.0, -2.0, 0.0, 1.0, 0.0]
        .iter()
        .flat_map(|x: &f64| x.to_le_bytes())
        .collect();
    let dictionary = "{'descr': '<f8', 'fortran_order': False, 'shape': (1, 6), }";
    let (_, rays) = read_shifted(&npy(1, dictionary, &numbers), shift).unwrap();
    assert_eq!(rays[0].origin, vec3(0.015_625, 1.0, 0.0));
    assert_eq!(rays[0].direction, Vec3::Y);
    for file in [records, columns] {
        let far = Ray::new(vec3(1e6 + 0.5, 1.0, -2.0), Vec3::Y);
        let (_, rays) = read_shifted(&file(&[far], 0), shift).unwrap();
        assert_eq!(rays[0].origin, vec3(0.5, 1.0, 0.0));
    }
}

#[test]
fn files_that_are_cut_short() {
    let rays = wanted(3, true);
    for file in [
        records(&rays, 0),
        columns(&rays, 1),
        array(&rays, 8, "<f4", false),
        array(&rays, 6, ">f8", true),
    ] {
        for length in 0..file.len() {
            let error = read(&file[..length]).unwrap_err();
            assert!(error.contains("rays: "), "{error}");
            let says_what_to_do = ["again", "save"].iter().any(|words| error.contains(words));
            assert!(says_what_to_do, "{length} bytes: {error}");
        }
    }
}

/// A header may claim any number of rays; memory is taken for those that are there.
#[test]
fn headers_that_promise_too_much() {
    let mut file = records(&wanted(3, true), 0);
    file[8..12].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(
        read(&file)
            .unwrap_err()
            .contains("promises 137438953456 bytes and it has 112")
    );
    let mut file = columns(&wanted(3, true), 0);
    file[4..8].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(read(&file).unwrap_err().contains("cut short"));
    for count in ["4294967296", "1000000000000000000", "18446744073709551615"] {
        let dictionary = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({count}, 8), }}");
        assert!(read(&npy(1, &dictionary, &[0; 64])).unwrap_err().contains("cut short"));
    }
    let mut file = npy(2, "{", &[]);
    file[8..12].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(read(&file).unwrap_err().contains("has 4294967295 bytes"));
}

#[test]
fn files_that_are_something_else() {
    let dictionary = |descr: &str, shape: &str| {
        let text = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}");
        npy(1, &text, &[0; 1024])
    };
    let mut version = records(&[], 0);
    version[4] = 2;
    for (file, words) in [
        (b"ply\nformat ascii 1.0\n".to_vec(), "no file of rays"),
        (b"\x93NUMBER.....".to_vec(), "no file of rays"),
        (b"PK\x03\x04......".to_vec(), "numpy.savez"),
        (dictionary("<f2", "(3, 6)"), "<f2"),
        (dictionary("<i8", "(3, 6)"), "astype"),
        (dictionary("|O", "(3, 6)"), "float32"),
        (dictionary("<f4", "(18,)"), "shape (18)"),
        (dictionary("<f4", "(3, 7)"), "shape (3, 7)"),
        (dictionary("<f4", "()"), "shape ()"),
        (dictionary("<f4", "(1, 3, 6)"), "row for each ray"),
        (npy(4, "{}", &[]), "version 4"),
        (npy(1, "\u{1}{}", &[]), "makes no sense"),
        (version, "version 2"),
        (records(&[], 2), "query 2"),
        (columns(&[], 3), "query 3"),
    ] {
        let error = read(&file).unwrap_err();
        assert!(error.contains(words), "{error}");
    }
}

#[test]
fn paths_that_are_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let error = |path: &Path| RayFile::open(path).unwrap_err().to_string();
    assert!(error(&folder.path().join("none.npy")).ends_with("none.npy: there is no such file; check the path"));
    assert!(error(folder.path()).contains("directory"));
    #[cfg(target_os = "linux")]
    assert!(error(Path::new("/dev/zero")).contains("no file of rays"));
    #[cfg(target_os = "linux")]
    assert!(error(Path::new("/dev/null")).contains("empty"));
}
