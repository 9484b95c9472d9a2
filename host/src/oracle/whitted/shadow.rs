//! How much of a light a point sees.

use super::light::Incident;
use super::media::{Media, absorbed};
use super::transmits;
use super::world::World;
use glam::DVec3;

/// Light passes so many transmissive surfaces on its way to a point.
const MOST_SURFACES: u32 = 16;

/// How much of a light arrives.
#[derive(Clone, Copy, Debug)]
pub(super) struct Visibility {
    /// What part of it, linear RGB.
    pub part: DVec3,
    /// What may arrive beside that, through one surface more than are followed.
    pub cut: DVec3,
}

impl Visibility {
    fn of(part: DVec3) -> Self {
        Visibility { part, cut: DVec3::ZERO }
    }
}

/// What arrives of a light at a point inside of `media`: straight through what is transmissive, multiplied with the
/// transmission of each surface and absorbed on the way between them.
pub(super) fn visibility(world: &World<'_>, point: DVec3, mut media: Media, incident: &Incident) -> Visibility {
    let Incident { direction, reach, .. } = *incident;
    if !world.is_transparent {
        let is_hidden = world.is_met(point, direction, reach);
        return Visibility::of(if is_hidden { DVec3::ZERO } else { DVec3::ONE });
    }
    let materials = &world.model.materials;
    let (mut origin, mut left, mut part) = (point, reach, DVec3::ONE);
    for surfaces in 0.. {
        let meeting = world.closest(origin, direction, left);
        let way = meeting.map_or(left, |meeting| meeting.t);
        let around = media.current(world.model);
        if let Some(id) = around {
            part *= absorbed(&materials[id as usize], way);
        }
        let Some(meeting) = meeting else { break };
        let crossing = world.crossing(&meeting, origin, direction);
        let material = &materials[crossing.material as usize];
        if !transmits(material) {
            return Visibility::of(DVec3::ZERO);
        }
        if surfaces == MOST_SURFACES {
            return Visibility {
                part: DVec3::ZERO,
                cut: part,
            };
        }
        if around.is_none() && !crossing.from_front {
            // Out of what was never entered: its surface has a hole.
            part *= absorbed(material, way);
        }
        media = if crossing.from_front {
            media.entered(crossing.material)
        } else {
            media.left(crossing.material)
        };
        let is_boundary = around.is_none() || media.current(world.model) != around;
        if is_boundary {
            part *= material.transmission.as_dvec3();
        }
        origin = crossing.behind();
        left -= way;
    }
    Visibility::of(part)
}
