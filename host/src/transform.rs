//! Moving, turning and scaling meshes.

use crate::mesh::Mesh;
use glam::{DMat3, DVec3, Vec3};
use rayon::prelude::*;

/// Squares of coordinates up to this fit into 32 bits.
const FARTHEST: f32 = 1e15;

/// A mesh is refused whose size is less than this many steps between neighbouring f32 where it lies: its vertices would
/// visibly snap to them.
const LEAST_STEPS: f64 = 1000.0;

/// Why a mesh cannot be put somewhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Misplaced {
    /// A coordinate would be beyond 1e15.
    TooLarge,
    /// It would be so small against its distance from the origin that f32 cannot hold its form.
    TooFar {
        /// The centre of its bounding box there, scene units.
        center: DVec3,
        /// The longest edge of its bounding box there, scene units.
        extent: f64,
    },
}

/// A linear map, then a translation. In f64, so that meshes far from the origin can be brought near it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// Invertible.
    pub linear: DMat3,
    /// Scene units.
    pub translation: DVec3,
}

impl Transform {
    /// Changes nothing.
    pub const IDENTITY: Transform = Transform {
        linear: DMat3::IDENTITY,
        translation: DVec3::ZERO,
    };

    /// Scales along the axes, turns about the x, then the y, then the z axis (degrees, counterclockwise seen from the
    /// axis's end), and moves.
    pub fn new(scale: DVec3, degrees: DVec3, translation: DVec3) -> Self {
        let [x, y, z] = degrees.to_array().map(f64::to_radians);
        Transform {
            linear: DMat3::from_rotation_z(z)
                * DMat3::from_rotation_y(y)
                * DMat3::from_rotation_x(x)
                * DMat3::from_diagonal(scale),
            translation,
        }
    }

    /// The mesh moved there. A mirror image keeps its front outside: its triangles run the other way round.
    ///
    /// [`Mesh::shift`] is undone first, so the mesh is moved from where its file has it; f32 holds only the outcome.
    ///
    /// # Errors
    /// Why f32 cannot hold it there.
    pub fn apply(&self, mut mesh: Mesh) -> Result<Mesh, Misplaced> {
        self.check(&mesh)?;
        let shift = mesh.shift;
        mesh.positions.par_iter_mut().for_each(|position| {
            *position = self.point(*position, shift).as_vec3();
        });
        mesh.shift = DVec3::ZERO;
        if !mesh
            .positions
            .par_iter()
            .all(|position| position.abs().max_element() <= FARTHEST)
        {
            return Err(Misplaced::TooLarge);
        }
        // Normals stay perpendicular to what they are normals of.
        let normals = self.linear.inverse().transpose();
        mesh.normals.par_iter_mut().for_each(|normal| {
            *normal = (normals * normal.as_dvec3())
                .try_normalize()
                .unwrap_or_default()
                .as_vec3();
        });
        if self.linear.determinant() < 0.0 {
            mesh.triangles.par_iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        Ok(mesh)
    }

    /// Where a position of a mesh with this shift comes to lie.
    fn point(&self, position: Vec3, shift: DVec3) -> DVec3 {
        self.linear * (position.as_dvec3() + shift) + self.translation
    }

    /// Makes sure that a mesh is not too small for where it comes to lie. One that is a point has no form to lose.
    fn check(&self, mesh: &Mesh) -> Result<(), Misplaced> {
        let corner = |corner: u32| self.point(mesh.positions[corner as usize], mesh.shift);
        let nothing = || (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = mesh
            .triangles
            .as_flattened()
            .par_iter()
            .fold(nothing, |(low, high), id| {
                let position = corner(*id);
                (low.min(position), high.max(position))
            })
            .reduce(nothing, |a, b| (a.0.min(b.0), a.1.max(b.1)));
        let extent = (high - low).max_element();
        let farthest = low.abs().max(high.abs()).max_element();
        if extent >= 0.0 && farthest > f64::from(FARTHEST) {
            return Err(Misplaced::TooLarge);
        }
        if extent > 0.0 && extent < farthest * f64::from(f32::EPSILON) * LEAST_STEPS {
            let center = low.midpoint(high);
            return Err(Misplaced::TooFar { center, extent });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{dvec3, vec3};

    fn triangle() -> Mesh {
        Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            triangles: vec![[0, 1, 2]],
            normals: vec![Vec3::Z; 3],
            shift: dvec3(1e6, 0.0, 0.0),
            ..Mesh::default()
        }
    }

    #[test]
    fn a_mirror_image_keeps_its_front() {
        let mirror = Transform::new(dvec3(1.0, 1.0, -3.0), DVec3::ZERO, dvec3(-1e6, 0.0, 0.25));
        let mesh = mirror.apply(triangle()).unwrap();
        assert_eq!(
            mesh.positions,
            [vec3(0.0, 0.0, 0.25), vec3(1.0, 0.0, 0.25), vec3(0.0, 1.0, 0.25)]
        );
        assert_eq!((mesh.normals[0], mesh.triangles[0]), (Vec3::NEG_Z, [0, 2, 1]));
        assert_eq!(mesh.shift, DVec3::ZERO);
    }

    #[test]
    fn turns_are_counterclockwise_and_in_order() {
        let turned = |x, y, z| Transform::new(DVec3::ONE, dvec3(x, y, z), DVec3::ZERO).linear;
        assert!((turned(90.0, 0.0, 0.0) * DVec3::Y).abs_diff_eq(DVec3::Z, 1e-12));
        assert!((turned(0.0, 90.0, 0.0) * DVec3::Z).abs_diff_eq(DVec3::X, 1e-12));
        assert!((turned(0.0, 0.0, 90.0) * DVec3::X).abs_diff_eq(DVec3::Y, 1e-12));
        assert!((turned(90.0, 90.0, 0.0) * DVec3::Y).abs_diff_eq(DVec3::X, 1e-12));
    }

    #[test]
    fn what_would_overflow_is_refused() {
        let far = Transform::new(DVec3::splat(1e9), DVec3::ZERO, DVec3::ZERO);
        assert_eq!(far.apply(triangle()), Err(Misplaced::TooLarge));
    }

    #[test]
    fn what_lies_too_far_off_is_refused() {
        let moved = |x| Transform::new(DVec3::ONE, DVec3::ZERO, dvec3(x, 0.0, 0.0)).apply(triangle());
        let center = dvec3(1e6 + 0.5, 0.5, 0.0);
        assert_eq!(moved(0.0), Err(Misplaced::TooFar { center, extent: 1.0 }));
        assert_eq!(moved(-1e6).unwrap().positions, triangle().positions);
        assert!(moved(-1e6 + 8000.0).is_ok());
        assert!(moved(-1e6 + 9000.0).is_err());
    }
}
