//! Lights.

use super::color::Radiance;
use super::fault::{Fault, Reason};
use super::number::{Amount, Length, SamplesPerSide};
use super::place::Place;
use super::vector::{Direction, Vector};
use crate::model::{Focus, white_light};
use crate::view::View;
use glam::Vec3;
use oktant_shared::light::{self, AREA, DIRECTIONAL, POINT};
use serde::Deserialize;

/// `[[light]]`: a light.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Light {
    /// "point", "directional" or "area". Default: "point".
    pub kind: Kind,
    /// Its colour. Default: 1.
    pub color: Option<Radiance>,
    /// The colour is multiplied with this, 0 and up. With falloff, what arrives at the distance 1. Default: 1.
    pub intensity: Option<Amount>,
    /// Point: where it is, scene units; mandatory.
    pub position: Option<Vector>,
    /// Directional: the direction in which its light travels; mandatory.
    pub direction: Option<Direction>,
    /// Area: a corner of the parallelogram, scene units; mandatory. It shines on the side of `edge_u x edge_v`, most in
    /// their direction (with the cosine).
    pub corner: Option<Vector>,
    /// Area: one edge from the corner; mandatory.
    pub edge_u: Option<Direction>,
    /// Area: the other edge from the corner; mandatory.
    pub edge_v: Option<Direction>,
    /// Area: shadow rays along each edge, in a regular grid, 1 to 16. Default: 4.
    pub samples_per_side: Option<SamplesPerSide>,
    /// Point and area: how light decreases with the distance: "none" or "inverse-square". Default: "none".
    pub falloff: Option<Falloff>,
    /// With falloff: nearer than this the light increases no more, scene units. Default: 0.001.
    pub radius: Option<Length>,
    /// Point and area: it fades out at this distance, scene units. Default: it has no end.
    pub range: Option<Length>,
}

/// What shines.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// A point.
    #[default]
    Point,
    /// Something infinitely far away.
    Directional,
    /// A parallelogram.
    Area,
}

/// How light decreases with the distance.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Falloff {
    /// Not at all.
    None,
    /// With its square.
    InverseSquare,
}

/// The lights of a file, and the place of the first in the view; without any word about them, the one of a mesh alone.
pub fn build_all(lights: Option<&[Light]>, view: &mut View, focus: Focus) -> Result<Vec<light::Light>, Fault> {
    let Some(lights) = lights else {
        return Ok(vec![white_light()]);
    };
    let mut built = Vec::new();
    for (i, light) in lights.iter().enumerate() {
        built.push(light.build(&Place::of("light").index(i))?);
    }
    if let Some(first) = built.first() {
        view.shine(first, focus);
    }
    Ok(built)
}

impl Light {
    fn build(&self, place: &Place) -> Result<light::Light, Fault> {
        self.check(place)?;
        let lacks = |what| Fault::new(place, Reason::Lacks(what));
        let vector = |given: Option<Vector>, what| given.map(|it| it.0.as_vec3()).ok_or_else(|| lacks(what));
        let direction = |given: Option<Direction>, what| given.map(|it| it.0.as_vec3()).ok_or_else(|| lacks(what));
        let color = self.color.map_or(Vec3::ONE, |color| color.0);
        let mut built = light::Light {
            color: color * self.intensity.map_or(1.0, |intensity| intensity.0),
            falloff_radius: match self.falloff {
                Some(Falloff::InverseSquare) => self.radius.map_or(1e-3, |radius| radius.0),
                _ => 0.0,
            },
            range: self.range.map_or(0.0, |range| range.0),
            ..white_light()
        };
        match self.kind {
            Kind::Point => {
                built.kind = POINT;
                built.position = vector(self.position, "its place, position")?;
            }
            Kind::Directional => {
                built.kind = DIRECTIONAL;
                let travels = self
                    .direction
                    .ok_or_else(|| lacks("the direction of its light, direction"))?;
                built.position = -travels.0.normalize().as_vec3();
            }
            Kind::Area => {
                built.kind = AREA;
                built.position = vector(self.corner, "a corner, corner")?;
                built.edge_u = direction(self.edge_u, "an edge, edge_u")?;
                built.edge_v = direction(self.edge_v, "an edge, edge_v")?;
                built.samples_per_side = self.samples_per_side.map_or(4, |samples| samples.0);
                if built.edge_u.cross(built.edge_v).length() == 0.0 {
                    return Err(Fault::new(place, Reason::NoArea));
                }
            }
        }
        Ok(built)
    }

    /// Makes sure that nothing is said that has no meaning.
    fn check(&self, place: &Place) -> Result<(), Fault> {
        let (is_point, is_directional, is_area) = (
            self.kind == Kind::Point,
            self.kind == Kind::Directional,
            self.kind == Kind::Area,
        );
        let whose = match self.kind {
            Kind::Point => "a point light",
            Kind::Directional => "a directional light",
            Kind::Area => "an area light",
        };
        for (key, is_there, has_meaning) in [
            ("position", self.position.is_some(), is_point),
            ("direction", self.direction.is_some(), is_directional),
            ("corner", self.corner.is_some(), is_area),
            ("edge_u", self.edge_u.is_some(), is_area),
            ("edge_v", self.edge_v.is_some(), is_area),
            ("samples_per_side", self.samples_per_side.is_some(), is_area),
            ("falloff", self.falloff.is_some(), !is_directional),
            ("range", self.range.is_some(), !is_directional),
        ] {
            if is_there && !has_meaning {
                return Err(Fault::new(&place.key(key), Reason::Inapplicable(whose)));
            }
        }
        if self.radius.is_some() && self.falloff != Some(Falloff::InverseSquare) {
            return Err(Fault::new(
                &place.key("radius"),
                Reason::Inapplicable("a light without falloff"),
            ));
        }
        Ok(())
    }
}
