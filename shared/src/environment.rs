//! What rays see that leave the scene.

use crate::arithmetic::{max, min};
use crate::buffer::load;
use crate::texture::{NO_TEXTURE, Texture};
use bytemuck::{Pod, Zeroable};
use glam::{Vec3, vec2};
#[cfg(target_arch = "spirv")]
use num_traits::Float;

/// The surroundings: a vertical gradient, or an image.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Environment {
    /// Colour straight above, linear RGB, 0 and up.
    pub zenith: Vec3,
    /// Index of an equirectangular texture to see instead of the gradient, or [`NO_TEXTURE`].
    pub texture: u32,
    /// Colour all around at eye level.
    pub horizon: Vec3,
    /// Turns the image counterclockwise seen from above, in turns.
    pub rotation: f32,
    /// Colour straight below.
    pub nadir: Vec3,
    /// The image is multiplied with this.
    pub strength: f32,
    /// Unit vector upwards: +Y or +Z.
    pub up: Vec3,
    /// Fills the row.
    pub reserved: u32,
}

const _: () = assert!(size_of::<Environment>() == 64);

impl Environment {
    /// The same colour all around, with +Y up.
    pub fn constant(color: Vec3) -> Self {
        Environment {
            zenith: color,
            texture: NO_TEXTURE,
            horizon: color,
            rotation: 0.0,
            nadir: color,
            strength: 1.0,
            up: Vec3::Y,
            reserved: 0,
        }
    }

    /// The colour of the gradient in a direction of any length: linear in the sine of the elevation.
    pub fn gradient(&self, direction: Vec3) -> Vec3 {
        let sine = direction.dot(self.up) / direction.length();
        // A rounding beyond 1 would lead below black.
        let sine = max(min(sine, 1.0), -1.0);
        if sine > 0.0 {
            self.horizon + (self.zenith - self.horizon) * sine
        } else {
            self.horizon - (self.nadir - self.horizon) * sine
        }
    }

    /// The colour in a direction of any length, linear RGB: of the image where there is one, else of the gradient.
    ///
    /// The middle of the image lies in front (+Z, or -Y where +Z is up), its left part to the left as seen from the
    /// centre of the scene looking at the front, its upper edge straight above.
    pub fn radiance(&self, textures: &[Texture], texels: &[u32], direction: Vec3) -> Vec3 {
        if self.texture == NO_TEXTURE {
            return self.gradient(direction);
        }
        let direction = direction.normalize();
        let elevation = max(min(direction.dot(self.up), 1.0), -1.0);
        let front = if self.up.z > 0.5 { -direction.y } else { direction.z };
        // Straight up and down there is no angle, and a GPU need not give one.
        let is_level = direction.x != 0.0 || front != 0.0;
        let turn = if is_level {
            (-direction.x).atan2(front) / core::f32::consts::TAU
        } else {
            0.0
        };
        let at = vec2(
            0.5 + turn + self.rotation,
            0.5 + elevation.asin() / core::f32::consts::PI,
        );
        // Not repeated over the poles.
        let texture = load(textures, self.texture);
        let margin = 0.5 / texture.height as f32;
        let low = if at.y < margin { margin } else { at.y };
        let high = if low > 1.0 - margin { 1.0 - margin } else { low };
        texture.color(texels, vec2(at.x, high)) * self.strength
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gradient_has_its_three_colours() {
        let sky = Environment {
            zenith: Vec3::Z,
            horizon: Vec3::ONE,
            nadir: Vec3::X,
            ..Environment::constant(Vec3::ZERO)
        };
        assert_eq!(sky.gradient(Vec3::Y * 3.0), Vec3::Z);
        assert_eq!(sky.gradient(Vec3::X + Vec3::Z), Vec3::ONE);
        assert_eq!(sky.gradient(-Vec3::Y), Vec3::X);
        assert_eq!(
            Environment::constant(Vec3::Y).gradient(Vec3::new(0.3, 0.5, -2.0)),
            Vec3::Y
        );
    }

    #[test]
    fn an_image_surrounds_the_scene() {
        // Four columns: left-behind, left, ... of the front; two rows: above and below.
        let texels: [u32; 8] =
            core::array::from_fn(|i| 0xff << (8 * (i % 4).min(2)) | if i % 4 == 3 { 0xff } else { 0 });
        let texture = Texture {
            width: 4,
            height: 2,
            repeats: 1.0,
            ..Texture::zeroed()
        };
        let sky = Environment {
            texture: 0,
            ..Environment::constant(Vec3::ZERO)
        };
        let see = |direction: Vec3| sky.radiance(&[texture], &texels, direction);
        // Looking to the front from the centre, +X is at the left.
        let quarter = |x: f32, z: f32| see(Vec3::new(x, 0.0, z));
        assert_eq!(quarter(1.0, 1.0), Vec3::Y);
        assert_eq!(quarter(-1.0, 1.0), Vec3::Z);
        assert_eq!(quarter(1.0, -1.0), Vec3::X);
        assert_eq!(quarter(-1.0, -1.0), Vec3::new(1.0, 0.0, 1.0));
    }
}
