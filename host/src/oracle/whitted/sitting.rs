//! A picture in the making.

use super::Reference;
use super::camera::Camera;
use super::light::lamps;
use super::media::{Media, media_at};
use super::sampling::{Sample, samples};
use super::surface::Surface;
use super::trace::Tracer;
use super::world::{Met, World};
use crate::sampling::Pattern;
use crate::view::View;
use glam::{DVec2, DVec3, Vec4};
use oktant_shared::hit::Hit;
use oktant_shared::plane::PLANE;

/// Which samples of a pixel are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Takes {
    /// Those of the view.
    View,
    /// A regular grid of so many along each side, filtered as the view says.
    Grid(u32),
}

/// A view that leaves out what cannot be seen leaves out, here, rays of no more weight than this.
const CUTOFF: f64 = 1.0 / (1 << 16) as f64;

/// Everything about a picture that is known before its first pixel.
pub struct Sitting<'a> {
    tracer: Tracer<'a>,
    camera: Camera,
    media: Media,
    samples: Vec<Sample>,
}

/// What is seen first through the middle of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstHit {
    /// Where; its `t` is the depth along the line of sight.
    pub hit: Hit,
    /// The unit normal that shades, on the side that is seen; zero where nothing was hit.
    pub normal: DVec3,
    /// Whether the first light is above it and nothing, transparent or not, is between it and that light's first sample.
    pub is_lit: bool,
}

impl<'a> Sitting<'a> {
    pub(super) fn new(reference: &'a Reference, view: &View, size: [u32; 2], takes: Takes) -> Self {
        let world = World::new(reference);
        let camera = Camera::new(world.model, view, size);
        let lamps = lamps(world.model, view);
        let (low, high) = world.oracle.bounds();
        let (side, pattern) = match takes {
            Takes::View => (view.samples.per_side(), view.pattern),
            Takes::Grid(side) => (side, Pattern::Regular),
        };
        Sitting {
            media: media_at(&world, camera.eye),
            camera,
            samples: samples(side, pattern, view.filter),
            tracer: Tracer {
                world,
                lamps,
                scene_size: (high - low).max(DVec3::ZERO).max_element(),
                shading: view.shading,
                depth: view.depth,
                cutoff: if view.cutoff == 0.0 { 0.0 } else { CUTOFF },
            },
        }
    }

    /// Width and height of the picture, pixels.
    pub fn size(&self) -> [u32; 2] {
        self.camera.picture_size()
    }

    /// How many samples a pixel has.
    pub fn sample_count(&self) -> usize {
        self.samples.len()
    }

    /// The samples of a pixel, as [`crate::picture::Picture::sums`] and [`crate::picture::Picture::work`] hold them.
    pub fn pixel(&self, pixel: [u32; 2]) -> (Vec4, Vec4) {
        let (mut light, mut weights) = (DVec3::ZERO, 0.0);
        let (mut rays, mut shadow_rays, mut cut) = (0.0, 0.0, 0.0);
        for glance in self.camera.glances(pixel) {
            let corner = DVec2::from(glance.pixel.map(f64::from));
            for sample in &self.samples {
                let (origin, direction) = self.camera.ray(corner + sample.place, glance.eye);
                let (color, tally) = self.tracer.trace(origin, direction, self.media);
                light += color * glance.channels * sample.weight;
                weights += if glance.counts { sample.weight } else { 0.0 };
                rays += f64::from(tally.rays);
                shadow_rays += f64::from(tally.shadow_rays);
                cut += tally.cut * sample.weight;
            }
        }
        (
            light.as_vec3().extend(weights as f32),
            Vec4::new(rays as f32, shadow_rays as f32, cut as f32, 0.0),
        )
    }

    /// What is seen first through the middle of a pixel; where two eyes share it, by the left one.
    pub fn first_hit(&self, pixel: [u32; 2]) -> FirstHit {
        let nothing = FirstHit {
            hit: Hit::miss(oktant_shared::ray::T_MAX),
            normal: DVec3::ZERO,
            is_lit: false,
        };
        let glances = self.camera.glances(pixel);
        let Some(glance) = glances.first() else { return nothing };
        let middle = DVec2::from(glance.pixel.map(f64::from)) + DVec2::splat(0.5);
        let (origin, sight) = self.camera.ray(middle, glance.eye);
        let direction = sight.normalize();
        let world = &self.tracer.world;
        let Some(meeting) = world.closest(origin, direction, f64::INFINITY) else {
            return nothing;
        };
        let (triangle, u, v) = match meeting.what {
            Met::Triangle { id, u, v } => (id, u, v),
            Met::Plane(index) => (PLANE | index, 0.0, 0.0),
        };
        let surface = Surface::new(world, self.tracer.shading, &meeting, origin, direction);
        FirstHit {
            hit: Hit {
                t: (meeting.t / sight.length()) as f32,
                triangle,
                u: u as f32,
                v: v as f32,
            },
            normal: surface.normal,
            is_lit: self.tracer.is_lit(&surface),
        }
    }
}
