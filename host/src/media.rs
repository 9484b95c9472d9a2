//! What a point is inside of.

use crate::scene::Scene;
use glam::Vec3;
use oktant_shared::general::General;
use oktant_shared::medium::Media;
use oktant_shared::ray::Ray;
use oktant_shared::surface::Passage;
use oktant_shared::traversal::Traversal;

/// A point is inside of what it must leave, whichever of these ways it goes: more than one, because meshes have holes,
/// and none of them along an edge of a box.
const WAYS: [Vec3; 5] = [
    Vec3::new(0.36, 0.87, 0.33),
    Vec3::new(-0.71, 0.29, 0.64),
    Vec3::new(0.23, -0.61, -0.76),
    Vec3::new(0.81, 0.17, -0.56),
    Vec3::new(-0.43, -0.52, 0.74),
];

/// No mesh that makes sense has so many surfaces one behind the other.
const MOST_SURFACES: u32 = 10_000;

/// The media around a point: transmissive planes behind which it lies, and the insides of closed transmissive meshes.
pub fn media_at(scene: &Scene, point: Vec3) -> Media {
    if !scene.is_transparent() {
        return Media::AIR;
    }
    let mut left = left_on_the_way(scene, point, WAYS[0]);
    for way in &WAYS[1..] {
        let mut others = left_on_the_way(scene, point, *way);
        left.retain(|material| {
            let place = others.iter().position(|other| other == material);
            place.map(|place| others.swap_remove(place)).is_some()
        });
    }
    let planes = scene.planes.iter().take(scene.plane_count as usize);
    let behind = planes
        .filter(|plane| plane.normal.dot(point) < plane.offset)
        .map(|plane| plane.material)
        .filter(|material| scene.materials[*material as usize].is_transmissive());
    // What is left last was entered first.
    behind.chain(left.into_iter().rev()).fold(Media::AIR, Media::entered)
}

/// The materials of the meshes that a ray leaves without having entered them, the nearest first.
fn left_on_the_way(scene: &Scene, point: Vec3, way: Vec3) -> Vec<u32> {
    let world = scene.world();
    let mut ray = Ray::new(point, way);
    let (mut entered, mut left) = (Vec::new(), Vec::new());
    for _ in 0..MOST_SURFACES {
        // Whatever structure the scene has.
        let hit = General::closest_hit(&world.scene, &ray);
        if !hit.is_hit() {
            break;
        }
        let passage = Passage::new(&world, &ray, &hit);
        let material = passage.material_id;
        if scene.materials[material as usize].is_transmissive() {
            let open = entered.iter().rposition(|other| *other == material);
            match open {
                _ if passage.from_front => entered.push(material),
                Some(place) => _ = entered.remove(place),
                None => left.push(material),
            }
        }
        ray.origin = passage.origin;
    }
    left
}
