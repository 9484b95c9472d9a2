//! Cells of a structure as boxes of lines over a picture.

mod layer;
mod projection;
mod selection;

pub use layer::Layer;
pub(crate) use selection::visited;
pub use selection::{Chosen, MOST, Selection};

use crate::scene::Scene;
use crate::trace::Cell;
use glam::Vec3;
use oktant_shared::frame::Frame;
use projection::{Projection, Segment};

/// Colours by level, sRGB-encoded: those of M. Okabe and K. Ito (2008) that stand out from dark and bright pictures.
const COLORS: [[u8; 3]; 6] = [
    [86, 180, 233],
    [230, 159, 0],
    [0, 200, 140],
    [240, 228, 66],
    [213, 94, 0],
    [224, 130, 190],
];
/// Opacity of the nearest lines and of the farthest.
const OPACITIES: [f32; 2] = [255.0, 70.0];

/// The boxes of some cells as the camera of a frame sees them, from the middle between two eyes. Lines are not hidden by what
/// is before them, but fade with their distance.
pub fn drawn(cells: &[Cell], frame: &Frame) -> Layer {
    let size = [frame.camera.width, frame.camera.height];
    let projection = Projection::new(&frame.camera);
    let segments: Vec<(u32, Segment)> = cells
        .iter()
        .flat_map(|cell| edges(cell).map(|edge| (cell.depth, projection.segment(edge))))
        .filter_map(|(level, segment)| Some((level, segment?)))
        .collect();
    let depths = || segments.iter().map(|(_, segment)| segment.depth);
    let (near, far) = (depths().fold(f32::INFINITY, f32::min), depths().fold(0.0, f32::max));
    let mut layer = Layer::clear(size);
    for (level, segment) in &segments {
        let place = if far > near {
            (segment.depth - near) / (far - near)
        } else {
            0.0
        };
        let opacity = OPACITIES[0] + place * (OPACITIES[1] - OPACITIES[0]);
        layer.line(segment.ends, COLORS[*level as usize % COLORS.len()], opacity as u8);
    }
    layer
}

/// The twelve edges of a box.
fn edges(cell: &Cell) -> [[Vec3; 2]; 12] {
    let corner = |corner: usize| {
        let sides = [cell.low, cell.high];
        Vec3::from_array([0, 1, 2].map(|axis| sides[corner >> axis & 1][axis]))
    };
    std::array::from_fn(|edge| {
        let (axis, place) = (edge / 4, edge % 4);
        let low_bits = place & ((1 << axis) - 1);
        let from = (place - low_bits) << 1 | low_bits;
        [corner(from), corner(from | 1 << axis)]
    })
}

/// The cells that a selection chooses, drawn, with what to say of them.
pub fn of_scene(scene: &Scene, selection: Selection, frame: &Frame) -> (Layer, Chosen) {
    let chosen = Chosen::new(scene, selection, frame);
    (drawn(&chosen.cells, frame), chosen)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balls;
    use crate::progress::silent;
    use crate::projection::Projection;
    use crate::structure::StructureOptions;
    use crate::view::View;
    use oktant_shared::parts::TraversalKind;
    use std::collections::HashSet;

    fn cell(low: Vec3, high: Vec3) -> Cell {
        Cell { low, high, depth: 1 }
    }

    #[test]
    fn a_box_has_twelve_edges_along_its_axes() {
        let edges = edges(&cell(Vec3::ZERO, Vec3::new(1.0, 2.0, 4.0)));
        let lengths: Vec<f32> = edges.iter().map(|[a, b]| (*b - *a).length()).collect();
        assert_eq!(lengths, [1.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 2.0, 4.0, 4.0, 4.0, 4.0]);
        let different: HashSet<String> = edges.iter().map(|edge| format!("{edge:?}")).collect();
        assert_eq!(different.len(), 12);
    }

    /// Oracle: the camera's own rays. Through each pixel that is drawn goes a ray that comes near to an edge.
    #[test]
    fn lines_are_where_the_camera_sees_the_edges() {
        for projection in Projection::ALL {
            let view = View {
                projection,
                ..View::default()
            };
            lines_are_seen(&view);
        }
    }

    fn lines_are_seen(view: &View) {
        let scene = Scene::new(&balls::balls(), &StructureOptions::default(), &silent).unwrap();
        let frame = view.frame(&scene, 160, 120);
        let cell = cell(scene.low, scene.high);
        let layer = drawn(&[cell], &frame);
        let mut drawn = 0;
        for (index, texel) in layer.texels.iter().enumerate().filter(|(_, texel)| **texel != 0) {
            assert_eq!(texel.to_le_bytes()[..3], COLORS[1]);
            let ray = frame
                .camera
                .ray(index as f32 % 160.0 + 0.5, (index / 160) as f32 + 0.5, 0.0);
            let nearest = edges(&cell).map(|[a, b]| distance(ray.origin, ray.direction, a, b));
            let pixel = view.seen_height() * scene.focus.radius / 120.0;
            let distance = nearest.into_iter().fold(f32::INFINITY, f32::min);
            assert!(distance < 2.0 * pixel, "pixel {index} is {distance} off");
            drawn += 1;
        }
        assert!(drawn > 300, "{drawn}");
    }

    /// Between a line and a segment, sampled.
    fn distance(origin: Vec3, direction: Vec3, a: Vec3, b: Vec3) -> f32 {
        let of = |point: Vec3| (point - origin).cross(direction.normalize()).length();
        (0..=2000)
            .map(|i| of(a.lerp(b, i as f32 / 2000.0)))
            .fold(f32::INFINITY, f32::min)
    }

    #[test]
    fn what_lies_behind_the_camera_is_not_drawn() {
        let scene = Scene::new(&balls::balls(), &StructureOptions::default(), &silent).unwrap();
        let frame = View::default().frame(&scene, 80, 60);
        let behind = frame.camera.eye - frame.camera.forward * 2.0;
        let layer = drawn(&[cell(behind - Vec3::splat(0.1), behind)], &frame);
        assert!(layer.texels.iter().all(|texel| *texel == 0));
        // Around the camera: nothing but what is in front.
        let around = cell(frame.camera.eye - Vec3::ONE, frame.camera.eye + Vec3::ONE);
        drawn(&[around], &frame);
    }

    #[test]
    fn near_lines_are_stronger_than_far_ones() {
        let scene = Scene::new(&balls::balls(), &StructureOptions::of(TraversalKind::Octree), &silent).unwrap();
        let frame = View::default().frame(&scene, 200, 150);
        let (layer, chosen) = of_scene(&scene, Selection::Level(0), &frame);
        assert_eq!(chosen.cells.len(), 1);
        let opacities: HashSet<u8> = layer.texels.iter().map(|texel| (texel >> 24) as u8).collect();
        assert!(opacities.contains(&255) && opacities.contains(&70), "{opacities:?}");
    }
}
