//! The path of a ray through flat boundaries, in f64.

use glam::DVec3;

/// A boundary between two media.
#[derive(Clone, Copy, Debug)]
pub struct Layer {
    /// A point of it.
    pub point: DVec3,
    /// A vector across it, of any length and sign.
    pub normal: DVec3,
    /// Index of refraction before it.
    pub from: f64,
    /// Index of refraction beyond it.
    pub to: f64,
}

/// Where a ray comes out of the last of the boundaries, and its direction there, by Snell's law at each in turn.
///
/// # Panics
/// Where a boundary reflects all, or does not lie ahead.
pub fn through(mut origin: DVec3, direction: DVec3, layers: &[Layer]) -> (DVec3, DVec3) {
    let mut direction = direction.normalize();
    for layer in layers {
        let normal = layer.normal.normalize();
        let t = normal.dot(layer.point - origin) / normal.dot(direction);
        assert!(t > 0.0, "{layer:?} lies behind");
        origin += direction * t;
        let towards = if normal.dot(direction) < 0.0 { -normal } else { normal };
        let tangent = (direction - towards * towards.dot(direction)) * (layer.from / layer.to);
        assert!(tangent.length() < 1.0, "{layer:?} reflects all");
        direction = tangent + towards * (1.0 - tangent.length_squared()).sqrt();
    }
    (origin, direction)
}
