//! Light on its way to a point.

use super::camera::{focus, towards};
use crate::model::Model;
use crate::view::View;
use glam::DVec3;
use oktant_shared::light::{AREA, DIRECTIONAL, Light};

/// What lies nearer to a light than this part of the scene's size does not hide it.
const BEFORE_LIGHT: f64 = 1e-6;

/// A light in f64.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lamp {
    kind: Kind,
    /// Linear RGB.
    color: DVec3,
    /// Least distance that counts, where light falls off with its square.
    falloff: Option<f64>,
    range: Option<f64>,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    /// Unit vector towards the light.
    Directional(DVec3),
    Point(DVec3),
    Area {
        corner: DVec3,
        edges: [DVec3; 2],
        samples_per_side: u32,
    },
}

/// What a sample of a light sends to a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Incident {
    /// Unit vector from the point to the light.
    pub direction: DVec3,
    /// How far nothing must be in the way.
    pub reach: f64,
    /// What would arrive, linear RGB.
    pub color: DVec3,
}

/// The lights of a model, the first one where the view says.
pub(super) fn lamps(model: &Model, view: &View) -> Vec<Lamp> {
    let mut lamps: Vec<_> = model.lights.iter().map(Lamp::new).collect();
    if let Some(first) = lamps.first_mut() {
        let (center, radius) = focus(model);
        let towards = towards(&view.light, view.up);
        let place = center + towards * (f64::from(view.light.distance) * radius);
        match &mut first.kind {
            Kind::Directional(direction) => *direction = towards,
            Kind::Point(position) => *position = place,
            Kind::Area { corner, edges, .. } => *corner = place - (edges[0] + edges[1]) / 2.0,
        }
    }
    lamps
}

impl Lamp {
    fn new(light: &Light) -> Self {
        let position = light.position.as_dvec3();
        Lamp {
            kind: match light.kind {
                DIRECTIONAL => Kind::Directional(position.normalize()),
                AREA => Kind::Area {
                    corner: position,
                    edges: [light.edge_u.as_dvec3(), light.edge_v.as_dvec3()],
                    samples_per_side: light.samples_per_side,
                },
                _ => Kind::Point(position),
            },
            color: light.color.as_dvec3(),
            falloff: (light.falloff_radius > 0.0).then_some(f64::from(light.falloff_radius)),
            range: (light.range > 0.0).then_some(f64::from(light.range)),
        }
    }

    /// How many rays ask whether it is seen.
    pub fn sample_count(&self) -> u32 {
        match self.kind {
            Kind::Area { samples_per_side, .. } => samples_per_side * samples_per_side,
            _ => 1,
        }
    }

    /// What one of its samples sends to a point, in a scene of that size.
    pub fn incident(&self, sample: u32, point: DVec3, scene_size: f64) -> Incident {
        let (place, mut part) = match self.kind {
            Kind::Directional(direction) => {
                return Incident {
                    direction,
                    reach: f64::INFINITY,
                    color: self.color,
                };
            }
            Kind::Point(place) => (place, 1.0),
            Kind::Area {
                corner,
                edges,
                samples_per_side: side,
            } => {
                let along = |index: u32| (f64::from(index) + 0.5) / f64::from(side);
                let place = corner + edges[0] * along(sample % side) + edges[1] * along(sample / side);
                let front = edges[0].cross(edges[1]).normalize();
                let cosine = front.dot((point - place).normalize_or_zero());
                (place, cosine.max(0.0) / f64::from(side * side))
            }
        };
        let distance = (place - point).length();
        if let Some(least) = self.falloff {
            part /= distance.max(least).powi(2);
        }
        if let Some(range) = self.range {
            part *= (1.0 - (distance / range).powi(4)).max(0.0);
        }
        Incident {
            direction: (place - point).normalize_or_zero(),
            reach: (distance - BEFORE_LIGHT * (scene_size + distance)).max(0.0),
            color: self.color * part,
        }
    }
}
