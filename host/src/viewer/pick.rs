//! What is under the pointer.

use crate::scene::Scene;
use crate::view::View;
use oktant_shared::general::General;
use oktant_shared::hit::Hit;
use oktant_shared::plane::PLANE;
use oktant_shared::trace::closest_hit;
use oktant_shared::variant::EVERYTHING;

/// What one eye sees at a place in a window of that size, physical pixels; none where there is nothing.
fn hit_at(scene: &Scene, view: &View, size: [u32; 2], [x, y]: [f64; 2]) -> Option<Hit> {
    let view = View { stereo: None, ..*view };
    let frame = view.frame(scene, size[0], size[1]);
    let ray = frame.camera.ray(x as f32, y as f32, 0.0);
    let hit = closest_hit::<General, EVERYTHING>(&frame, &scene.world(), &ray);
    hit.is_hit().then_some(hit)
}

/// How far away is what one eye sees in the middle of a window of that size, along the line of sight, scene units; none
/// where there is nothing.
pub fn depth_at(scene: &Scene, view: &View, size: [u32; 2]) -> Option<f32> {
    let size = size.map(|pixels| pixels.max(1));
    hit_at(scene, view, size, size.map(|pixels| f64::from(pixels) / 2.0)).map(|hit| hit.t)
}

/// The material of what one eye sees at a place in a window of that size, physical pixels; none where there is nothing.
pub fn material_at(scene: &Scene, view: &View, size: [u32; 2], at: [f64; 2]) -> Option<usize> {
    let hit = hit_at(scene, view, size, at)?;
    if hit.triangle & PLANE != 0 {
        return Some(scene.planes[(hit.triangle & !PLANE) as usize].material as usize);
    }
    // Where all triangles have the first one, none needs to be told.
    let has_ids = scene.material_ids.len() == scene.ids.len();
    Some(if has_ids {
        scene.material_ids[hit.triangle as usize] as usize
    } else {
        0
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balls::balls;
    use crate::model::{Model, plain_material};
    use crate::progress::silent;
    use crate::structure::StructureOptions;
    use glam::Vec3;
    use oktant_shared::parts::TraversalKind;
    use oktant_shared::plane::Plane;

    #[test]
    fn what_is_seen_is_picked() {
        for traversal in [TraversalKind::Octants, TraversalKind::Bvh2, TraversalKind::Compact] {
            let mut model = Model::of_mesh(balls());
            let (low, _) = model.mesh.bounds().unwrap();
            model.materials.push(plain_material());
            model.planes = vec![Plane::new(Vec3::Y * low.y, Vec3::Y, 1)];
            let scene = Scene::of_model(model, &StructureOptions::of(traversal), &silent).unwrap();
            let view = View::default();
            let at = |x, y| material_at(&scene, &view, [640, 480], [x, y]);
            assert_eq!(at(320.0, 240.0), Some(0), "{traversal}: a ball");
            assert_eq!(at(320.0, 479.0), Some(1), "{traversal}: the floor before them");
            assert_eq!(at(320.0, 0.0), None, "{traversal}: above the horizon");
            let depth = depth_at(&scene, &view, [640, 480]).unwrap();
            let far = view.camera.distance * scene.focus.radius;
            assert!(
                depth < far && depth > 0.5 * far,
                "{traversal}: the middle ball is {depth} away"
            );
            let mut above = view;
            above.camera.elevation = 0.0;
            above.target = Vec3::Y * 50.0;
            assert_eq!(
                depth_at(&scene, &above, [640, 480]),
                None,
                "{traversal}: it looks over all"
            );
            let plain = Scene::new(&balls(), &StructureOptions::of(traversal), &silent).unwrap();
            assert_eq!(material_at(&plain, &view, [640, 480], [320.0, 240.0]), Some(0));
        }
    }
}
