//! The light that a surface sends to the eye.

use crate::arithmetic::max;
use crate::buffer::load;
use crate::frame::{Frame, SMOOTH_NORMALS, VERTEX_COLORS};
use crate::hit::Hit;
use crate::normal::{face_normal, interpolated_normal};
use crate::ray::Ray;
use crate::scene::Scene;
use crate::secondary_origin::secondary_origin;
use crate::traversal::Traversal;
use crate::triangle::Triangle;
use glam::Vec3;
#[cfg(target_arch = "spirv")]
use num_traits::Float;

/// The colour, linear RGB, of the point where `ray` hit the scene: ambient, and where the light reaches it, diffuse
/// (Lambert) and specular (J. F. Blinn, "Models of light reflection for computer synthesized pictures", SIGGRAPH 1977).
///
/// Both sides of a triangle are lit alike: the normal is turned to the viewer. Which side that is, and whether the light
/// stands on it, is decided by the face normal; the interpolated one only shades.
pub fn shade<V: Traversal>(frame: &Frame, scene: &Scene<'_>, ray: &Ray, hit: &Hit) -> Vec3 {
    let triangle = load(scene.triangles, hit.triangle);
    let view = -ray.direction.normalize();
    let side = towards(face_normal(&triangle), view);
    let base = base_color(frame, scene, &triangle, hit);
    let ambient = base * frame.ambient;

    let origin = secondary_origin(&triangle, hit, side);
    let to_light = frame.light - origin;
    if side.dot(to_light) <= 0.0 {
        return ambient;
    }
    let shadow = Ray {
        origin,
        t_min: 0.0,
        direction: to_light,
        t_max: 1.0,
    };
    if V::any_hit(scene, &shadow) {
        return ambient;
    }
    let normal = if frame.features & SMOOTH_NORMALS != 0 {
        towards(interpolated_normal(scene, &triangle, hit, side), side)
    } else {
        side
    };
    let light = to_light.normalize();
    let diffuse = base * (frame.diffuse * max(normal.dot(light), 0.0));
    // Longer than zero: both vectors are on the same side of the surface.
    let half = (light + view).normalize();
    let specular = frame.specular * max(normal.dot(half), 0.0).powf(frame.exponent);
    ambient + (diffuse + Vec3::splat(specular)) * frame.light_color
}

/// The vector or its opposite, whichever is on the side of `reference`.
fn towards(v: Vec3, reference: Vec3) -> Vec3 {
    if v.dot(reference) < 0.0 { -v } else { v }
}

fn base_color(frame: &Frame, scene: &Scene<'_>, triangle: &Triangle, hit: &Hit) -> Vec3 {
    if frame.features & VERTEX_COLORS != 0 {
        let a = linear_color(load(scene.vertices, triangle.vertex_a).color);
        let b = linear_color(load(scene.vertices, triangle.vertex_b).color);
        let c = linear_color(load(scene.vertices, triangle.vertex_c).color);
        a * (1.0 - hit.u - hit.v) + b * hit.u + c * hit.v
    } else {
        frame.base_color
    }
}

/// Linear RGB of a colour whose red, green and blue are the lowest three bytes, sRGB-encoded.
pub fn linear_color(srgb: u32) -> Vec3 {
    Vec3::new(
        linear_from_srgb((srgb & 0xff) as f32 / 255.0),
        linear_from_srgb((srgb >> 8 & 0xff) as f32 / 255.0),
        linear_from_srgb((srgb >> 16 & 0xff) as f32 / 255.0),
    )
}

/// The inverse of the sRGB transfer function (IEC 61966-2-1), 0 to 1.
pub fn linear_from_srgb(encoded: f32) -> f32 {
    if encoded <= 0.040_45 {
        encoded / 12.92
    } else {
        ((encoded + 0.055) / 1.055).powf(2.4)
    }
}

/// The sRGB transfer function (IEC 61966-2-1), 0 to 1.
pub fn srgb_from_linear(linear: f32) -> f32 {
    if linear <= 0.003_130_8 {
        linear * 12.92
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_and_back() {
        for i in 0..=255_u32 {
            let linear = linear_color(i | i << 8 | i << 16);
            assert_eq!(linear.x, linear.y);
            assert_eq!(linear.x, linear.z);
            let back = srgb_from_linear(linear.x) * 255.0;
            assert!((back - i as f32).abs() < 1e-3, "{i} became {back}");
        }
    }
}
