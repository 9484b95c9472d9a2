//! Large meshes and long lines: what they cost.

use std::time::Duration;

use super::{Cost, ascii, load, load_within, plain};

/// Without optimisation all is slower, and that is not what is measured.
fn seconds(seconds: u64) -> Duration {
    Duration::from_secs(if cfg!(debug_assertions) { 20 * seconds } else { seconds })
}

/// A sheet of `side` by `side` squares, cut into triangles, as large as the largest Stanford dragon for 660.
fn sheet(side: u32) -> Vec<u8> {
    let row = side + 1;
    let header = plain((row * row) as usize, (2 * side * side) as usize);
    let mut file = format!("ply\nformat binary_little_endian 1.0\n{header}end_header\n").into_bytes();
    for i in 0..row * row {
        for value in [i % row, i / row, i * i % 7] {
            file.extend((value as f32).to_le_bytes());
        }
    }
    for i in 0..side * side {
        let corner = i / side * row + i % side;
        for triangle in [[0, 1, row], [1, row + 1, row]] {
            file.push(3);
            file.extend(triangle.iter().flat_map(|step| (corner + step).to_le_bytes()));
        }
    }
    file
}

#[test]
fn a_large_mesh_is_read_in_a_second() {
    let file = sheet(660);
    let limit = Cost {
        time: seconds(1),
        bytes: 64 << 20,
    };
    let mesh = load_within(&file, limit).unwrap();
    assert_eq!(mesh.positions.len(), 661 * 661);
    assert_eq!(mesh.triangles.len(), 871_200);
    // In file order, whatever the number of threads.
    assert_eq!(mesh.positions[661 * 660].to_array()[..2], [0.0, 660.0]);
    assert_eq!(mesh.triangles[871_199], [436_259, 436_920, 436_919]);
}

#[test]
fn a_fault_in_a_large_mesh_is_the_first() {
    let mut file = sheet(300);
    let start = file.len() - 13 * 180_000;
    for face in [170_000, 20_001, 90_000] {
        file[start + 13 * face + 4] = 0xFF;
    }
    let error = load(&file).unwrap_err();
    assert!(error.contains("element face 20001 "), "{error}");
}

#[test]
fn a_line_of_ten_megabytes_is_read() {
    // ply-rs alone would need 60 bytes for each of its words.
    let corners = 3_500_000;
    let header = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                  element tristrips 1\nproperty list int int vertex_indices\n";
    let body = format!("{}{corners} {}\n", super::CORNER, "0 1 2 ".repeat(corners / 3 + 1));
    let limit = Cost {
        time: seconds(5),
        bytes: 256 << 20,
    };
    let mesh = load_within(&ascii(header, &body), limit).unwrap();
    assert_eq!(mesh.triangles.len(), corners - 2);
    assert_eq!(mesh.triangles[corners - 3], [0, 2, 1]);
}

#[test]
fn a_skipped_list_of_ten_megabytes_costs_nothing() {
    let count = 10 << 20;
    let header = plain(3, 1);
    let mut file = format!(
        "ply\nformat binary_little_endian 1.0\nelement junk 1\nproperty list int uchar bytes\n{header}end_header\n"
    )
    .into_bytes();
    file.extend((count as u32).to_le_bytes());
    file.resize(file.len() + count, 7);
    file.extend(
        [0., 0., 0., 1., 0., 0., 0., 1., 0_f32]
            .iter()
            .flat_map(|value| value.to_le_bytes()),
    );
    file.push(3);
    file.extend([0, 1, 2_u32].iter().flat_map(|corner| corner.to_le_bytes()));
    let limit = Cost {
        time: seconds(1),
        bytes: 1 << 20,
    };
    assert_eq!(load_within(&file, limit).unwrap().triangles, [[0, 1, 2]]);
}

#[test]
fn many_small_elements_cost_little() {
    // Four million faces of no corner.
    let count = 4_000_000;
    let header = plain(3, count + 1);
    let mut file = format!("ply\nformat binary_little_endian 1.0\n{header}end_header\n").into_bytes();
    file.extend(
        [0., 0., 0., 1., 0., 0., 0., 1., 0_f32]
            .iter()
            .flat_map(|value| value.to_le_bytes()),
    );
    file.resize(file.len() + count, 0);
    file.push(3);
    file.extend([0, 1, 2_u32].iter().flat_map(|corner| corner.to_le_bytes()));
    let limit = Cost {
        time: seconds(3),
        bytes: 128 << 20,
    };
    assert_eq!(load_within(&file, limit).unwrap().triangles, [[0, 1, 2]]);
}
