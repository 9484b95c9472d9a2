//! The sides from which a scene can be looked at.

use crate::view::Place;
use crate::viewer::grammar::unknown;
use glam::Vec3;
use oktant_shared::orbit::Up;

/// The side on which the camera stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bearing {
    /// Where a mesh's front is.
    Front,
    /// Opposite of it.
    Back,
    /// At the right hand of who looks at the front.
    Right,
    /// At the left hand.
    Left,
    /// Above; the front is below in the picture.
    Top,
    /// Below.
    Bottom,
    /// Where one of the scene's axes x, y and z leads, counted from 0, or where it comes from.
    Axis {
        /// Which.
        axis: usize,
        /// Whether it is where it comes from.
        is_negative: bool,
    },
}

/// The names of scripts.
const NAMES: [(&str, Bearing); 12] = {
    const fn axis(axis: usize, is_negative: bool) -> Bearing {
        Bearing::Axis { axis, is_negative }
    }
    [
        ("front", Bearing::Front),
        ("back", Bearing::Back),
        ("right", Bearing::Right),
        ("left", Bearing::Left),
        ("top", Bearing::Top),
        ("bottom", Bearing::Bottom),
        ("+x", axis(0, false)),
        ("-x", axis(0, true)),
        ("+y", axis(1, false)),
        ("-y", axis(1, true)),
        ("+z", axis(2, false)),
        ("-z", axis(2, true)),
    ]
};

impl Bearing {
    /// What a name means.
    pub fn parse(name: &str) -> Result<Self, String> {
        match NAMES.iter().find(|(known, _)| *known == name) {
            Some((_, bearing)) => Ok(*bearing),
            None => Err(unknown(name, "side", &NAMES.map(|(name, _)| name))),
        }
    }

    /// The unit vector towards it.
    fn direction(self, up: Up) -> Vec3 {
        let [right, above, front] = up.axes();
        match self {
            Bearing::Front => front,
            Bearing::Back => -front,
            Bearing::Right => right,
            Bearing::Left => -right,
            Bearing::Top => above,
            Bearing::Bottom => -above,
            Bearing::Axis { axis, is_negative } => {
                let along = Vec3::AXES[axis];
                if is_negative { -along } else { along }
            }
        }
    }

    /// The camera's place there, so far away.
    pub fn place(self, up: Up, distance: f32) -> Place {
        let place = Place::at(self.direction(up), 1.0, up);
        Place { distance, ..place }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_stands_where_it_says() {
        for (name, up, azimuth, elevation) in [
            ("front", Up::Y, 0.0, 0.0),
            ("front", Up::Z, 0.0, 0.0),
            ("back", Up::Y, 180.0, 0.0),
            ("right", Up::Z, 90.0, 0.0),
            ("left", Up::Y, -90.0, 0.0),
            ("top", Up::Z, 0.0, 90.0),
            ("bottom", Up::Y, 0.0, -90.0),
            ("+x", Up::Y, 90.0, 0.0),
            ("+y", Up::Y, 0.0, 90.0),
            ("+z", Up::Y, 0.0, 0.0),
            ("-z", Up::Y, 180.0, 0.0),
            ("-y", Up::Z, 0.0, 0.0),
            ("+z", Up::Z, 0.0, 90.0),
        ] {
            let place = Bearing::parse(name).unwrap().place(up, 2.5);
            let turned = (place.azimuth - azimuth).rem_euclid(360.0);
            assert!(turned.min(360.0 - turned) < 1e-4, "{name}, {up:?}: {place:?}");
            assert!((place.elevation - elevation).abs() < 1e-4, "{name}, {up:?}: {place:?}");
            assert_eq!(place.distance, 2.5);
        }
        assert!(Bearing::parse("frnt").unwrap_err().contains("did you mean \"front\""));
    }
}
