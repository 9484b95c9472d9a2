//! The light that a surface reflects in all directions.

use crate::arithmetic::{max, max_component, min};
use crate::buffer::load;
use crate::frame::Frame;
use crate::light::Light;
use crate::material::PHONG_HIGHLIGHTS;
use crate::medium::Media;
use crate::optics::reflected;
use crate::scene::World;
use crate::shadow::visibility;
use crate::surface::Surface;
use crate::traversal::Traversal;
use crate::variant::{GLASS, LIGHTS};
use crate::whitted::Traced;
use glam::Vec3;
#[cfg(target_arch = "spirv")]
use num_traits::Float;

/// Who looks at a surface.
#[derive(Clone, Copy)]
pub struct Viewer {
    /// Unit vector from the surface.
    pub direction: Vec3,
    /// What part of the surface's light reaches the eye, linear RGB.
    pub weight: Vec3,
    /// What is between the viewer and the surface.
    pub media: Media,
    /// Whether what is in shadow goes into [`Traced::seen`].
    pub is_seen: bool,
}

/// Light that no picture of 8 bits shows, a part of what the output shows as white: near black, a twentieth of a step.
pub const NEGLIGIBLE: f32 = 1.0 / (1 << 16) as f32;

/// The colour, linear RGB, in which a viewer sees the surface: ambient, and of each light
/// that reaches it diffuse (Lambert) and specular: Phong's (1975), or with the vector half-way between light and viewer
/// (J. F. Blinn, "Models of light reflection for computer synthesized pictures", SIGGRAPH 1977).
///
/// A light below the surface's horizon, out of whose range it is, or of which less than [`NEGLIGIBLE`] would be shown sends no
/// shadow ray. `traced` counts the shadow rays, and as cut what was left out.
///
/// Both sides of a triangle are lit alike: the normal is turned to the viewer. Without [`LIGHTS`] among its needs
/// there is only the frame's light, which has no area.
pub fn shade<V: Traversal, const NEEDS: u32>(
    frame: &Frame,
    world: &World<'_>,
    surface: &Surface,
    viewer: &Viewer,
    traced: &mut Traced,
) -> Vec3 {
    let mut color = surface.base * surface.material.ambient * frame.ambient;
    let mut shadows = 0;
    if NEEDS & LIGHTS == 0 {
        color += lit_by::<V, NEEDS>(frame, world, surface, viewer, &frame.light, 0, traced, &mut shadows);
        if viewer.is_seen {
            traced.sees(kind(shadows));
        }
        return color;
    }
    let mut i = 0;
    let mut sample = 0;
    // One call for all samples of all lights: each would be a copy of the whole traversal in the kernel, and a loop within a
    // loop would keep the light in registers meanwhile. Asked at its beginning whether to go on, the loop is up to three
    // times as fast on a GPU, unlike those of the traversals.
    while i <= frame.light_count {
        let light = if i == 0 {
            frame.light
        } else {
            load(world.appearance.lights, i - 1)
        };
        let is_last = sample + 1 == light.sample_count();
        color += lit_by::<V, NEEDS>(frame, world, surface, viewer, &light, sample, traced, &mut shadows);
        sample += 1;
        if is_last {
            if viewer.is_seen {
                traced.sees(kind(shadows));
            }
            shadows = 0;
            sample = 0;
            i += 1;
        }
    }
    color
}

/// A shadow ray of a light has met something that lets no light through.
const DARK: u32 = 1;
/// One has not.
const LIT: u32 = 2;

/// No shadow, nothing but shadow, or both.
#[inline]
fn kind(shadows: u32) -> u32 {
    if shadows & DARK == 0 {
        0
    } else if shadows & LIT == 0 {
        1
    } else {
        2
    }
}

/// What one sample of a light contributes; `shadows` becomes [`DARK`] or [`LIT`] as well, if a shadow ray is sent.
#[expect(
    clippy::too_many_arguments,
    reason = "what the loop over lights adds to is not worth a structure"
)]
fn lit_by<V: Traversal, const NEEDS: u32>(
    frame: &Frame,
    world: &World<'_>,
    surface: &Surface,
    viewer: &Viewer,
    light: &Light,
    sample: u32,
    traced: &mut Traced,
    shadows: &mut u32,
) -> Vec3 {
    let material = &surface.material;
    let origin = surface.shadow_origin;
    let count = if NEEDS & LIGHTS != 0 { light.sample_count() } else { 1 };
    let incident = light.incident(sample, origin, frame.root.size());
    let direction = incident.direction.normalize();
    let cosine = surface.normal.dot(direction);
    // A light below the triangle still grazes the rounder surface that a lifted point is on.
    let above = (surface.side.dot(direction) > 0.0) | surface.is_lifted;
    if !((cosine > 0.0) & above & (incident.color != Vec3::ZERO)) {
        return Vec3::ZERO;
    }
    let highlight = if material.exponent > 0.0 {
        let cosine = if material.flags & PHONG_HIGHLIGHTS != 0 {
            reflected(-viewer.direction, surface.normal).dot(direction)
        } else {
            surface.normal.dot((direction + viewer.direction).normalize())
        };
        // Above 1 by a rounding, a power of it would be far above.
        min(max(cosine, 0.0), 1.0).powf(material.exponent)
    } else {
        0.0
    };
    let reflected = surface.base * (material.diffuse * cosine) + material.specular * highlight;
    let most = max_component(viewer.weight * reflected);
    // A brighter light and a longer exposure show more of it.
    let shown = most * max(max_component(incident.color), 1.0) * max(frame.exposure, 1.0);
    if shown < NEGLIGIBLE {
        traced.cut += most / count as f32;
        return Vec3::ZERO;
    }
    traced.shadow_rays += 1;
    let arriving = reflected * incident.color;
    let visibility = visibility::<V, NEEDS>(frame, world, origin, viewer.media, &incident);
    if NEEDS & GLASS != 0 {
        traced.cut += most * visibility.cut / count as f32;
    }
    *shadows |= if visibility.part == Vec3::ZERO { DARK } else { LIT };
    arriving * visibility.part
}
