//! Where light comes from.

use crate::arithmetic::{max, max_component};
use crate::ray::T_MAX;
use bytemuck::{Pod, Zeroable};
use glam::Vec3;

/// [`Light::kind`]: a point.
pub const POINT: u32 = 0;
/// [`Light::kind`]: infinitely far away.
pub const DIRECTIONAL: u32 = 1;
/// [`Light::kind`]: a parallelogram that shines on the side of `edge_u x edge_v`.
pub const AREA: u32 = 2;

/// A light.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Light {
    /// Point: its place. Directional: the unit vector towards it. Area: a corner. Scene units.
    pub position: Vec3,
    /// [`POINT`], [`DIRECTIONAL`] or [`AREA`].
    pub kind: u32,
    /// Colour times strength, linear RGB, 0 and up. Where the light falls off, what arrives at distance 1.
    pub color: Vec3,
    /// 0: no falloff with the distance. Above: falls off with its square, counted as at least this, scene units.
    pub falloff_radius: f32,
    /// Area: one edge from the corner, scene units.
    pub edge_u: Vec3,
    /// Area: samples along each edge, 1 and up; they form a regular grid.
    pub samples_per_side: u32,
    /// Area: the other edge from the corner, scene units.
    pub edge_v: Vec3,
    /// 0: it has no end. Above: it fades out at this distance, scene units, by `1 - (distance / range)^4`, as glTF has it
    /// (KHR_lights_punctual); what is farther off asks nothing about it. Not of directional ones.
    pub range: f32,
}

const _: () = assert!(size_of::<Light>() == 64);

/// Light on its way to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Incident {
    /// From the point towards the light, scene units.
    pub direction: Vec3,
    /// How far it must see, in lengths of `direction`: to just before the light, so that a surface on which the light lies
    /// does not hide it.
    pub reach: f32,
    /// What would arrive if nothing stood between, linear RGB.
    pub color: Vec3,
}

/// Of the coordinates of a light and of a point, of their distance and of the largest triangle, what the roundings of the
/// direction, of a surface on which the light lies, and of its `t` can amount to: sixteen times 2^-24.
const REACH_ERROR: f32 = 16.0 / (1 << 24) as f32;

/// How far of the way to the light nothing must be in between, 0 to 1, in a scene of that extent.
#[inline]
fn reach(point: Vec3, direction: Vec3, extent: f32) -> f32 {
    let length = direction.length();
    let size = max_component(point.abs()) + max_component((point + direction).abs()) + length + extent;
    max(1.0 - REACH_ERROR * size / max(length, f32::MIN_POSITIVE), 0.0)
}

impl Light {
    /// How many rays ask whether this light is seen.
    #[inline]
    pub fn sample_count(&self) -> u32 {
        if self.kind == AREA {
            self.samples_per_side * self.samples_per_side
        } else {
            1
        }
    }

    /// The light that one of its samples sends to a point, in a scene whose triangles are no larger than `extent`, scene
    /// units.
    #[inline]
    pub fn incident(&self, sample: u32, point: Vec3, extent: f32) -> Incident {
        if self.kind == DIRECTIONAL {
            return Incident {
                direction: self.position,
                reach: T_MAX,
                color: self.color,
            };
        }
        let mut direction = self.position - point;
        let mut share = 1.0;
        if self.kind == AREA {
            let side = self.samples_per_side;
            let spacing = 1.0 / side as f32;
            direction += self.edge_u * (((sample % side) as f32 + 0.5) * spacing)
                + self.edge_v * (((sample / side) as f32 + 0.5) * spacing);
            // Lambert's cosine at the light, zero behind it.
            let normal = self.edge_u.cross(self.edge_v).normalize();
            let cosine = -normal.dot(direction) / direction.length();
            share = if cosine > 0.0 { cosine * spacing * spacing } else { 0.0 };
        }
        let squared = direction.length_squared();
        if self.falloff_radius > 0.0 {
            let least = self.falloff_radius * self.falloff_radius;
            share /= if squared > least { squared } else { least };
        }
        if self.range > 0.0 {
            let ratio = squared / (self.range * self.range);
            share *= if ratio < 1.0 { 1.0 - ratio * ratio } else { 0.0 };
        }
        let reach = reach(point, direction, extent);
        Incident {
            direction,
            reach,
            color: self.color * share,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    fn point() -> Light {
        Light {
            position: vec3(0.0, 2.0, 0.0),
            kind: POINT,
            color: Vec3::splat(3.0),
            samples_per_side: 1,
            ..Light::zeroed()
        }
    }

    #[test]
    fn light_falls_off_with_the_square_of_the_distance() {
        let light = Light {
            falloff_radius: 0.5,
            ..point()
        };
        for distance in [0.5_f32, 1.0, 2.0, 7.0, 100.0] {
            let here = light.incident(0, light.position - Vec3::Y * distance, 1.0);
            assert!((here.color.x * distance * distance - 3.0).abs() < 1e-5, "{distance}");
        }
        let near = light.incident(0, light.position, 1.0);
        assert_eq!(near.color.x, 12.0, "bounded near the light");
        assert_eq!(point().incident(0, Vec3::ZERO, 1.0).color.x, 3.0, "without falloff");
    }

    #[test]
    fn light_fades_out_at_its_range() {
        for falloff_radius in [0.0, 0.5] {
            let endless = Light {
                falloff_radius,
                ..point()
            };
            let light = Light { range: 4.0, ..endless };
            let arriving =
                |light: &Light, distance: f32| light.incident(0, light.position - Vec3::X * distance, 1.0).color.x;
            for (distance, part) in [
                (0.0, 1.0),
                (2.0, 0.9375),
                (3.0, 0.68359375),
                (4.0, 0.0),
                (5.0, 0.0),
                (1e20, 0.0),
            ] {
                let wanted = arriving(&endless, distance) * part;
                assert!(
                    (arriving(&light, distance) - wanted).abs() <= 1e-6 * wanted,
                    "{distance}"
                );
            }
        }
    }

    #[test]
    fn an_area_light_is_the_mean_of_its_samples() {
        let light = Light {
            kind: AREA,
            position: vec3(-0.5, 2.0, -0.5),
            edge_u: Vec3::X,
            edge_v: Vec3::Z,
            samples_per_side: 8,
            color: Vec3::ONE,
            falloff_radius: 1e-3,
            ..point()
        };
        let arriving = |point| -> f32 { (0..64).map(|sample| light.incident(sample, point, 1.0).color.x).sum() };
        // edge_u x edge_v points down. Small and far, it is a point with a cosine.
        let below = arriving(vec3(0.0, -98.0, 0.0));
        assert!((below * 100.0 * 100.0 - 1.0).abs() < 1e-3, "{below}");
        let aside = arriving(vec3(100.0, -98.0, 0.0));
        assert!((aside * 20_000.0 - 0.5_f32.sqrt()).abs() < 1e-2, "{aside}");
        assert_eq!(arriving(vec3(0.0, 3.0, 0.0)), 0.0, "behind");
    }
}
