//! The surface where a ray meets it.

use crate::arithmetic::max;
use crate::buffer::load;
use crate::color::linear_color;
use crate::frame::{FLAT, Frame};
use crate::hit::Hit;
use crate::material::{Material, SMOOTH_NORMALS, VERTEX_COLORS};
use crate::normal::{face_normal, interpolated_normal, unit_or_zero};
use crate::optics::reflected;
use crate::plane::PLANE;
use crate::ray::Ray;
use crate::scene::World;
use crate::secondary_origin::surface_point;
use crate::texture::NO_TEXTURE;
use crate::triangle::{Triangle, Vertex};
use crate::variant::{MATERIALS, PLANES, TEXTURES};
use glam::{Vec2, Vec3};

/// A surface as seen by a ray.
#[derive(Clone, Copy)]
pub struct Surface {
    /// Where the ray met it, scene units.
    pub point: Vec3,
    /// Distance along [`Surface::side`], or against it, at which rays that leave it start.
    pub clearance: f32,
    /// Unit normal of the plane, on the side from which the ray came: decides what is in front and what behind.
    pub side: Vec3,
    /// Whether the ray came from the front, where a triangle's corners run counter-clockwise.
    pub from_front: bool,
    /// Unit normal that shades: interpolated and bumpy, but so that the ray is reflected to its side.
    pub normal: Vec3,
    /// Where shadow rays start, off the surface: above the triangle, where it stands for something rounder.
    pub shadow_origin: Vec3,
    /// Whether that is higher above the triangle than rounding asks for.
    pub is_lifted: bool,
    /// Colour of the surface, linear RGB.
    pub base: Vec3,
    /// Index of the material.
    pub material_id: u32,
    /// The material.
    pub material: Material,
}

impl Surface {
    /// What `ray` met at `hit`, which must not be a miss: with the planes, textures and materials beside the first that
    /// `NEEDS` has.
    pub fn new<const NEEDS: u32>(frame: &Frame, world: &World<'_>, ray: &Ray, hit: &Hit) -> Self {
        let view = -ray.direction.normalize();
        if NEEDS & PLANES != 0 && hit.triangle & PLANE != 0 {
            on_plane::<NEEDS>(world, ray, hit, view)
        } else {
            on_triangle::<NEEDS>(frame, world, ray, hit, view)
        }
    }

    /// The origin of a ray that leaves on the side from which the ray came.
    #[inline]
    pub fn front_origin(&self) -> Vec3 {
        self.point + self.side * self.clearance
    }

    /// The origin of a ray that goes on behind the surface.
    #[inline]
    pub fn back_origin(&self) -> Vec3 {
        self.point - self.side * self.clearance
    }
}

/// What a ray needs to know of a surface to go straight through it.
#[derive(Clone, Copy)]
pub struct Passage {
    /// Where the ray goes on.
    pub origin: Vec3,
    /// Whether the ray came from the front.
    pub from_front: bool,
    /// Index of the material.
    pub material_id: u32,
}

impl Passage {
    /// Through what `ray` met at `hit`, which must not be a miss.
    pub fn new(world: &World<'_>, ray: &Ray, hit: &Hit) -> Self {
        if hit.triangle & PLANE != 0 {
            let plane = load(world.appearance.planes, hit.triangle & !PLANE);
            let (point, clearance) = plane.surface_point(ray.at(hit.t));
            let from_front = plane.normal.dot(ray.direction) <= 0.0;
            Passage {
                origin: point + plane.normal * (if from_front { -clearance } else { clearance }),
                from_front,
                material_id: plane.material,
            }
        } else {
            let triangle = world.scene.triangle(hit.triangle);
            let face = faced(&triangle, ray);
            let (point, clearance) = surface_point(&triangle, hit, face);
            let from_front = face.dot(ray.direction) <= 0.0;
            Passage {
                origin: point + face * (if from_front { -clearance } else { clearance }),
                from_front,
                material_id: load(world.appearance.material_ids, hit.triangle),
            }
        }
    }
}

fn on_plane<const NEEDS: u32>(world: &World<'_>, ray: &Ray, hit: &Hit, view: Vec3) -> Surface {
    let plane = load(world.appearance.planes, hit.triangle & !PLANE);
    let (point, clearance) = plane.surface_point(ray.at(hit.t));
    let from_front = plane.normal.dot(view) >= 0.0;
    let material = load(world.appearance.materials, plane.material);
    let at = plane.coordinates(point);
    let mut front = plane.normal;
    if NEEDS & TEXTURES != 0 && material.bump != NO_TEXTURE {
        let along = plane.normal.cross(plane.tangent);
        front = bumpy(world, &material, at, front, plane.tangent, along);
    }
    let turn = if from_front { 1.0 } else { -1.0 };
    let side = plane.normal * turn;
    Surface {
        point,
        clearance,
        side,
        from_front,
        normal: bent(front * turn, side, view),
        shadow_origin: point + side * clearance,
        is_lifted: false,
        base: if NEEDS & TEXTURES != 0 {
            material.base * texture_color(world, &material, at)
        } else {
            material.base
        },
        material_id: plane.material,
        material,
    }
}

/// The face normal of a triangle that a ray met. One so thin that rounding leaves it without area is seen from its front.
#[inline]
fn faced(triangle: &Triangle, ray: &Ray) -> Vec3 {
    let face = face_normal(triangle);
    if face == Vec3::ZERO {
        -ray.direction.normalize()
    } else {
        face
    }
}

fn on_triangle<const NEEDS: u32>(frame: &Frame, world: &World<'_>, ray: &Ray, hit: &Hit, view: Vec3) -> Surface {
    let appearance = &world.appearance;
    let triangle = world.scene.triangle(hit.triangle);
    let material_id = if NEEDS & MATERIALS != 0 {
        load(appearance.material_ids, hit.triangle)
    } else {
        0
    };
    let material = load(appearance.materials, material_id);
    let face = faced(&triangle, ray);
    let (point, clearance) = surface_point(&triangle, hit, face);
    let from_front = face.dot(ray.direction) <= 0.0;
    let turn = if from_front { 1.0 } else { -1.0 };
    let side = face * turn;
    let smooth = material.flags & SMOOTH_NORMALS != 0 && frame.features & FLAT == 0;
    let colored = material.flags & VERTEX_COLORS != 0;

    let mut front = face;
    let mut shadow_point = point;
    let mut base = material.base;
    if smooth || colored {
        let corners = [
            world.vertex(triangle.vertex_a),
            world.vertex(triangle.vertex_b),
            world.vertex(triangle.vertex_c),
        ];
        if smooth {
            front = interpolated_normal(&corners, hit, face);
            shadow_point = lifted(&triangle, &corners, hit, point, side);
        }
        if colored {
            base *= linear_color(corners[0].color) * max(1.0 - hit.u - hit.v, 0.0)
                + linear_color(corners[1].color) * hit.u
                + linear_color(corners[2].color) * hit.v;
        }
    }
    if NEEDS & TEXTURES != 0 && (material.texture != NO_TEXTURE || material.bump != NO_TEXTURE) {
        let at_a = load(appearance.coordinates, triangle.vertex_a);
        let along_ab = load(appearance.coordinates, triangle.vertex_b) - at_a;
        let along_ac = load(appearance.coordinates, triangle.vertex_c) - at_a;
        let at = at_a + along_ab * hit.u + along_ac * hit.v;
        base *= texture_color(world, &material, at);
        let area = along_ab.x * along_ac.y - along_ab.y * along_ac.x;
        if material.bump != NO_TEXTURE && area != 0.0 {
            let (ab, ac) = (triangle.b - triangle.a, triangle.c - triangle.a);
            let along_u = (ab * along_ac.y - ac * along_ab.y) / area;
            let along_v = (ac * along_ab.x - ab * along_ac.x) / area;
            front = bumpy(world, &material, at, front, along_u, along_v);
        }
    }
    let normal = if front == face {
        side
    } else {
        bent(front * turn, side, view)
    };
    Surface {
        point,
        clearance,
        side,
        from_front,
        normal,
        shadow_origin: shadow_point + side * clearance,
        is_lifted: shadow_point != point,
        base,
        material_id,
        material,
    }
}

fn texture_color(world: &World<'_>, material: &Material, at: Vec2) -> Vec3 {
    if material.texture == NO_TEXTURE {
        Vec3::ONE
    } else {
        load(world.appearance.textures, material.texture).color(world.appearance.texels, at)
    }
}

/// The unit normal of the front of a surface that is raised by a height map (J. F. Blinn, "Simulation of wrinkled
/// surfaces", SIGGRAPH 1978); `along_u` and `along_v` say how the point moves with the texture coordinates.
fn bumpy(world: &World<'_>, material: &Material, at: Vec2, normal: Vec3, along_u: Vec3, along_v: Vec3) -> Vec3 {
    let slope =
        load(world.appearance.textures, material.bump).slope(world.appearance.texels, at) * material.bump_height;
    let area = along_u.cross(along_v);
    // Texture coordinates may run either way round.
    let turn = if area.dot(normal) < 0.0 { -1.0 } else { 1.0 };
    let tilt = normal.cross(along_v) * slope.x + along_u.cross(normal) * slope.y;
    let bumpy = unit_or_zero((normal * area.length() + tilt * turn) / max(area.length(), f32::MIN_POSITIVE));
    if bumpy == Vec3::ZERO { normal } else { bumpy }
}

/// How far above the surface the reflected ray stays, as a part of its length.
const LEAST_ELEVATION: f32 = 1e-3;

/// The vector or its opposite, whichever is on the side of `reference`.
fn towards(v: Vec3, reference: Vec3) -> Vec3 {
    if v.dot(reference) < 0.0 { -v } else { v }
}

/// The normal on the side of the viewer, where a mesh's normals and the order of its corners disagree too, tilted towards
/// the viewer by no more than what keeps the reflected ray above the surface.
#[inline]
fn bent(normal: Vec3, side: Vec3, view: Vec3) -> Vec3 {
    let normal = towards(normal, side);
    let mirrored = reflected(-view, normal);
    let elevation = mirrored.dot(side);
    if elevation >= LEAST_ELEVATION {
        normal
    } else {
        // The normal that reflects the ray to just above the horizon.
        (unit_or_zero(mirrored + side * (LEAST_ELEVATION - elevation)) + view).normalize()
    }
}

/// The point lifted to where the surface would be if it were as round as its normals say: the mean of its projections on
/// the corners' tangent planes, those below which it lies (J. Hanika, "Hacking the shadow terminator", Ray Tracing Gems
/// II, 2021). Rays to the light that start there do not see the edges of the triangles.
#[inline]
fn lifted(triangle: &Triangle, corners: &[Vertex; 3], hit: &Hit, point: Vec3, side: Vec3) -> Vec3 {
    let lift = |corner: Vec3, normal: Vec3, weight: f32| {
        let normal = towards(normal, side);
        normal * (weight * max(-(point - corner).dot(normal), 0.0))
    };
    point
        + lift(triangle.a, corners[0].normal, 1.0 - hit.u - hit.v)
        + lift(triangle.b, corners[1].normal, hit.u)
        + lift(triangle.c, corners[2].normal, hit.v)
}
