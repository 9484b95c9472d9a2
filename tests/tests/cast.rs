//! `oktant cast`: rays from files, hits into files, and how fast it went.
#![cfg(test)]

use glam::{Vec3, vec3};
use oktant::mesh_source::MeshSource;
use oktant::oracle::{Oracle, OracleRay};
use oktant::progress::silent;
use oktant_shared::ray::Ray;
use oktant_tests::program::{Run, run};
use std::fs::{self, File};
use std::io::Read;
use std::path::Path;
use tempfile::TempDir;
use zip::ZipArchive;

/// A square from (0, 0, 0) to (1, 1, 0) in two triangles, their front towards +z.
const SQUARE: [Vec3; 4] = [Vec3::ZERO, Vec3::X, vec3(1.0, 1.0, 0.0), Vec3::Y];
const HALVES: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

/// One ray at each half, from either side, and one past both.
fn rays() -> Vec<Ray> {
    vec![
        Ray::new(vec3(0.75, 0.25, 2.0), Vec3::NEG_Z),
        Ray::new(vec3(0.25, 0.5, -3.0), Vec3::Z * 2.0),
        Ray::new(vec3(1.5, 0.5, 2.0), Vec3::NEG_Z),
    ]
}

fn words(words: impl IntoIterator<Item = u32>) -> Vec<u8> {
    words.into_iter().flat_map(u32::to_le_bytes).collect()
}

fn floats(numbers: impl IntoIterator<Item = f32>) -> Vec<u8> {
    numbers.into_iter().flat_map(f32::to_le_bytes).collect()
}

fn npy(rays: &[Ray]) -> Vec<u8> {
    let dictionary = format!(
        "{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, 6), }}\n",
        rays.len()
    );
    let mut file = b"\x93NUMPY\x01\x00".to_vec();
    file.extend((dictionary.len() as u16).to_le_bytes());
    file.extend(dictionary.bytes());
    for ray in rays {
        let numbers = [ray.origin, ray.direction].map(|vector| vector.to_array());
        file.extend(numbers.as_flattened().iter().flat_map(|&x| f64::from(x).to_le_bytes()));
    }
    file
}

fn records(rays: &[Ray], query: u32) -> Vec<u8> {
    let mut file = b"PRAY".to_vec();
    file.extend(words([1, rays.len() as u32, query]));
    for ray in rays {
        file.extend(floats(ray.origin.to_array()));
        file.extend(floats([ray.t_min]));
        file.extend(floats(ray.direction.to_array()));
        file.extend(floats([ray.t_max]));
    }
    file
}

fn columns(rays: &[Ray], query: u32) -> Vec<u8> {
    let mut file = b"RAY1".to_vec();
    file.extend(words([rays.len() as u32, query, 0, 0, 0, 0, 0]));
    rays.iter().for_each(|ray| file.extend(floats(ray.origin.to_array())));
    rays.iter()
        .for_each(|ray| file.extend(floats(ray.direction.to_array())));
    rays.iter().for_each(|ray| file.extend(floats([ray.t_max])));
    file.resize(file.len() + 16 * rays.len(), 0);
    file
}

/// A folder with the square in every format, and the rays in every format.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| fs::write(folder.path().join(name), bytes).unwrap();
    let mut ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
                   element face 2\nproperty list uchar int vertex_indices\nend_header\n"
        .to_owned();
    for corner in SQUARE {
        ply += &format!("{} {} {}\n", corner.x, corner.y, corner.z);
    }
    for [a, b, c] in HALVES {
        ply += &format!("3 {a} {b} {c}\n");
    }
    write("square.ply", ply.as_bytes());
    let corners = HALVES
        .as_flattened()
        .iter()
        .flat_map(|&i| SQUARE[i as usize].to_array());
    let tris = [b"PTRI".to_vec(), words([1, 2, 0]), floats(corners)].concat();
    write("square.tris", &tris);
    let positions = floats(SQUARE.iter().flat_map(|corner| corner.to_array()));
    let msh = [
        b"MSH1".to_vec(),
        words([4, 2]),
        positions,
        words(HALVES.into_iter().flatten()),
    ]
    .concat();
    write("square.msh", &msh);
    write("rays.npy", &npy(&rays()));
    write("closest.rays", &records(&rays(), 0));
    write("any.rays", &records(&rays(), 1));
    write("closest.ray", &columns(&rays(), 0));
    write("any.ray", &columns(&rays(), 1));
    write("none.npy", &npy(&[]));
    folder
}

/// The data of an array in an archive, after checking its type and shape.
fn array(folder: &Path, archive: &str, name: &str, descr: &str, shape: &str) -> Vec<u8> {
    let mut archive = ZipArchive::new(File::open(folder.join(archive)).unwrap()).unwrap();
    let mut bytes = Vec::new();
    let mut entry = archive.by_name(&format!("{name}.npy")).unwrap();
    entry.read_to_end(&mut bytes).unwrap();
    assert_eq!(&bytes[..8], b"\x93NUMPY\x01\x00");
    let data = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let header = str::from_utf8(&bytes[10..data]).unwrap();
    let wanted = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': ({shape}), }}");
    assert_eq!(header.trim_end(), wanted);
    bytes[data..].to_vec()
}

/// How many arrays an archive has.
fn arrays(folder: &Path, archive: &str) -> usize {
    ZipArchive::new(File::open(folder.join(archive)).unwrap())
        .unwrap()
        .len()
}

fn cast(folder: &Path, arguments: &[&str]) -> Run {
    run(folder, [&["cast"], arguments, &["--backend", "cpu"]].concat())
}

fn succeeded(folder: &Path, arguments: &[&str]) -> Run {
    let run = cast(folder, arguments);
    assert_eq!(run.code, Some(0), "{arguments:?}: {}", run.error);
    run
}

#[test]
fn every_mesh_and_every_file_of_rays_gives_the_same_hits() {
    let folder = folder();
    let folder = folder.path();
    for mesh in ["square.ply", "square.tris", "square.msh"] {
        for rays in ["rays.npy", "closest.rays", "closest.ray"] {
            let told = succeeded(folder, &[mesh, rays, "-o", "hits.npz"]);
            assert!(told.error.contains("hits.npz: 3 rays, 2 hits"), "{}", told.error);
            assert_eq!(told.output, "");
            let t = array(folder, "hits.npz", "t", "<f4", "3,");
            assert_eq!(t, floats([2.0, 1.5, f32::INFINITY]), "{mesh} {rays}");
            assert_eq!(
                array(folder, "hits.npz", "triangle", "<u4", "3,"),
                words([0, 1, u32::MAX])
            );
            // By the second and third corner: of (0.75, 0.25) in triangle 0, of (0.25, 0.5) in triangle 1.
            assert_eq!(array(folder, "hits.npz", "u", "<f4", "3,"), floats([0.5, 0.25, 0.0]));
            assert_eq!(array(folder, "hits.npz", "v", "<f4", "3,"), floats([0.25, 0.25, 0.0]));
            // As wound, whichever side was hit.
            let normals = floats([0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
            assert_eq!(array(folder, "hits.npz", "normal", "<f4", "3, 3"), normals);
        }
    }
}

#[test]
fn any_hit_is_asked_for_by_the_file_or_by_the_command() {
    let folder = folder();
    let folder = folder.path();
    for arguments in [
        &["square.ply", "any.rays"][..],
        &["square.ply", "any.ray"],
        &["square.ply", "rays.npy", "--any"],
        &["square.ply", "closest.rays", "--any"],
    ] {
        succeeded(folder, &[arguments, &["-o", "hits.npz"]].concat());
        assert_eq!(arrays(folder, "hits.npz"), 1, "{arguments:?}");
        assert_eq!(array(folder, "hits.npz", "hit", "|b1", "3,"), [1, 1, 0]);
    }
    succeeded(folder, &["square.ply", "any.rays", "--closest", "-o", "hits.npz"]);
    assert_eq!(arrays(folder, "hits.npz"), 5);
}

#[test]
fn no_rays_give_empty_arrays() {
    let folder = folder();
    let folder = folder.path();
    succeeded(folder, &["square.ply", "none.npy", "-o", "hits.npz"]);
    assert_eq!(array(folder, "hits.npz", "t", "<f4", "0,"), Vec::<u8>::new());
    assert_eq!(array(folder, "hits.npz", "normal", "<f4", "0, 3"), Vec::<u8>::new());
}

/// Every ray of a fan from outside and of one from inside, against the oracle.
#[test]
fn hits_on_the_bunny_are_those_of_the_oracle() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let mesh = MeshSource::Bunny.load(&silent).unwrap();
    let oracle = Oracle::new(&mesh);
    let (low, high) = mesh.bounds().unwrap();
    let (center, size) = ((low + high) / 2.0, (high - low).length());
    let rays: Vec<Ray> = (0..20_000)
        .map(|i| {
            let part = |step: f32| (i as f32 * step).fract() - 0.5;
            let aim = center + vec3(part(0.618_034), part(0.754_878), part(0.569_84)) * size;
            let eye = if i % 2 == 0 {
                center + vec3(0.3, 0.4, 2.0) * size
            } else {
                center
            };
            Ray::new(eye, aim - eye)
        })
        .collect();
    fs::write(folder.join("bunny.rays"), records(&rays, 0)).unwrap();
    succeeded(folder, &["bunny", "bunny.rays", "-o", "hits.npz"]);
    let t = array(folder, "hits.npz", "t", "<f4", "20000,");
    let normal = array(folder, "hits.npz", "normal", "<f4", "20000, 3");
    let number = |bytes: &[u8], i: usize| f32::from_le_bytes([0, 1, 2, 3].map(|byte| bytes[4 * i + byte]));
    let mut hits = 0;
    for (i, ray) in rays.iter().enumerate() {
        let wanted = oracle.closest(&OracleRay::new(ray.origin, ray.direction, 0.0, f32::INFINITY));
        let found = number(&t, i);
        let length = (0..3).map(|axis| number(&normal, 3 * i + axis).powi(2)).sum::<f32>();
        match wanted {
            Some(hit) => {
                hits += 1;
                assert!(
                    (f64::from(found) / hit.t - 1.0).abs() < 1e-4,
                    "ray {i}: {found}, {}",
                    hit.t
                );
                assert!((length - 1.0).abs() < 1e-5, "ray {i}");
            }
            None => assert_eq!((found, length), (f32::INFINITY, 0.0), "ray {i}"),
        }
    }
    assert!((4_000..16_000).contains(&hits), "{hits}");
}

/// A mesh far from the origin is moved when it is read, and so are the rays.
#[test]
fn rays_far_from_the_origin_hit_what_is_there() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n\
               element face 1\nproperty list uchar int vertex_indices\nend_header\n\
               5000000 5000000 0\n5000001 5000000 0\n5000000 5000001 0\n3 0 1 2\n";
    fs::write(folder.join("far.ply"), ply).unwrap();
    let mut file = npy(&[Ray::new(Vec3::ZERO, Vec3::NEG_Z)]);
    let data = file.len() - 48;
    for (i, x) in [5_000_000.375_f64, 5_000_000.125, 1.0].into_iter().enumerate() {
        file[data + 8 * i..data + 8 * i + 8].copy_from_slice(&x.to_le_bytes());
    }
    fs::write(folder.join("rays.npy"), file).unwrap();
    succeeded(folder, &["far.ply", "rays.npy", "-o", "hits.npz"]);
    assert_eq!(array(folder, "hits.npz", "t", "<f4", "1,"), floats([1.0]));
    assert_eq!(array(folder, "hits.npz", "u", "<f4", "1,"), floats([0.375]));
    assert_eq!(array(folder, "hits.npz", "v", "<f4", "1,"), floats([0.125]));
}

fn is_report(text: &str, query: &str, repeats: u64) {
    let report: serde_json::Value = serde_json::from_str(text).expect("one JSON object");
    assert_eq!((&report["rays"], &report["query"]), (&3.into(), &query.into()));
    assert_eq!(report["repeats"], repeats);
    assert_eq!(report["parts"]["triangle"], "watertight");
    assert!(report["backend"].is_string());
    for name in ["mrays_per_second", "milliseconds"] {
        let [least, median, greatest] =
            ["least", "median", "greatest"].map(|which| report[name][which].as_f64().expect("a number"));
        assert!(0.0 < least && least <= median && median <= greatest, "{text}");
    }
    let product =
        report["mrays_per_second"]["least"].as_f64().unwrap() * report["milliseconds"]["greatest"].as_f64().unwrap();
    assert!((product * 1e3 - 3.0).abs() < 1e-6, "{text}");
}

#[test]
fn times_are_printed_as_json() {
    let folder = folder();
    let folder = folder.path();
    let timed = succeeded(folder, &["square.ply", "rays.npy", "--repeat", "5"]);
    is_report(&timed.output, "closest", 5);
    assert!(!folder.join("hits.npz").exists());
    let both = succeeded(folder, &["square.ply", "any.ray", "--repeat", "1", "-o", "hits.npz"]);
    is_report(&both.output, "any", 1);
    assert!(folder.join("hits.npz").exists());
}

#[test]
fn what_cannot_be_done_is_refused_in_a_sentence() {
    let folder = folder();
    let folder = folder.path();
    fs::write(folder.join("short.rays"), &records(&rays(), 0)[..60]).unwrap();
    fs::write(folder.join("short.tris"), b"PTRI\x01\0\0\0\xff\xff\0\0\0\0\0\0").unwrap();
    fs::write(
        folder.join("plane.toml"),
        "[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\n[[sphere]]\n",
    )
    .unwrap();
    fs::write(folder.join("hits.npz"), "the old one").unwrap();
    let before = fs::read_dir(folder).unwrap().count();
    for (arguments, code, words) in [
        (&["square.ply"][..], 2, "RAYS"),
        (&["square.ply", "rays.npy"], 2, "--output"),
        (
            &["square.ply", "rays.npy", "-o", "hits.npz", "--any", "--closest"],
            2,
            "--closest",
        ),
        (
            &["square.ply", "rays.npy", "-o", "hits.npz", "--repeat", "0"],
            2,
            "--repeat",
        ),
        (&["square.ply", "none.npy", "--repeat", "3"], 1, "no rays to time"),
        (
            &["square.ply", "missing.npy", "-o", "hits.npz"],
            1,
            "missing.npy: there is no such file",
        ),
        (
            &["square.ply", "short.rays", "-o", "hits.npz"],
            1,
            "short.rays: the file is cut short",
        ),
        (
            &["square.ply", "square.ply", "-o", "hits.npz"],
            1,
            "square.ply: this is no file of rays",
        ),
        (&["missing.ply", "rays.npy", "-o", "hits.npz"], 1, "missing.ply"),
        (
            &["short.tris", "rays.npy", "-o", "hits.npz"],
            1,
            "short.tris: the file is cut short",
        ),
        (&["plane.toml", "rays.npy", "-o", "hits.npz"], 1, "planes"),
        (&["square.ply", "rays.npy", "-o", "nowhere/hits.npz"], 1, "nowhere"),
    ] {
        let failed = cast(folder, arguments);
        assert_eq!(failed.code, Some(code), "{arguments:?}: {}", failed.error);
        assert!(failed.error.contains(words), "{arguments:?}: {}", failed.error);
        assert!(!failed.error.contains("panicked") && failed.output.is_empty());
        if code == 1 {
            assert_eq!(failed.error.trim_end().lines().count(), 1, "{}", failed.error);
        }
    }
    assert_eq!(fs::read_to_string(folder.join("hits.npz")).unwrap(), "the old one");
    assert_eq!(fs::read_dir(folder).unwrap().count(), before);
}

#[test]
fn rays_that_can_hit_nothing_are_told() {
    let folder = folder();
    let folder = folder.path();
    let mut rays = rays();
    rays[0].direction = Vec3::ZERO;
    rays[1].origin.x = f32::NAN;
    fs::write(folder.join("bad.rays"), records(&rays, 0)).unwrap();
    let told = succeeded(folder, &["square.ply", "bad.rays", "-o", "hits.npz"]);
    assert!(told.error.contains("2 rays can hit nothing"), "{}", told.error);
    assert_eq!(array(folder, "hits.npz", "triangle", "<u4", "3,"), words([u32::MAX; 3]));
}

#[test]
#[ignore = "needs a Vulkan driver; lavapipe will do"]
fn the_gpu_writes_the_same_hits() {
    let folder = folder();
    let folder = folder.path();
    let gpu = run(
        folder,
        [
            "cast",
            "square.ply",
            "rays.npy",
            "-o",
            "gpu.npz",
            "--repeat",
            "3",
            "--backend",
            "gpu",
        ],
    );
    assert_eq!(gpu.code, Some(0), "{}", gpu.error);
    is_report(&gpu.output, "closest", 3);
    succeeded(folder, &["square.ply", "rays.npy", "-o", "cpu.npz"]);
    assert_eq!(
        fs::read(folder.join("gpu.npz")).unwrap(),
        fs::read(folder.join("cpu.npz")).unwrap()
    );
}
