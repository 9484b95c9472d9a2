//! What a ray is inside of.

use crate::buffer::load;
use crate::material::Material;
use glam::UVec4;

/// How many media can enclose a point at a time. Where more do, the last one entered takes the place of the one before.
pub const MAX_NESTED: u32 = 4;

/// How many materials a scene has at most: so many are told apart in [`Media`].
pub const MAX_MATERIALS: u32 = 0xffff;

/// The media around a point, as indices of materials: nested dielectrics with priorities (C. M. Schmidt, B. Budge,
/// "Simple nested dielectrics in ray traced images", Journal of Graphics Tools 7(2), 2002).
///
/// Nothing is toggled: crossing a surface against its normal enters its medium, crossing it along the normal leaves it,
/// and leaving what was never entered changes nothing.
///
/// Of each the index of its material plus 1, or 0 where the place is free, in 16 bits: it goes with every ray, and a GPU traces the
/// more rays at a time the less goes with each. The used places come first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Media {
    /// The first two, the very first in the lower bits.
    outer: u32,
    /// The others.
    inner: u32,
}

impl Media {
    /// In the air.
    pub const AIR: Media = Media { outer: 0, inner: 0 };

    /// Those of [`crate::frame::Frame::media`]: indices of materials plus 1 in the order in which they were entered, and
    /// 0 where there are no more.
    pub fn of_eye(media: UVec4) -> Self {
        Media {
            outer: media.x | media.y << 16,
            inner: media.z | media.w << 16,
        }
    }

    /// As [`crate::frame::Frame::media`].
    pub fn to_eye(self) -> UVec4 {
        UVec4::new(self.at(0), self.at(1), self.at(2), self.at(3))
    }

    /// What is at a place, below [`MAX_NESTED`].
    #[inline(always)]
    fn at(&self, place: u32) -> u32 {
        let pair = if place < 2 { self.outer } else { self.inner };
        pair >> (16 * (place & 1)) & 0xffff
    }

    /// Puts something there.
    #[inline(always)]
    fn put(&mut self, place: u32, inside: u32) {
        let shift = 16 * (place & 1);
        let with = |pair: u32| pair & !(0xffff << shift) | inside << shift;
        if place < 2 {
            self.outer = with(self.outer);
        } else {
            self.inner = with(self.inner);
        }
    }

    /// The material that fills the point, of those around it the one with the highest priority (of equal ones the last
    /// entered), as its index plus 1; 0 in the air.
    pub fn current(&self, materials: &[Material]) -> u32 {
        let mut current = 0;
        let mut priority = 0;
        let mut i = 0;
        while i < MAX_NESTED {
            let inside = self.at(i);
            if inside != 0 {
                let own = load(materials, inside - 1).priority;
                if current == 0 || own >= priority {
                    current = inside;
                    priority = own;
                }
            }
            i += 1;
        }
        current
    }

    /// After entering a material.
    pub fn entered(mut self, material: u32) -> Self {
        let mut place = 0;
        while place < MAX_NESTED - 1 && self.at(place) != 0 {
            place += 1;
        }
        self.put(place, material + 1);
        self
    }

    /// After leaving a material: the one entered last of its kind is gone.
    pub fn left(mut self, material: u32) -> Self {
        let mut gone = MAX_NESTED;
        let mut i = 0;
        while i < MAX_NESTED {
            if self.at(i) == material + 1 {
                gone = i;
            }
            i += 1;
        }
        while gone < MAX_NESTED {
            let next = if gone + 1 < MAX_NESTED { self.at(gone + 1) } else { 0 };
            self.put(gone, next);
            gone += 1;
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable;

    fn materials() -> [Material; 3] {
        core::array::from_fn(|i| Material {
            priority: [1, 3, 2][i],
            ..Material::zeroed()
        })
    }

    #[test]
    fn the_highest_priority_fills_the_point() {
        let materials = materials();
        let media = Media::AIR;
        assert_eq!(media.current(&materials), 0);
        let media = media.entered(0);
        assert_eq!(media.current(&materials), 1);
        let media = media.entered(1).entered(2);
        assert_eq!(media.current(&materials), 2);
        let media = media.left(1);
        assert_eq!(media.current(&materials), 3);
        assert_eq!(media.left(2).current(&materials), 1);
        assert_eq!(media.left(2).left(0), Media::AIR);
    }

    #[test]
    fn what_goes_in_comes_out_at_every_place() {
        let media = UVec4::new(1, MAX_MATERIALS, 0x8000, MAX_MATERIALS - 1);
        assert_eq!(Media::of_eye(media).to_eye(), media);
        let entered = media
            .to_array()
            .into_iter()
            .fold(Media::AIR, |media, inside| media.entered(inside - 1));
        assert_eq!(entered.to_eye(), media);
        let left = entered.left(MAX_MATERIALS - 1);
        assert_eq!(left.to_eye(), UVec4::new(1, 0x8000, MAX_MATERIALS - 1, 0));
    }

    #[test]
    fn leaving_what_was_not_entered_changes_nothing() {
        let media = Media::AIR.entered(2);
        assert_eq!(media.left(1), media);
        assert_eq!(Media::AIR.left(0), Media::AIR);
    }

    #[test]
    fn too_many_media_replace_the_last() {
        let materials = materials();
        let media = Media::AIR.entered(0).entered(0).entered(0).entered(0).entered(1);
        assert_eq!(media.current(&materials), 2);
        assert_eq!(media.left(1).current(&materials), 1);
    }
}
