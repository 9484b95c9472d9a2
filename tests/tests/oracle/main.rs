//! The oracle is held against brute force with exact predicates, and its judge against tracers that are known to be
//! right, sloppy or wrong.

mod exact;
mod judge;

use glam::Vec3;
use oktant::mesh::Mesh;
use oktant_tests::meshes::{bounds, fan_64, flat_grid, icosphere, is_closed, room, soup, with_holes_fanned};
use oktant_tests::ray_classes::CellGrid;

/// The bunny of the assets: little-endian f32 vertices and triangles behind a header of one known form.
fn bunny() -> Mesh {
    let file = include_bytes!("../../../assets/bunny.ply");
    let end = file.windows(11).position(|window| window == b"end_header\n");
    let body = &file[end.expect("the asset has a PLY header") + 11..];
    let (vertices, faces) = body.split_at(34_834 * 12);
    let word = |bytes: &[u8], at: usize| [0, 1, 2, 3].map(|byte| bytes[at + byte]);
    Mesh {
        positions: vertices
            .chunks_exact(12)
            .map(|vertex| Vec3::from_array([0, 4, 8].map(|at| f32::from_le_bytes(word(vertex, at)))))
            .collect(),
        triangles: faces
            .chunks_exact(13)
            .map(|face| [1, 5, 9].map(|at| u32::from_le_bytes(word(face, at))))
            .collect(),
        ..Mesh::default()
    }
}

/// A cube of a power of two round the mesh on a grid of powers of two, as an octree might have it.
fn cells(mesh: &Mesh) -> CellGrid {
    let (low, high) = bounds(mesh);
    let size = ((high - low).max_element() * 1.001).log2().ceil().exp2() * 2.0;
    let step = size / 4.0;
    CellGrid {
        low: (low / step).floor() * step,
        size,
        depth: 8,
    }
}

fn meshes() -> [(&'static str, Mesh); 6] {
    [
        ("bunny", bunny()),
        ("64-fan", fan_64()),
        ("flat grid", flat_grid(32)),
        ("soup", soup(3_000, 1)),
        ("room", room()),
        ("icosphere", icosphere(4)),
    ]
}

#[test]
fn the_bunny_with_its_holes_fanned_is_closed() {
    let open = bunny();
    assert!(!is_closed(&open));
    let closed = with_holes_fanned(&open);
    assert!(is_closed(&closed));
    assert_eq!(closed.triangles.len() - open.triangles.len(), 223);
    println!("the bunny has {} holes", closed.positions.len() - open.positions.len());
}
