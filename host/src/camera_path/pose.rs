//! The numbers of a view that change along a path.

use crate::view::View;
use glam::{DVec3, dvec3};

/// How many there are.
pub const NUMBERS: usize = 12;

/// All of them, in the order of [`Pose::of`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose(pub [f64; NUMBERS]);

/// Between which each must stay: a curve through numbers in a range can leave it.
const RANGES: [[f64; 2]; NUMBERS] = {
    const ANGLE: [f64; 2] = [f64::MIN, f64::MAX];
    const ELEVATION: [f64; 2] = [-90.0, 90.0];
    const DISTANCE: [f64; 2] = [1e-3, 1e5];
    const OFFSET: [f64; 2] = [f64::MIN, f64::MAX];
    [
        ANGLE,
        ELEVATION,
        DISTANCE,
        [1.0, 170.0],
        DISTANCE,
        OFFSET,
        OFFSET,
        OFFSET,
        ANGLE,
        ELEVATION,
        DISTANCE,
        [-30.0, 30.0],
    ]
};

impl Pose {
    /// Those of a view.
    pub fn of(view: &View) -> Self {
        let target = view.target;
        Pose(
            [
                view.camera.azimuth,
                view.camera.elevation,
                view.camera.distance,
                view.field_of_view,
                view.seen_height(),
                target.x,
                target.y,
                target.z,
                view.light.azimuth,
                view.light.elevation,
                view.light.distance,
                view.tone.exposure,
            ]
            .map(f64::from),
        )
    }

    /// A view with these numbers, each within its range.
    pub fn applied(self, view: &View) -> View {
        let mut numbers = self.0;
        for (number, [least, greatest]) in numbers.iter_mut().zip(RANGES) {
            *number = number.clamp(least, greatest);
        }
        let [
            azimuth,
            elevation,
            distance,
            fov,
            height,
            x,
            y,
            z,
            light_azimuth,
            light_elevation,
            light_distance,
            exposure,
        ] = numbers;
        let target: DVec3 = dvec3(x, y, z);
        let mut view = *view;
        view.camera.azimuth = azimuth as f32;
        view.camera.elevation = elevation as f32;
        view.camera.distance = distance as f32;
        view.field_of_view = fov as f32;
        // One in perspective has none of its own.
        view.ortho_height = view.is_orthographic().then_some(height as f32);
        view.target = target.as_vec3();
        view.light.azimuth = light_azimuth as f32;
        view.light.elevation = light_elevation as f32;
        view.light.distance = light_distance as f32;
        view.tone.exposure = exposure as f32;
        view
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::projection::Projection;

    #[test]
    fn numbers_come_back_within_their_ranges() {
        let numbers = [720.5, 80.0, 2.0, 30.0, 4.5, 1.0, -2.0, 3.0, -400.0, -60.0, 7.0, 2.5];
        let parallel = View {
            projection: Projection::Orthographic,
            ..View::default()
        };
        let view = Pose(numbers).applied(&parallel);
        assert_eq!(Pose::of(&view).0, numbers);
        let view = Pose(numbers).applied(&View::default());
        assert_eq!(view.ortho_height, None, "perspective says how high it is");
        let far = Pose([1e3; NUMBERS].map(|number: f64| -number)).applied(&View::default());
        assert_eq!((far.camera.azimuth, far.camera.elevation), (-1000.0, -90.0));
        assert_eq!((far.camera.distance, far.field_of_view), (1e-3, 1.0));
        assert_eq!((far.light.elevation, far.tone.exposure), (-90.0, -30.0));
    }
}
