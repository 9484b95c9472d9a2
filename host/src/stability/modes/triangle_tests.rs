//! Where triangle tests fail.

use super::{Mode, ON_SPHERE, TIGHT, aimed};
use crate::mesh::Mesh;
use crate::mesh_source::MeshSource;
use crate::progress::silent;
use crate::stability::aim::{Aim, at};
use crate::stability::exhibits::rounding::{Contracted, Kernel, Plain};
use crate::stability::exhibits::triangle_tests::{
    Epsilon, Exact, HavelHerout, MollerTrumbore, OneBound, Plucker, Slack, Woop,
};
use crate::stability::meshes::{of_corners, sphere};
use crate::stability::method::Method;
use crate::stability::subject::Wanted;
use glam::{Vec3, vec3};
use oktant_shared::ray::Ray;

const MOLLER_TRUMBORE: Method = Method::triangle::<MollerTrumbore<Contracted, Exact>>("moller-trumbore, contracted");
const WOOP: Method = Method::triangle::<Woop<Contracted, true>>("woop, contracted");
const PLUCKER: Method = Method::triangle::<Plucker<Contracted, false>>("plucker, contracted");
/// The default as a GPU that contracts computes it.
const KERNEL: Method = Method::twin::<Woop<Kernel, false>>("watertight, contracted");

/// A triangle behind the origins of rays that begin in the middle of a mesh, which makes the mesh so large that they do: an
/// origin that is outside is advanced, and the ray is another one by a rounding.
const BEHIND: [[f32; 3]; 3] = [[0.6, -0.6, -0.6], [0.5, -0.6, -0.6], [0.6, -0.5, -0.6]];

const EPSILON_6: Method = Method::triangle::<MollerTrumbore<Plain, Epsilon<6>>>("moller-trumbore, epsilon 1e-6");
const EPSILON_7: Method = Method::triangle::<MollerTrumbore<Plain, Epsilon<7>>>("moller-trumbore, epsilon 1e-7");
const SLACK: Method = Method::triangle::<MollerTrumbore<Plain, Slack>>("moller-trumbore, slack 1e-6");
const HAVEL_HEROUT: Method = Method::triangle::<HavelHerout>("havel-herout");

/// All of them.
pub const TRIANGLE_TESTS: &[Mode] = &[
    Mode {
        id: "edges",
        title: "shared edges",
        input: "closed sphere of radius 1; from inside at points on its edges",
        remedy: "edge functions whose sign flips, and nothing else, for the neighbour",
        rays: at_edges,
        exhibits: &[KERNEL, MOLLER_TRUMBORE, WOOP, PLUCKER, SLACK, HAVEL_HEROUT],
        fails: &[
            "moller-trumbore",
            "baldwin-weber",
            "moller-trumbore, contracted",
            "havel-herout",
        ],
        ..TIGHT
    },
    Mode {
        id: "edges-small",
        title: "shared edges of a small mesh",
        input: "closed sphere of radius 0.001; from inside at points on its edges",
        remedy: "no absolute epsilon: the determinant scales with the square of the edges",
        mesh: || Ok(sphere(1e-3, Vec3::ZERO)),
        rays: at_edges,
        exhibits: &[KERNEL, MOLLER_TRUMBORE, WOOP, EPSILON_7],
        fails: &[
            "moller-trumbore",
            "moller-trumbore, contracted",
            "moller-trumbore, epsilon 1e-7",
        ],
        ..TIGHT
    },
    Mode {
        id: "edges-offset",
        title: "shared edges far from the origin of coordinates",
        input: "closed sphere of radius 1 about (1000, 1234, -2234); from inside at points on its edges",
        remedy: "corners are taken relative to the ray's origin first",
        mesh: || Ok(sphere(1.0, vec3(1000.0, 1234.0, -2234.0))),
        rays: at_edges,
        exhibits: &[KERNEL, MOLLER_TRUMBORE, WOOP, HAVEL_HEROUT],
        fails: &["baldwin-weber", "havel-herout"],
        ..TIGHT
    },
    Mode {
        id: "vertices",
        title: "shared vertices",
        input: "closed sphere of radius 1; from inside at its vertices",
        remedy: "all triangles round a corner see the same projected corner",
        rays: |mesh, count| aimed_from_inside(mesh, count, 2, |aim| aim.vertex()),
        exhibits: &[KERNEL, MOLLER_TRUMBORE, WOOP, PLUCKER, SLACK],
        fails: &[
            "moller-trumbore",
            "baldwin-weber",
            "moller-trumbore, contracted",
            "plucker, contracted",
        ],
        ..TIGHT
    },
    Mode {
        id: "interiors",
        title: "interiors, by an epsilon that is larger than the determinants",
        input: "the Stanford bunny in its own units, 0.156 wide; from outside at points in its triangles",
        remedy: "the determinant is compared with zero",
        mesh: || MeshSource::Bunny.load(&silent),
        rays: |mesh, count| aimed(mesh, count, 3, |aim| at(aim.away(2.0), aim.in_triangle())),
        exhibits: &[
            Method::triangle::<MollerTrumbore<Plain, Epsilon<5>>>("moller-trumbore, epsilon 1e-5"),
            EPSILON_6,
        ],
        fails: &["moller-trumbore, epsilon 1e-5", "moller-trumbore, epsilon 1e-6"],
        ..ON_SPHERE
    },
    Mode {
        id: "tiny",
        title: "a triangle of 0.0002 units, met straight on",
        input: "corners (0,0,0), (2e-4,0,0), (0,2e-4,0); from (s/3, s/3, -1) along z",
        remedy: "the determinant is compared with zero",
        wanted: Wanted::Hit,
        mesh: || Ok(of_corners(&[[[0.0; 3], [2e-4, 0.0, 0.0], [0.0, 2e-4, 0.0]]])),
        rays: |_, _| vec![Ray::new(vec3(2e-4 / 3.0, 2e-4 / 3.0, -1.0), Vec3::Z)],
        exhibits: &[EPSILON_6, EPSILON_7],
        fails: &["moller-trumbore, epsilon 1e-6", "moller-trumbore, epsilon 1e-7"],
        ..ON_SPHERE
    },
    Mode {
        id: "one-bound",
        title: "only the sum of the weights held against zero, as in the thesis",
        input: "closed sphere of radius 1; from outside at points within 1.5 radii",
        remedy: "each weight is held against zero",
        rays: |mesh, count| aimed(mesh, count, 4, |aim| at(aim.away(3.0), aim.within(1.5))),
        exhibits: &[Method::triangle::<MollerTrumbore<Plain, OneBound>>(
            "moller-trumbore, u + v >= 0",
        )],
        fails: &["moller-trumbore, u + v >= 0"],
        ..ON_SPHERE
    },
    Mode {
        id: "utm",
        title: "Embree's watertightness test: a sphere 270 km away from the origin of coordinates",
        input: "closed sphere of radius 2 about (148376, 1234, -223423); from within 1 of its middle in all directions",
        remedy: "corners are taken relative to the ray's origin first",
        wanted: Wanted::Hit,
        mesh: || Ok(sphere(2.0, vec3(148_376.0, 1234.0, -223_423.0))),
        rays: |mesh, count| aimed(mesh, count, 5, |aim| Ray::new(aim.within(0.25), aim.unit())),
        exhibits: &[HAVEL_HEROUT],
        fails: &["baldwin-weber", "havel-herout"],
        ..ON_SPHERE
    },
    Mode {
        id: "leak-moller-trumbore",
        title: "the edge of two triangles of the bunny",
        input: "a ray through the shared edge that both of Moller and Trumbore's tests leave out",
        remedy: "edge functions whose sign flips, and nothing else, for the neighbour",
        mesh: || {
            let (a, b) = ([0.0185807, -0.13282, 0.589612], [0.0172833, -0.109403, 0.584628]);
            let (c, d) = ([0.0047078, -0.115145, 0.584423], [0.00386001, -0.133219, 0.585925]);
            Ok(of_corners(&[[a, b, c], [d, a, c], BEHIND]))
        },
        rays: |_, _| {
            vec![Ray::new(
                vec3(-0.08355774, -0.0033111349, -0.01892129),
                vec3(0.09328443, -0.118228264, 0.60522157),
            )]
        },
        exhibits: &[KERNEL, MOLLER_TRUMBORE],
        fails: &["moller-trumbore", "moller-trumbore, contracted"],
        ..TIGHT
    },
    Mode {
        id: "leak-contracted",
        title: "an edge that leaks only where products and sums are contracted",
        input: "a ray through the shared edge of two triangles of the bunny",
        remedy: "Kahan's difference of products, whose sign is right with a fused multiply-add",
        mesh: || {
            Ok(of_corners(&[
                [
                    [-0.111542, 0.0838027, 0.442508],
                    [-0.124246, 0.0833018, 0.437357],
                    [-0.124285, 0.0659349, 0.452193],
                ],
                [
                    [-0.111491, 0.0660248, 0.455391],
                    [-0.111542, 0.0838027, 0.442508],
                    [-0.124285, 0.0659349, 0.452193],
                ],
                BEHIND,
            ]))
        },
        rays: |_, _| {
            vec![Ray::new(
                vec3(-0.004111711, 0.04591811, -0.023082506),
                vec3(-0.117076114, 0.024359543, 0.47292155),
            )]
        },
        exhibits: &[KERNEL, WOOP],
        fails: &["woop, contracted"],
        ..TIGHT
    },
    Mode {
        id: "leak-plucker",
        title: "a vertex of five triangles at which Pluecker's sides leak",
        input: "a ray at the vertex; a fan of five triangles of the bunny",
        remedy: "all triangles round a corner see the same projected corner",
        mesh: || {
            let hub = [-0.599008, 0.590537, 0.271344];
            Ok(of_corners(&[
                [[-0.586266, 0.589432, 0.275891], hub, [-0.591764, 0.590755, 0.292552]],
                [[-0.592843, 0.59037, 0.254979], hub, [-0.586266, 0.589432, 0.275891]],
                [hub, [-0.605148, 0.591629, 0.287812], [-0.591764, 0.590755, 0.292552]],
                [hub, [-0.612393, 0.591359, 0.266617], [-0.605148, 0.591629, 0.287812]],
                [[-0.612393, 0.591359, 0.266617], hub, [-0.592843, 0.59037, 0.254979]],
                BEHIND,
            ]))
        },
        rays: |_, _| {
            vec![Ray::new(
                vec3(-0.023837272, -0.019208364, 0.0013297874),
                vec3(-0.57517076, 0.6097454, 0.27001423),
            )]
        },
        exhibits: &[
            KERNEL,
            PLUCKER,
            Method::triangle::<Plucker<Plain, true>>("plucker, slack of an ulp"),
        ],
        fails: &["plucker, slack of an ulp"],
        ..TIGHT
    },
];

fn at_edges(mesh: &Mesh, count: usize) -> Vec<Ray> {
    aimed_from_inside(mesh, count, 1, |aim| aim.on_edge())
}

/// From within a quarter of the radius of the middle.
fn aimed_from_inside(mesh: &Mesh, count: usize, seed: u64, target: fn(&mut Aim<'_>) -> Vec3) -> Vec<Ray> {
    aimed(mesh, count, seed, |aim| at(aim.within(0.25), target(aim)))
}
