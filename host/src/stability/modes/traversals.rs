//! Where traversals fail.

use super::{Mode, ON_SPHERE, aimed};
use crate::generated;
use crate::stability::aim::{Aim, at};
use crate::stability::exhibits::cell_grid::GridForm;
use crate::stability::exhibits::cells::Faces;
use crate::stability::exhibits::revelles::{Form, Zeros};
use crate::stability::meshes::{cube, flat, moved};
use crate::stability::method::Method;
use crate::stability::subject::Wanted;
use glam::Vec3;
use oktant_shared::ray::Ray;

const PUBLISHED: Method = Method::revelles("revelles, as published", Form::PUBLISHED);
const AVERAGED: Method = Method::revelles(
    "revelles, averaged middles",
    Form {
        averaged: true,
        ..Form::MENDED
    },
);

/// All of them.
pub const TRAVERSALS: &[Mode] = &[
    Mode {
        id: "zero-components",
        title: "directions with zero components",
        input: "closed sphere of radius 1; parallel to an axis, from outside at points within it",
        remedy: "zero components do not divide",
        rays: |mesh, count| aimed(mesh, count, 6, |aim| parallel(aim, |_| 0.0)),
        exhibits: &[PUBLISHED],
        fails: &["revelles, as published"],
        ..ON_SPHERE
    },
    Mode {
        id: "on-planes",
        title: "rays in the planes of faces and cells",
        input: "the cube from 0 to 1, its faces cut in 8 x 8; parallel to an axis in the plane of a face",
        remedy: "cells and boxes are closed, zero components do not divide",
        wanted: Wanted::Hit,
        mesh: || Ok(cube()),
        rays: |mesh, count| aimed(mesh, count, 7, in_face),
        exhibits: &[
            PUBLISHED,
            Method::revelles(
                "revelles, zero made 1e-7",
                Form {
                    zeros: Zeros::Tiny,
                    ..Form::MENDED
                },
            ),
        ],
        fails: &["revelles, as published", "revelles, zero made 1e-7"],
        ..ON_SPHERE
    },
    Mode {
        id: "negative-zero",
        title: "components of -0.0, which is not below zero, but has a negative reciprocal",
        input: "closed sphere of radius 1; parallel to an axis with both other components -0.0",
        remedy: "zeros lose their sign when a ray is prepared",
        rays: |mesh, count| aimed(mesh, count, 8, |aim| parallel(aim, |_| -0.0)),
        exhibits: &[PUBLISHED],
        fails: &["revelles, as published"],
        ..ON_SPHERE
    },
    Mode {
        id: "denormal",
        title: "components of 1e-39, whose reciprocal is infinite",
        input: "closed sphere of radius 1; parallel to an axis but for components of 1e-39",
        remedy: "components below 2^-100 of the largest are zero; middle planes are crossed where they are",
        rays: |mesh, count| {
            aimed(mesh, count, 9, |aim| {
                parallel(aim, |aim| if aim.one_of(2) == 0 { 1e-39 } else { -1e-39 })
            })
        },
        exhibits: &[AVERAGED],
        fails: &["revelles, averaged middles"],
        ..ON_SPHERE
    },
    Mode {
        id: "far",
        title: "origins so far away that t does not resolve the cells",
        input: "closed sphere of radius 1; from 10^6 radii away at points within half a radius",
        remedy: "the origin is advanced to the cube round everything",
        wanted: Wanted::Hit,
        rays: |mesh, count| aimed(mesh, count, 10, |aim| at(aim.away(1e6), aim.within(0.25))),
        exhibits: &[AVERAGED],
        fails: &["revelles, averaged middles"],
        ..ON_SPHERE
    },
    Mode {
        id: "mirrored",
        title: "an origin that is mirrored, and rounded, so that planes lie elsewhere for rays from the other side",
        input: "the cube from 0 to 1, its faces cut in 8 x 8, 1.1 as large and moved by 4095.9 along each axis; from inside to beside the \
                lines of its faces, against the axes",
        remedy: "planes are met in the other order, and stay where they are",
        wanted: Wanted::Hit,
        mesh: || Ok(moved(cube(), SIZE, OFFSET)),
        rays: |mesh, count| aimed(mesh, count, 16, beside_lines),
        exhibits: &[
            Method::revelles("revelles, mended", Form::MENDED),
            Method::revelles(
                "revelles, origin mirrored",
                Form {
                    mirrors_origin: true,
                    ..Form::MENDED
                },
            ),
        ],
        fails: &["revelles, origin mirrored"],
        ..ON_SPHERE
    },
    Mode {
        id: "corners",
        title: "rays that enter and leave cells through their corners, all planes at one t",
        input: "the cube from 0 to 1, its faces cut in 8 x 8; along diagonals through corners of its squares",
        remedy: "cells are closed, and of planes at one t any order will do that is always the same",
        wanted: Wanted::Hit,
        mesh: || Ok(cube()),
        rays: |mesh, count| aimed(mesh, count, 17, diagonal),
        exhibits: &[
            Method::revelles("revelles, mended", Form::MENDED),
            Method::revelles(
                "revelles, half-open cells",
                Form {
                    faces: Faces::HalfOpen,
                    ..Form::MENDED
                },
            ),
        ],
        fails: &["revelles, half-open cells"],
        ..ON_SPHERE
    },
    Mode {
        id: "first-leaf",
        title: "the search ends at the first leaf with a hit, wherever the hit is, as in the thesis",
        input: "1,000 triangles without order; from within in all directions",
        remedy: "the hit must lie before the exit of the cell",
        mesh: || Ok(generated::soup(1_000)),
        rays: |mesh, count| aimed(mesh, count, 11, |aim| Ray::new(aim.within(0.5), aim.unit())),
        exhibits: &[
            Method::revelles(
                "revelles, first leaf",
                Form {
                    first_leaf: true,
                    ..Form::MENDED
                },
            ),
            Method::grid(
                "grid, first cell",
                GridForm {
                    summed: false,
                    first_cell: true,
                },
            ),
        ],
        fails: &["revelles, first leaf", "grid, first cell"],
        ..ON_SPHERE
    },
    Mode {
        id: "table-1",
        title: "Table 1 with the bits of x and z swapped, as in the paper and the thesis",
        input: "1,000 triangles without order; from outside at points within",
        remedy: "the authors' erratum",
        mesh: || Ok(generated::soup(1_000)),
        rays: |mesh, count| aimed(mesh, count, 12, |aim| at(aim.away(3.0), aim.within(0.7))),
        exhibits: &[
            Method::revelles("revelles, mended", Form::MENDED),
            Method::revelles(
                "revelles, table 1 swapped",
                Form {
                    swapped: true,
                    ..Form::MENDED
                },
            ),
        ],
        fails: &["revelles, table 1 swapped"],
        ..ON_SPHERE
    },
    Mode {
        id: "flat",
        title: "a mesh without thickness, entered and left at one t",
        input: "the square from -1 to 1 at z = 0, cut in 8 x 8; from outside at points within it",
        remedy: "a ray that is inside for a moment only is inside; the root is a cube with some room",
        mesh: || Ok(flat()),
        rays: |mesh, count| aimed(mesh, count, 13, |aim| at(aim.away(2.0), aim.in_triangle())),
        exhibits: &[
            PUBLISHED,
            Method::revelles(
                "revelles, half-open cells",
                Form {
                    faces: Faces::HalfOpen,
                    ..Form::MENDED
                },
            ),
        ],
        fails: &["revelles, as published", "revelles, half-open cells"],
        ..ON_SPHERE
    },
    Mode {
        id: "summed-steps",
        title: "planes of a grid by adding up steps, whose rounding adds up too",
        input: "closed sphere of radius 1; from 10^5 radii away at points within half a radius",
        remedy: "each plane is crossed where it is, by an origin that is advanced to the grid",
        wanted: Wanted::Hit,
        rays: |mesh, count| aimed(mesh, count, 14, |aim| at(aim.away(1e5), aim.within(0.25))),
        exhibits: &[
            Method::grid(
                "grid, planes where they are",
                GridForm {
                    summed: false,
                    first_cell: false,
                },
            ),
            Method::grid(
                "grid, summed steps",
                GridForm {
                    summed: true,
                    first_cell: false,
                },
            ),
        ],
        fails: &["grid, summed steps"],
        ..ON_SPHERE
    },
    Mode {
        id: "quantised",
        title: "quantised boxes that are not rounded outwards",
        input: "closed sphere of radius 1; from inside in all directions",
        remedy: "low faces are rounded down and high ones up, and wider by what slabs may be off",
        wanted: Wanted::Hit,
        rays: |mesh, count| aimed(mesh, count, 15, |aim| Ray::new(aim.within(0.25), aim.unit())),
        exhibits: &[Method::Quantised("boxes rounded inwards")],
        fails: &["boxes rounded inwards"],
        ..ON_SPHERE
    },
];

/// Parallel to an axis from outside through a point within the mesh, but for what the other components are.
fn parallel(aim: &mut Aim<'_>, other: impl Fn(&mut Aim<'_>) -> f32) -> Ray {
    let axis = aim.one_of(3);
    let mut origin = aim.within(0.9);
    let sign = if aim.one_of(2) == 0 { 1.0 } else { -1.0 };
    origin[axis] = -4.0 * sign;
    let mut direction = Vec3::from_array([(); 3].map(|()| other(aim)));
    direction[axis] = sign;
    Ray::new(origin, direction)
}

/// Where coordinates reach beyond a power of two, so that their sums have a digit less.
const OFFSET: Vec3 = Vec3::splat(4095.9);

/// So that the faces of squares are no round numbers.
const SIZE: f32 = 1.1;

/// From inside of the moved cube against the axes, at a point of a face next to one of the lines between its squares.
fn beside_lines(aim: &mut Aim<'_>) -> Ray {
    let axis = aim.one_of(3);
    let mut target = Vec3::from_array([(); 3].map(|()| (1 + aim.one_of(7)) as f32 / 8.0));
    target[(axis + 1) % 3] += 5e-4 * aim.signed();
    target[(axis + 2) % 3] = 0.1 + 0.8 * aim.signed().abs();
    target[axis] = 0.0;
    let away = Vec3::from_array([(); 3].map(|()| 0.05 + 0.1 * aim.signed().abs()));
    let target = OFFSET + target * SIZE;
    at(target + away, target)
}

/// Along a diagonal of the unit cube through a corner of one of its squares, whose numbers are all exact.
fn diagonal(aim: &mut Aim<'_>) -> Ray {
    let corner = aim.vertex();
    let direction = Vec3::from_array([(); 3].map(|()| if aim.one_of(2) == 0 { 1.0 } else { -1.0 }));
    Ray::new(corner - 2.0 * direction, direction)
}

/// Along a face of the unit cube, parallel to an axis, through its interior.
fn in_face(aim: &mut Aim<'_>) -> Ray {
    let axis = aim.one_of(3);
    let face = (axis + 1 + aim.one_of(2)) % 3;
    let mut origin = Vec3::splat(0.5 + 0.49 * aim.signed());
    origin[face] = aim.one_of(2) as f32;
    let (from, sign) = if aim.one_of(2) == 0 { (-1.0, 1.0) } else { (2.0, -1.0) };
    origin[axis] = from;
    let mut direction = Vec3::ZERO;
    direction[axis] = sign;
    Ray::new(origin, direction)
}
