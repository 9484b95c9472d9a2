//! Box tests against rays in the planes of faces, on edges, with signed zeros, without numbers, and at boxes without
//! thickness.

use super::Plan;
use super::box_cases::{Case, UNIT, beside, edges_of_flat_boxes, hits};
use super::clock::quickest;
use super::exhibits::box_tests::{
    Clamped, Ignoring, Infected, Ordered, Unrounded, WilliamsDirection, WilliamsMisprinted, WilliamsReciprocal,
};
use super::report::{MethodReport, Role, RowReport};
use super::tally::{Counts, Failure};
use crate::backend::BackendError;
use crate::backend::gpu::Gpu;
use crate::bench::Device;
use glam::{Vec3, Vec4, vec3};
use oktant_shared::aabb::Aabb;
use oktant_shared::box_test::{BoxTest, KayKajiya, Williams};
use oktant_shared::ray::{PreparedRay, Ray};

/// A failure mode of box tests.
pub struct BoxMode {
    /// What a command line calls it.
    pub id: &'static str,
    title: &'static str,
    input: &'static str,
    remedy: &'static str,
    cases: fn(usize) -> Vec<Case>,
    fails: &'static [&'static str],
}

/// A box test by name: whether each of the rays meets its box.
type Test = (&'static str, Role, fn(&[Case]) -> Vec<bool>);

const TESTS: [Test; 10] = [
    ("kay-kajiya", Role::Default, prepared::<KayKajiya>),
    ("williams", Role::Offered, prepared::<Williams>),
    ("reciprocals, SSE order", Role::Exhibit, bare::<Ordered>),
    ("reciprocals, NaN left out", Role::Exhibit, bare::<Ignoring>),
    ("reciprocals, NaN kept", Role::Exhibit, bare::<Infected>),
    ("williams 2005, sign of 1/d", Role::Exhibit, bare::<WilliamsReciprocal>),
    ("williams 2005, sign of d", Role::Exhibit, bare::<WilliamsDirection>),
    ("williams, t1Y for t1Z", Role::Exhibit, bare::<WilliamsMisprinted>),
    ("reciprocals, clamped to 1e18", Role::Exhibit, bare::<Clamped>),
    ("kay-kajiya, exits not rounded up", Role::Exhibit, bare::<Unrounded>),
];

/// All of them.
pub const BOX_MODES: &[BoxMode] = &[
    BoxMode {
        id: "box-in-plane",
        title: "in the plane of a face, or along an edge",
        input: "box from 0 to 1; along z in the planes x = 0 and x = 1, and along edges",
        remedy: "an axis along which the ray does not move is decided by comparison",
        cases: |_| {
            let along_z = |x, y| (vec3(x, y, -1.0), Vec3::Z);
            hits(&[
                along_z(0.0, 0.5),
                along_z(1.0, 0.5),
                along_z(0.0, 0.0),
                along_z(1.0, 1.0),
            ])
        },
        fails: &[
            "reciprocals, SSE order",
            "reciprocals, NaN kept",
            "williams 2005, sign of 1/d",
            "williams 2005, sign of d",
            "reciprocals, clamped to 1e18",
        ],
    },
    BoxMode {
        id: "box-negative-zero",
        title: "components of -0.0",
        input: "box from 0 to 1; along z with -0.0 in x and y, inside and in the plane of a face",
        remedy: "zeros lose their sign when a ray is prepared",
        cases: |_| {
            let direction = vec3(-0.0, -0.0, 1.0);
            hits(&[
                (vec3(0.5, 0.5, -1.0), direction),
                (vec3(0.0, 0.5, -1.0), direction),
                (vec3(1.0, 0.5, -1.0), direction),
            ])
        },
        fails: &["williams 2005, sign of d", "reciprocals, SSE order"],
    },
    BoxMode {
        id: "box-leaving",
        title: "from a far face outwards",
        input: "box from 0 to 1; from a point of a face along its normal, which touches the box at t = 0",
        remedy: "a moment inside is inside",
        cases: |_| {
            hits(&[
                (vec3(0.5, 0.5, 1.0), Vec3::Z),
                (vec3(0.5, 1.0, 0.5), Vec3::Y),
                (vec3(1.0, 1.0, 0.5), Vec3::X),
            ])
        },
        fails: &["williams 2005, sign of 1/d", "williams 2005, sign of d"],
    },
    BoxMode {
        id: "box-flat",
        title: "a box without thickness, in its own plane",
        input: "box from (0, 0, 0) to (1, 1, 0); along x and y at z = 0",
        remedy: "an axis along which the ray does not move is decided by comparison",
        cases: |_| {
            let aabb = Aabb {
                low: Vec3::ZERO,
                high: vec3(1.0, 1.0, 0.0),
            };
            let rays = [(vec3(-1.0, 0.5, 0.0), Vec3::X), (vec3(0.25, 2.0, 0.0), Vec3::NEG_Y)];
            let case = |(origin, direction)| Case {
                ray: Ray::new(origin, direction),
                aabb,
                meets: true,
            };
            rays.map(case).into()
        },
        fails: &["reciprocals, NaN kept"],
    },
    BoxMode {
        id: "box-not-a-number",
        title: "rays that are none",
        input: "box from 0 to 1; NaN in the origin or the direction",
        remedy: "rays that are not finite are refused when they are prepared",
        cases: |_| {
            let bad = f32::NAN;
            let rays = [
                (vec3(bad, 0.5, -1.0), Vec3::Z),
                (vec3(0.5, 0.5, bad), Vec3::Z),
                (vec3(0.5, 0.5, -1.0), vec3(bad, 0.0, 1.0)),
                (vec3(0.5, 0.5, -1.0), vec3(0.0, 0.0, bad)),
            ];
            let case = |(origin, direction)| Case {
                ray: Ray::new(origin, direction),
                aabb: UNIT,
                meets: false,
            };
            rays.map(case).into()
        },
        fails: &["reciprocals, NaN left out", "reciprocals, SSE order"],
    },
    BoxMode {
        id: "box-beside",
        title: "boxes that a ray passes, or has behind it",
        input: "boxes of all sizes; from points about them to others",
        remedy: "the last step of Williams compares with t1Z, where the thesis has t1Y",
        cases: beside,
        fails: &["williams, t1Y for t1Z"],
    },
    BoxMode {
        id: "box-rounding",
        title: "flat boxes far away, at whose edges rounding loses rays",
        input: "boxes without thickness; from up to 100 sizes away at points of their edges, of which those count that exact arithmetic finds to meet",
        remedy: "exits are rounded up by two units in the last place",
        cases: edges_of_flat_boxes,
        fails: &["kay-kajiya, exits not rounded up"],
    },
];

impl BoxMode {
    /// Runs all box tests, on GPUs those that can be chosen.
    ///
    /// # Errors
    /// [`BackendError`] where a GPU gives up.
    pub fn run(&self, plan: &Plan) -> Result<RowReport, BackendError> {
        let cases = (self.cases)(plan.rays);
        let mut base = None;
        let methods = TESTS.map(|(name, role, test)| {
            let (answers, time) = quickest(|| test(&cases));
            let seconds = time.as_secs_f64();
            let ratio = seconds / *base.get_or_insert(seconds);
            let (counts, failures) = judged(&cases, &answers);
            MethodReport {
                name: name.into(),
                role,
                device: "CPU".into(),
                counts,
                time_ratio: (cases.len() >= 1000).then_some(ratio),
                failures,
            }
        });
        let mut methods = Vec::from(methods);
        for device in &plan.devices {
            if let Device::Gpu(gpu) = device {
                methods.extend(on_gpu(gpu, &cases)?);
            }
        }
        Ok(RowReport {
            id: self.id,
            family: "box tests",
            title: self.title,
            input: self.input,
            remedy: self.remedy,
            must_fail: self.fails.into(),
            methods,
        })
    }
}

/// The box tests that can be chosen, as the kernel has them. Which rays are none is left to the processor: the kernel asks
/// that before it tests any box.
fn on_gpu(gpu: &Gpu, cases: &[Case]) -> Result<[MethodReport; 2], BackendError> {
    let rays: Vec<Ray> = cases.iter().map(|case| case.ray).collect();
    let corners: Vec<[Vec4; 2]> = cases
        .iter()
        .map(|case| [case.aabb.low.extend(0.0), case.aabb.high.extend(0.0)])
        .collect();
    let (intervals, _) = quickest(|| gpu.probe_two("probe_box_tests", &rays, &corners));
    let intervals = intervals?;
    let report = |(name, role, _): &Test, at: usize| {
        let answers: Vec<bool> = cases
            .iter()
            .zip(&intervals)
            .map(|(case, interval)| {
                let ray = PreparedRay::new(&case.ray);
                ray.valid && interval[at] <= interval[at + 1] && interval[at + 1] >= ray.t_min
            })
            .collect();
        let (counts, failures) = judged(cases, &answers);
        MethodReport {
            name: (*name).into(),
            role: *role,
            device: gpu.name.clone(),
            counts,
            time_ratio: None,
            failures,
        }
    };
    Ok([report(&TESTS[0], 0), report(&TESTS[1], 2)])
}

fn prepared<B: BoxTest>(cases: &[Case]) -> Vec<bool> {
    let meets = |case: &Case| {
        let ray = PreparedRay::new(&case.ray);
        let interval = B::prepare(&ray).interval(&case.aabb);
        ray.valid && interval.enter <= interval.exit && interval.exit >= ray.t_min
    };
    cases.iter().map(meets).collect()
}

/// With the ray as it is.
fn bare<B: BoxTest>(cases: &[Case]) -> Vec<bool> {
    let meets = |case: &Case| {
        let ray = PreparedRay {
            origin: case.ray.origin,
            direction: case.ray.direction,
            t_min: case.ray.t_min,
            t_max: case.ray.t_max,
            scale: 1.0,
            valid: true,
        };
        let interval = B::prepare(&ray).interval(&case.aabb);
        interval.enter <= interval.exit && interval.exit >= ray.t_min
    };
    cases.iter().map(meets).collect()
}

fn judged(cases: &[Case], answers: &[bool]) -> (Counts, Vec<Failure>) {
    let wrong = || {
        cases
            .iter()
            .zip(answers)
            .filter(|(case, answer)| case.meets != **answer)
    };
    let missed = wrong().filter(|(case, _)| case.meets).count();
    let counts = Counts {
        rays: cases.len(),
        missed,
        phantom: wrong().count() - missed,
        ..Counts::default()
    };
    let failure = |(case, _): (&Case, &bool)| {
        let corners = [case.aabb.low.to_array(), case.aabb.high.to_array()];
        let numbers: Vec<String> = corners.iter().flatten().map(|number| format!("{number:?}")).collect();
        Failure {
            kind: if case.meets { "missed" } else { "false" },
            corners: vec![corners.into()],
            ..Failure::of_ray(&case.ray)
        }
        .replayed(&format!("box:{}", numbers.join(",")), "")
    };
    (counts, wrong().take(super::subject::KEPT).map(failure).collect())
}
