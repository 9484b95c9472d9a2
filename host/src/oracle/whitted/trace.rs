//! The tree of a ray's reflections and refractions.

use super::environment::radiance;
use super::light::{Incident, Lamp};
use super::media::{Media, absorbed};
use super::optics::{Refraction, mirrored, refracted};
use super::shadow::visibility;
use super::surface::Surface;
use super::transmits;
use super::world::World;
use crate::view::Shading;
use glam::DVec3;
use oktant_shared::material::{FRESNEL, Material, PHONG_HIGHLIGHTS};

/// Rays of a sample; when there are so many, no new one is followed.
const MOST_RAYS: u32 = 4096;
/// The greatest depth there is.
const GREATEST_DEPTH: u32 = 16;

/// Follows rays.
pub(super) struct Tracer<'a> {
    pub world: World<'a>,
    pub lamps: Vec<Lamp>,
    /// Largest extent of everything that has one, scene units.
    pub scene_size: f64,
    pub shading: Shading,
    pub depth: u32,
    pub cutoff: f64,
}

/// What a sample took.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Tally {
    /// Rays that asked for what they hit first.
    pub rays: u32,
    /// Rays that asked whether a light is seen.
    pub shadow_rays: u32,
    /// The weight of all that was not followed.
    pub cut: f64,
}

/// A ray that is to be followed.
#[derive(Clone, Copy)]
struct Path {
    origin: DVec3,
    /// Unit vector.
    direction: DVec3,
    /// What part of its light reaches the eye, linear RGB.
    weight: DVec3,
    /// Reflections and refractions before it.
    depth: u32,
    /// What it starts inside of.
    media: Media,
}

impl Tracer<'_> {
    /// The light, linear RGB, from a direction of any length, as seen from a point inside of `media`.
    pub fn trace(&self, origin: DVec3, direction: DVec3, media: Media) -> (DVec3, Tally) {
        let mut tally = Tally::default();
        let path = Path {
            origin,
            direction: direction.normalize(),
            weight: DVec3::ONE,
            depth: 0,
            media,
        };
        (self.follow(path, &mut tally), tally)
    }

    /// The weighted light of a ray.
    fn follow(&self, mut path: Path, tally: &mut Tally) -> DVec3 {
        loop {
            tally.rays += 1;
            let model = self.world.model;
            let meeting = self.world.closest(path.origin, path.direction, f64::INFINITY);
            let around = path.media.current(model);
            if let Some(id) = around {
                path.weight *= absorbed(&model.materials[id as usize], meeting.map_or(f64::INFINITY, |it| it.t));
            }
            let Some(meeting) = meeting else {
                return path.weight * radiance(model, path.direction);
            };
            let surface = Surface::new(&self.world, self.shading, &meeting, path.origin, path.direction);
            let beyond = match (transmits(surface.material), surface.crossing.from_front) {
                (false, _) => path.media,
                (true, true) => path.media.entered(surface.crossing.material),
                (true, false) => path.media.left(surface.crossing.material),
            };
            let is_hidden = transmits(surface.material) && around.is_some() && beyond.current(model) == around;
            if !is_hidden {
                return self.light_of(&path, &surface, beyond, tally);
            }
            // Inside of what has a higher priority it is as if it were not there.
            path.origin = surface.crossing.behind();
            path.media = beyond;
            if !self.is_worth_following(&path, tally) {
                return self.cut(&path, tally);
            }
        }
    }

    /// The weighted light of a surface at the end of a ray, of which `beyond` is on the other side.
    fn light_of(&self, path: &Path, surface: &Surface<'_>, beyond: Media, tally: &mut Tally) -> DVec3 {
        let own = self.shaded(path, surface, tally) * path.weight;
        let [reflected, transmitted] = self.children(path, surface, beyond);
        // Both are judged before either is followed.
        let children = [reflected, transmitted].map(|child| (child, self.is_worth_following(&child, tally)));
        let light = children.into_iter().map(|(child, is_followed)| match is_followed {
            true => self.follow(child, tally),
            false => self.cut(&child, tally),
        });
        own + light.sum::<DVec3>()
    }

    /// The reflected and the transmitted ray; of no weight where there is none.
    fn children(&self, path: &Path, surface: &Surface<'_>, beyond: Media) -> [Path; 2] {
        let material = surface.material;
        let index_of = |media: Media| {
            let id = media.current(self.world.model);
            id.map_or(1.0, |id| f64::from(self.world.model.materials[id as usize].ior))
        };
        let mut from = index_of(path.media);
        let has_fresnel = material.flags & FRESNEL != 0;
        let (mut mirror, mut through) = (material.mirror.as_dvec3(), material.transmission.as_dvec3());
        let mut direction = path.direction;
        if transmits(material) {
            if !surface.crossing.from_front && path.media.current(self.world.model).is_none() {
                // It comes out of what it never entered.
                from = f64::from(material.ior);
            }
            let to = index_of(beyond);
            let reflectance = match refracted(path.direction, surface.normal, from, to) {
                Refraction::Total => 1.0,
                Refraction::Partial {
                    direction: bent,
                    reflectance,
                } => {
                    direction = bent;
                    if has_fresnel { reflectance } else { 0.0 }
                }
            };
            mirror += through * reflectance;
            through *= 1.0 - reflectance;
            // A tilted normal may refract to the wrong side.
            if direction.dot(surface.crossing.side) >= 0.0 {
                direction = match refracted(path.direction, surface.crossing.side, from, to) {
                    Refraction::Total => path.direction,
                    Refraction::Partial { direction, .. } => direction,
                };
            }
        } else if has_fresnel
            && let Refraction::Partial { reflectance, .. } =
                refracted(path.direction, surface.normal, from, f64::from(material.ior))
        {
            mirror *= reflectance;
        }
        let reflected = Path {
            origin: surface.crossing.before(),
            direction: mirrored(path.direction, surface.normal).normalize(),
            weight: path.weight * mirror,
            depth: path.depth + 1,
            media: path.media,
        };
        let transmitted = Path {
            origin: surface.crossing.behind(),
            direction,
            weight: path.weight * through,
            depth: path.depth + 1,
            media: beyond,
        };
        [reflected, transmitted]
    }

    fn is_worth_following(&self, path: &Path, tally: &Tally) -> bool {
        path.weight.max_element() > self.cutoff
            && path.depth <= self.depth.min(GREATEST_DEPTH)
            && tally.rays < MOST_RAYS
    }

    /// The weighted light of a ray that is not followed: that of the environment.
    fn cut(&self, path: &Path, tally: &mut Tally) -> DVec3 {
        let weight = path.weight.max_element();
        if weight <= 0.0 {
            return DVec3::ZERO;
        }
        tally.cut += weight;
        path.weight * radiance(self.world.model, path.direction)
    }

    /// The light that a surface itself sends along a ray: ambient, and of each light diffuse and specular.
    fn shaded(&self, path: &Path, surface: &Surface<'_>, tally: &mut Tally) -> DVec3 {
        let ambient = self.world.model.ambient.as_dvec3() * f64::from(surface.material.ambient);
        let mut light = surface.base * ambient;
        for lamp in &self.lamps {
            for sample in 0..lamp.sample_count() {
                light += self.lit(path, surface, lamp, sample, tally);
            }
        }
        light
    }

    /// Whether the first sample of the first light is above a surface, and nothing between them.
    pub fn is_lit(&self, surface: &Surface<'_>) -> bool {
        self.lamps.first().is_some_and(|lamp| {
            let incident = lamp.incident(0, surface.shadow_origin, self.scene_size);
            let Incident {
                direction,
                reach,
                color,
            } = incident;
            let is_above = surface.is_lifted || surface.crossing.side.dot(direction) > 0.0;
            let is_faced = surface.normal.dot(direction) > 0.0 && color != DVec3::ZERO;
            is_above && is_faced && !self.world.is_met(surface.shadow_origin, direction, reach)
        })
    }

    fn lit(&self, path: &Path, surface: &Surface<'_>, lamp: &Lamp, sample: u32, tally: &mut Tally) -> DVec3 {
        let incident = lamp.incident(sample, surface.shadow_origin, self.scene_size);
        let cosine = surface.normal.dot(incident.direction);
        // A light below the triangle still grazes the rounder surface that a lifted point is on.
        let is_above = surface.is_lifted || surface.crossing.side.dot(incident.direction) > 0.0;
        if cosine <= 0.0 || !is_above || incident.color == DVec3::ZERO {
            return DVec3::ZERO;
        }
        let material = surface.material;
        let diffuse = surface.base * (f64::from(material.diffuse) * cosine);
        let highlight = highlight(material, surface.normal, incident.direction, path.direction);
        let reflected = diffuse + material.specular.as_dvec3() * highlight;
        let most = (path.weight * reflected).max_element();
        let share = 1.0 / f64::from(lamp.sample_count());
        tally.shadow_rays += 1;
        let visibility = visibility(&self.world, surface.shadow_origin, path.media, &incident);
        tally.cut += most * visibility.cut.max_element() * share;
        reflected * incident.color * visibility.part
    }
}

/// How bright the highlight of a light is, 0 to 1, for who looks along `direction`.
fn highlight(material: &Material, normal: DVec3, towards_light: DVec3, direction: DVec3) -> f64 {
    if material.exponent <= 0.0 {
        return 0.0;
    }
    let cosine = if material.flags & PHONG_HIGHLIGHTS != 0 {
        mirrored(direction, normal).dot(towards_light)
    } else {
        normal.dot((towards_light - direction).normalize_or_zero())
    };
    cosine.clamp(0.0, 1.0).powf(f64::from(material.exponent))
}
