//! All that a ray goes through.

use crate::scene::Scene;
use oktant_shared::candidate::is_within;
use oktant_shared::entered::Entered;
use oktant_shared::general::AnyTriangle;
use oktant_shared::hit::Hit;
use oktant_shared::plane::PLANE;
use oktant_shared::ray::Ray;
use oktant_shared::triangle_test::TriangleTest;
use rayon::prelude::*;

/// Where a ray crosses triangles and planes, nearest first, of equal `t` lower ids first; triangles by their ids.
///
/// Every triangle is asked once, by itself, with the scene's triangle test. So none comes twice, as it would from the leaves of
/// an octree; and none is left out, as one would be where the ray were cast on from behind each hit: triangles that a ray meets
/// in the edge that they share have the same `t`. All of those that the test lets the ray cross there are told; with a watertight
/// one that is one at least.
pub fn crossings(scene: &Scene, ray: &Ray) -> Vec<Hit> {
    let view = scene.view();
    let entered = Entered::by_slabs(&view, ray);
    let test = AnyTriangle::prepare_in(&view, &entered.ray);
    let slots = if entered.inside { scene.ids.len() as u32 } else { 0 };
    let of_triangle = |slot: u32| {
        let crossing = test.crossing_at(&view, slot);
        is_within(crossing, &entered.ray).then(|| {
            let hit = Hit {
                t: crossing.t,
                triangle: slot,
                u: crossing.u,
                v: crossing.v,
            };
            view.identified(entered.left(ray, hit))
        })
    };
    let mut crossings: Vec<Hit> = (0..slots).into_par_iter().filter_map(of_triangle).collect();
    let planes = &scene.planes[..scene.plane_count as usize];
    crossings.extend((0..).zip(planes).filter_map(|(index, plane)| {
        let t = plane.crossing(ray);
        (t >= ray.t_min.max(0.0) && t <= ray.t_max).then_some(Hit {
            t,
            triangle: PLANE | index,
            u: 0.0,
            v: 0.0,
        })
    }));
    crossings.sort_by(|a, b| a.t.total_cmp(&b.t).then(a.triangle.cmp(&b.triangle)));
    crossings
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balls;
    use crate::mesh::Mesh;
    use crate::model::Model;
    use crate::oracle::{Oracle, OracleRay};
    use crate::progress::silent;
    use crate::structure::StructureOptions;
    use glam::{Vec3, vec3};
    use oktant_shared::parts::TraversalKind;
    use oktant_shared::plane::Plane;

    /// Squares of two triangles each across the z axis, a unit apart, the nearest at 1.
    fn panes(count: u32) -> Mesh {
        let mut mesh = Mesh::default();
        for pane in 0..count {
            let z = -1.0 - pane as f32;
            mesh.positions
                .extend([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| vec3(x, y, z)));
            let first = 4 * pane;
            mesh.triangles
                .extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        }
        mesh
    }

    fn scene(mesh: Mesh, traversal: TraversalKind, planes: Vec<Plane>) -> Scene {
        let mut model = Model::of_mesh(mesh);
        model.planes = planes;
        Scene::of_model(model, &StructureOptions::of(traversal), &silent).unwrap()
    }

    fn told(scene: &Scene, ray: &Ray) -> Vec<(u32, f32)> {
        let crossings = crossings(scene, ray);
        crossings.iter().map(|hit| (hit.triangle, hit.t)).collect()
    }

    #[test]
    fn panes_are_crossed_one_after_the_other() {
        let floor = Plane::new(Vec3::NEG_Z * 2.5, Vec3::Z, 0);
        for traversal in TraversalKind::ALL.iter().copied() {
            let scene = scene(panes(9), traversal, vec![floor]);
            let aside = Ray::new(vec3(0.5, 0.25, 0.0), Vec3::NEG_Z);
            let mut wanted: Vec<(u32, f32)> = (0..9).map(|pane| (2 * pane, 1.0 + pane as f32)).collect();
            wanted.insert(2, (PLANE, 2.5));
            assert_eq!(told(&scene, &aside), wanted, "{traversal}");
            // Through the edge that the two triangles of each pane share.
            let through = Ray::new(vec3(0.25, 0.25, 0.0), Vec3::NEG_Z);
            let both = (0..18).map(|triangle| (triangle, 1.0 + (triangle / 2) as f32));
            let mut both: Vec<(u32, f32)> = both.collect();
            both.insert(4, (PLANE, 2.5));
            assert_eq!(told(&scene, &through), both, "{traversal}");
            let limited = Ray {
                t_min: 2.0,
                t_max: 2.75,
                ..aside
            };
            assert_eq!(told(&scene, &limited), [(2, 2.0), (PLANE, 2.5)], "{traversal}");
            assert_eq!(
                told(&scene, &Ray::new(vec3(3.0, 0.0, 0.0), Vec3::NEG_Z)),
                [(PLANE, 2.5)]
            );
        }
    }

    /// Oracle: all hits in f64.
    #[test]
    fn balls_are_crossed_as_in_double_precision() {
        let mesh = balls::balls();
        let oracle = Oracle::new(&mesh);
        let (low, high) = mesh.bounds().unwrap();
        let scene = scene(mesh, TraversalKind::Octree, Vec::new());
        let mut most = 0;
        for step in 0..40 {
            let target = low.lerp(high, (step as f32 + 0.37) / 40.0);
            let origin = vec3(high.x + 1.0, target.y + 0.21, high.z + 2.0);
            let ray = Ray::new(origin, target - origin);
            let right = oracle.hits(&OracleRay::new(ray.origin, ray.direction, 0.0, ray.t_max));
            let right: Vec<u32> = right.iter().map(|hit| hit.triangle).collect();
            let found: Vec<u32> = told(&scene, &ray).into_iter().map(|(id, _)| id).collect();
            assert_eq!(found, right, "{ray:?}");
            most = most.max(found.len());
        }
        assert!(most >= 4, "{most}");
    }

    #[test]
    fn planes_alone_are_crossed() {
        let planes = [3.0, 1.0].map(|z| Plane::new(Vec3::NEG_Z * z, Vec3::Z, 0));
        let scene = scene(Mesh::default(), TraversalKind::Octants, planes.into());
        let ray = Ray::new(Vec3::ZERO, Vec3::NEG_Z);
        assert_eq!(told(&scene, &ray), [(PLANE | 1, 1.0), (PLANE, 3.0)]);
    }
}
