//! Any numbers, of which not even all are numbers.

use crate::everywhere::cast_everywhere;
use arbitrary::Arbitrary;
use glam::Vec3;
use oktant::grid::GridOptions;
use oktant::mesh::Mesh;
use oktant::octree::OctreeOptions;
use oktant::structure::StructureOptions;
use oktant::tree::BuildPreset;
use oktant_shared::ray::Ray;

/// A mesh that may break the rules, and rays.
#[derive(Arbitrary, Debug)]
pub struct Chaos {
    positions: Vec<[Number; 3]>,
    triangles: Vec<[u8; 3]>,
    rays: Vec<ChaosRay>,
    preset: u8,
    depth: u8,
    leaf: u8,
    density: u8,
}

#[derive(Arbitrary, Debug)]
struct ChaosRay {
    origin: [Number; 3],
    direction: [Number; 3],
    limits: Option<[Number; 2]>,
}

/// Chance hardly makes two alike.
#[derive(Arbitrary, Clone, Copy, Debug)]
enum Number {
    Any(f32),
    Whole(i8),
    Part(i16),
    Power(i8),
}

/// More take too long.
const MOST: usize = 256;

impl Chaos {
    /// What is built is within its budget, and answers are those of the mesh.
    ///
    /// # Panics
    /// Where they are not.
    pub fn check(&self) {
        let mesh = Mesh {
            positions: self.positions.iter().take(MOST).copied().map(point).collect(),
            triangles: self
                .triangles
                .iter()
                .take(MOST)
                .map(|corners| corners.map(u32::from))
                .collect(),
            ..Mesh::default()
        };
        let rays: Vec<Ray> = self.rays.iter().take(MOST / 4).map(ChaosRay::ray).collect();
        let options = StructureOptions {
            preset: [BuildPreset::Fast, BuildPreset::Balanced, BuildPreset::Quality][usize::from(self.preset % 3)],
            octree: OctreeOptions {
                depth: u32::from(self.depth) % (oktant_shared::octree::MAX_DEPTH + 1),
                leaf: (self.leaf > 0).then_some(u32::from(self.leaf)),
                ..OctreeOptions::default()
            },
            grid: GridOptions {
                density: f32::from(self.density) + 0.5,
                ..GridOptions::default()
            },
            ..StructureOptions::default()
        };
        // What cannot be built is refused.
        let _ = cast_everywhere(&mesh, &options, &rays, |parts, closest, any| {
            for ((ray, hit), any) in rays.iter().zip(closest).zip(any) {
                assert_eq!(hit.is_hit(), *any, "{parts}: {ray:?}, {hit:?}");
                let is_finite = ray.origin.is_finite() & ray.direction.is_finite();
                assert!(is_finite || !hit.is_hit(), "{parts}: {ray:?}, {hit:?}");
                if hit.is_hit() {
                    assert!(
                        (hit.triangle as usize) < mesh.triangles.len(),
                        "{parts}: {ray:?}, {hit:?}"
                    );
                    assert!(hit.t >= 0.0, "{parts}: {ray:?}, {hit:?}");
                }
            }
        });
    }
}

impl ChaosRay {
    fn ray(&self) -> Ray {
        let mut ray = Ray::new(point(self.origin), point(self.direction));
        if let Some(limits) = self.limits {
            [ray.t_min, ray.t_max] = limits.map(f32::from);
        }
        ray
    }
}

impl From<Number> for f32 {
    fn from(number: Number) -> f32 {
        match number {
            Number::Any(number) => number,
            Number::Whole(number) => f32::from(number),
            Number::Part(number) => f32::from(number) / 1024.0,
            Number::Power(exponent) => 2.0_f32.powi(i32::from(exponent)),
        }
    }
}

fn point(numbers: [Number; 3]) -> Vec3 {
    Vec3::from_array(numbers.map(f32::from))
}
