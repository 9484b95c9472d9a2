//! Exhibits fail for what they are exhibited for, and for nothing else: without it they agree with what is offered.

use super::cell_grid::{CellGrid, GridForm};
use super::revelles::{Form, Revelles};
use super::rounding::{Contracted, Kernel, Plain, Rounding};
use super::triangle_tests::{Exact, HavelHerout, MollerTrumbore, Plucker, Woop};
use crate::generated::soup;
use crate::progress::silent;
use crate::scene::Scene;
use crate::stability::aim::{Aim, at};
use crate::stability::subject::triangle;
use crate::structure::StructureOptions;
use glam::Vec3;
use oktant_shared::hit::Hit;
use oktant_shared::ray::{PreparedRay, Ray};
use oktant_shared::traversal::{Standard, Traversal};
use oktant_shared::triangle_test::{self as offered, TriangleTest};

/// Rays, each with a triangle.
fn pairs() -> Vec<(PreparedRay, oktant_shared::triangle::Triangle)> {
    let mesh = soup(500);
    let mut aim = Aim::new(&mesh, 1);
    (0..20_000)
        .map(|_| {
            let corners = aim.triangle();
            let on_edge = corners[0].lerp(corners[1], 0.5);
            let target = if aim.one_of(2) == 0 {
                on_edge
            } else {
                on_edge.lerp(corners[2], 0.4)
            };
            (PreparedRay::new(&at(aim.away(2.0), target)), triangle(corners))
        })
        .collect()
}

fn agree<A: TriangleTest, B: TriangleTest>(are_equal: bool) {
    for (ray, triangle) in pairs() {
        let (a, b) = (
            A::prepare(&ray).crossing(&triangle),
            B::prepare(&ray).crossing(&triangle),
        );
        assert_eq!(a.crosses, b.crosses, "{ray:?} {triangle:?}");
        if a.crosses {
            let close = |x: f32, y: f32| {
                if are_equal {
                    x == y
                } else {
                    (x - y).abs() <= 1e-4 * y.abs().max(1.0)
                }
            };
            assert!(close(a.t, b.t) && close(a.u, b.u) && close(a.v, b.v), "{a:?} {b:?}");
        }
    }
}

#[test]
fn twins_rounded_as_offered_are_what_is_offered() {
    agree::<MollerTrumbore<Plain, Exact>, offered::MollerTrumbore>(true);
    agree::<Woop<Plain, false>, offered::Watertight>(true);
    agree::<Plucker<Plain, false>, offered::Plucker>(true);
}

#[test]
fn other_formulas_say_the_same_of_rays_that_are_not_hard() {
    let mut crossed = 0;
    for (ray, triangle) in pairs() {
        let right = offered::Watertight::prepare(&ray).crossing(&triangle);
        let inner = right.u.min(right.v).min(1.0 - right.u - right.v) > 1e-3;
        let (ab, ac) = (triangle.b - triangle.a, triangle.c - triangle.a);
        let normal = ab.cross(ac);
        // Neither steep nor slender, where t is a matter of rounding.
        let is_steep = normal.dot(ray.direction).abs() < 0.1 * normal.length() * ray.direction.length();
        let is_slender = normal.length() < 0.1 * ab.length_squared().max(ac.length_squared());
        if !right.crosses || !inner || is_steep || is_slender {
            continue;
        }
        crossed += 1;
        for crossing in [
            HavelHerout::prepare(&ray).crossing(&triangle),
            Woop::<Contracted, true>::prepare(&ray).crossing(&triangle),
            Woop::<Kernel, false>::prepare(&ray).crossing(&triangle),
            Plucker::<Contracted, true>::prepare(&ray).crossing(&triangle),
            MollerTrumbore::<Contracted, Exact>::prepare(&ray).crossing(&triangle),
        ] {
            assert!(
                crossing.crosses && (crossing.t - right.t).abs() < 1e-3 * right.t.abs().max(1.0),
                "{crossing:?}"
            );
        }
    }
    assert!(crossed > 500, "{crossed}");
}

/// Of products that are alike the difference is nothing, whichever is taken from the other; contracted, it is what rounding
/// left out of one of them, with the same sign either way.
#[test]
fn a_contracted_difference_takes_no_side() {
    let mut x = 0.1_f32;
    let mut next = || {
        x = (x * 997.0 + 0.123_456_7) % 1.0;
        x - 0.5
    };
    let mut one_sided = 0;
    for _ in 0..10_000 {
        let (a, b) = (next(), next());
        assert_eq!(
            (Kernel::difference(a, b, b, a), Plain::difference(a, b, b, a)),
            (0.0, 0.0)
        );
        one_sided += usize::from(Contracted::difference(a, b, b, a) * Contracted::difference(b, a, a, b) > 0.0);
        let (c, d) = (next(), next());
        let (forth, back) = (Kernel::difference(a, b, c, d), Kernel::difference(c, d, a, b));
        assert!(
            (forth > 0.0) == (back < 0.0) && (forth == 0.0) == (back == 0.0),
            "{forth} {back}"
        );
    }
    assert!(one_sided > 5_000, "{one_sided}");
}

/// Of rays in general position.
#[test]
fn mended_traversals_agree_with_the_default() {
    let mesh = soup(400);
    let scene = Scene::new(&mesh, &StructureOptions::default(), &silent).unwrap();
    let view = scene.view();
    let mut aim = Aim::new(&mesh, 3);
    let mended = Revelles::new(&mesh, Form::MENDED);
    let published = Revelles::new(&mesh, Form::PUBLISHED);
    let forms = [false, true].map(|summed| {
        CellGrid::new(
            &mesh,
            GridForm {
                summed,
                first_cell: false,
            },
        )
    });
    let mut hits = 0;
    for i in 0..3_000 {
        let origin = if i % 2 == 0 { aim.away(2.0) } else { aim.within(0.5) };
        let ray: Ray = at(origin, aim.within(0.6) + Vec3::splat(1e-3));
        let right: Hit = view.identified(Standard::closest_hit(&view, &ray));
        hits += usize::from(right.is_hit());
        for (name, hit) in [
            ("mended", mended.closest_hit(&ray)),
            ("published", published.closest_hit(&ray)),
            ("planes", forms[0].closest_hit(&ray)),
            ("summed", forms[1].closest_hit(&ray)),
        ] {
            assert_eq!(hit.triangle, right.triangle, "{name}: {ray:?}");
        }
    }
    assert!(hits > 1_500, "{hits}");
}
