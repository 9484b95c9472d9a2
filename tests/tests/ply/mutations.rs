//! Files that a damaged disk or a careless program made: whatever their bytes, no panic and no large cost.

use std::time::Duration;

use super::{Cost, Random, load_within};

const LIMIT: Cost = Cost {
    time: Duration::from_secs(1),
    bytes: 8 << 20,
};

/// Files that between them have everything that the loader knows.
fn originals() -> Vec<Vec<u8>> {
    let ascii = "ply\nformat ascii 1.0\ncomment made by hand\nobj_info 7\nelement vertex 6\n\
                 property float x\nproperty double y\nproperty float z\nproperty float nx\n\
                 property float ny\nproperty float nz\nproperty uchar red\nproperty uchar green\n\
                 property uchar blue\nproperty uchar alpha\nproperty float s\nproperty double t\n\
                 element edge 1\nproperty int v\n\
                 element face 4\nproperty list uchar int vertex_indices\nproperty list uchar float uv\n\
                 property float r\nproperty float g\nproperty float b\n\
                 element tristrips 1\nproperty list int int vertex_indices\nend_header\n\
                 0 0 0 0 0 1 255 0 0 255 0 0\n1 0 0 0 0 1 0 255 0 255 1 0\n1.5 1e0 0 0 0 1 0 0 255 9 .5 1e-1\n\
                 0.5 1.5 0 0 0 1 1 2 3 4 0 1\n-.5 1 0 nan 0 1 5 6 7 8 nan 1\n0 0 1 0 0 0 1 1 1 1 -2 3\n8\n\
                 3 0 1 5 0 1 0 0\n5 0 1 2 3 4 2 0.5 0.5 0 1 0\n4 0 1 2 5 0 0 0 1\n2 0 1 0 1 1 1\n\
                 8 0 1 5 2 -1 3 4 5\n";
    let header = |format: &str| {
        format!(
            "ply\nformat {format} 1.0\nelement vertex 6\nproperty float x\nproperty float y\n\
             property float z\nproperty short nx\nproperty short ny\nproperty short nz\n\
             property ushort red\nproperty ushort green\nproperty ushort blue\n\
             property float texture_u\nproperty float texture_v\n\
             element user 2\nproperty list ushort double d\nproperty char c\n\
             element face 3\nproperty uchar red\nproperty list uchar int vertex_index\n\
             property uchar green\nproperty uchar blue\n\
             element tristrips 1\nproperty list uint int vertex_indices\nend_header\n"
        )
        .into_bytes()
    };
    let mut little = header("binary_little_endian");
    let mut big = header("binary_big_endian");
    let mut put = |bytes: &[u8]| {
        little.extend(bytes);
        big.extend(bytes.iter().rev());
    };
    for i in 0..6_u16 {
        for value in [f32::from(i), f32::from(i * i), f32::from(i % 2)] {
            put(&value.to_le_bytes());
        }
        for value in [0, 0, i.min(1), 1000 * i, 0, 65535] {
            put(&value.to_le_bytes());
        }
        for value in [0.25 * f32::from(i), 1.0] {
            put(&value.to_le_bytes());
        }
    }
    for length in [1_u16, 0] {
        put(&length.to_le_bytes());
        for _ in 0..length {
            put(&1.0_f64.to_le_bytes());
        }
        put(&[1]);
    }
    for face in [&[0_u32, 1, 2][..], &[0, 2, 4, 5], &[5, 4, 3, 2, 1]] {
        put(&[9]);
        put(&[face.len() as u8]);
        face.iter().for_each(|corner| put(&corner.to_le_bytes()));
        put(&[8]);
        put(&[7]);
    }
    put(&5_u32.to_le_bytes());
    [0_i32, 1, 2, -1, 3]
        .iter()
        .for_each(|corner| put(&corner.to_le_bytes()));
    vec![
        ascii.as_bytes().to_vec(),
        ascii.replace('\n', "\r\n").into_bytes(),
        little,
        big,
    ]
}

#[test]
fn originals_are_read() {
    let counts = originals()
        .iter()
        .map(|file| load_within(file, LIMIT).unwrap().triangles.len())
        .collect::<Vec<_>>();
    assert_eq!(counts, [9, 9, 7, 7]);
}

#[test]
fn truncated_files() {
    for file in originals() {
        let last = file.trim_ascii_end().len() - 1;
        for length in 0..file.len() {
            let result = load_within(&file[..length], LIMIT);
            // Only a number at the very end of a text can be cut and still be one.
            assert!(length >= last || result.is_err(), "{length} of {}", file.len());
        }
    }
}

#[test]
fn files_with_one_wrong_byte() {
    let mut random = Random(6);
    for file in originals() {
        for at in 0..file.len() {
            let replacements = [
                file[at] ^ 1,
                file[at] ^ 0x80,
                0,
                0xFF,
                b'9',
                b'-',
                b'\n',
                b' ',
                random.next() as u8,
            ];
            for replacement in replacements {
                let mut broken = file.clone();
                broken[at] = replacement;
                let _ = load_within(&broken, LIMIT);
            }
        }
    }
}

#[test]
fn files_with_bytes_left_out_or_inserted() {
    for file in originals() {
        for at in 0..file.len() {
            let mut broken = file.clone();
            broken.remove(at);
            let _ = load_within(&broken, LIMIT);
            let mut broken = file.clone();
            broken.insert(at, broken[at]);
            let _ = load_within(&broken, LIMIT);
        }
    }
}

#[test]
fn files_with_many_wrong_bytes() {
    let mut random = Random(7);
    for file in originals() {
        let body = file.windows(10).position(|w| w == b"end_header").unwrap() + 11;
        for round in 0..4000 {
            let mut broken = file.clone();
            // Of half of them only the data, so that the header does not catch all.
            let start = if round % 2 == 0 { body } else { 0 };
            for _ in 0..1 + random.below(8) {
                let at = start + random.below(broken.len() - start);
                broken[at] = random.next() as u8;
            }
            let _ = load_within(&broken, LIMIT);
        }
    }
}

#[test]
fn files_with_words_exchanged() {
    let mut random = Random(8);
    let file = String::from_utf8(originals().remove(0)).unwrap();
    let words: Vec<&str> = file.split_inclusive([' ', '\n']).collect();
    for _ in 0..8000 {
        let mut broken = words.clone();
        for _ in 0..1 + random.below(4) {
            let (to, from) = (random.below(words.len()), random.below(words.len()));
            broken[to] = words[from];
        }
        let _ = load_within(broken.concat().as_bytes(), LIMIT);
    }
}
