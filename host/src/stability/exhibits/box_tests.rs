//! Box tests that fail. They take rays as they are, where those that are offered take prepared ones.

use glam::Vec3;
use oktant_shared::aabb::Aabb;
use oktant_shared::box_test::{BoxTest, Interval};
use oktant_shared::ray::PreparedRay;

/// How the planes' distances are put together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slip {
    /// Reciprocals; the lesser by `a < b`, whose answer is `b` where one is NaN, as SSE has it.
    Ordered,
    /// Reciprocals; minima and maxima that leave NaN out.
    Ignoring,
    /// Reciprocals; minima and maxima that NaN infects.
    Infected,
    /// A. Williams et al. 2005, which plane is near by the sign of the reciprocal.
    WilliamsReciprocal,
    /// The same by the sign of the direction.
    WilliamsDirection,
    /// As the thesis has it: in the last step of Williams, `t1Y` stands where `t1Z` must.
    WilliamsMisprinted,
    /// Directions below 10^-18 made 10^-18.
    Clamped,
    /// Divisions with the case of zero apart, but exits not rounded up.
    Unrounded,
}

/// The slips as types, since a box test is one.
macro_rules! slips {
    ($($name:ident)+) => { $(
        #[doc = concat!("[`Slip::", stringify!($name), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name(PreparedRay);

        impl BoxTest for $name {
            fn prepare(ray: &PreparedRay) -> Self {
                $name(*ray)
            }

            fn interval(&self, aabb: &Aabb) -> Interval {
                interval(Slip::$name, self.0.origin, self.0.direction, aabb)
            }
        }
    )+ };
}

slips! { Ordered Ignoring Infected WilliamsReciprocal WilliamsDirection WilliamsMisprinted Clamped Unrounded }

/// What a test of a ray's line against a box says.
fn interval(slip: Slip, origin: Vec3, direction: Vec3, aabb: &Aabb) -> Interval {
    let slabs = [0, 1, 2].map(|axis| {
        let (from, along) = (origin[axis], direction[axis]);
        let (low, high) = (aabb.low[axis], aabb.high[axis]);
        match slip {
            Slip::WilliamsReciprocal | Slip::WilliamsMisprinted => {
                near_far(low, high, from, 1.0 / along, 1.0 / along < 0.0)
            }
            Slip::WilliamsDirection => near_far(low, high, from, 1.0 / along, along < 0.0),
            Slip::Unrounded if along == 0.0 => {
                let inside = low <= from && from <= high;
                if inside { [-1e38, 1e38] } else { [1e38, -1e38] }
            }
            Slip::Unrounded => ordered(least, greatest, (low - from) / along, (high - from) / along),
            Slip::Clamped => {
                let along = if along.abs() < 1e-18 {
                    1e-18_f32.copysign(along)
                } else {
                    along
                };
                let reciprocal = 1.0 / along;
                ordered(least, greatest, (low - from) * reciprocal, (high - from) * reciprocal)
            }
            _ => {
                let (a, b) = ((low - from) * (1.0 / along), (high - from) * (1.0 / along));
                match slip {
                    Slip::Ignoring => ordered(f32::min, f32::max, a, b),
                    Slip::Infected => ordered(infected_min, infected_max, a, b),
                    _ => ordered(least, greatest, a, b),
                }
            }
        }
    });
    let [x, y, z] = slabs;
    if matches!(
        slip,
        Slip::WilliamsReciprocal | Slip::WilliamsDirection | Slip::WilliamsMisprinted
    ) {
        return williams(x, y, z, slip == Slip::WilliamsMisprinted);
    }
    let [min, max]: [fn(f32, f32) -> f32; 2] = match slip {
        Slip::Ignoring => [f32::min, f32::max],
        Slip::Infected => [infected_min, infected_max],
        _ => [least, greatest],
    };
    Interval {
        enter: max(max(x[0], y[0]), z[0]),
        exit: min(min(x[1], y[1]), z[1]),
    }
}

/// The paper's sequence of comparisons.
fn williams(x: [f32; 2], y: [f32; 2], z: [f32; 2], misprinted: bool) -> Interval {
    const MISS: Interval = Interval { enter: 1.0, exit: -1.0 };
    let [mut enter, mut exit] = x;
    if enter > y[1] || y[0] > exit {
        return MISS;
    }
    if y[0] > enter {
        enter = y[0];
    }
    if y[1] < exit {
        exit = y[1];
    }
    if enter > z[1] || z[0] > exit {
        return MISS;
    }
    if z[0] > enter {
        enter = z[0];
    }
    let last = if misprinted { y[1] } else { z[1] };
    if last < exit {
        exit = last;
    }
    // The paper asks for more than a moment after the origin.
    if exit > 0.0 { Interval { enter, exit } } else { MISS }
}

fn near_far(low: f32, high: f32, from: f32, reciprocal: f32, backwards: bool) -> [f32; 2] {
    let (near, far) = if backwards { (high, low) } else { (low, high) };
    [(near - from) * reciprocal, (far - from) * reciprocal]
}

fn ordered(min: impl Fn(f32, f32) -> f32, max: impl Fn(f32, f32) -> f32, a: f32, b: f32) -> [f32; 2] {
    [min(a, b), max(a, b)]
}

fn least(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

fn greatest(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

fn infected_min(a: f32, b: f32) -> f32 {
    if a.is_nan() { a } else { least(a, b) }
}

fn infected_max(a: f32, b: f32) -> f32 {
    if a.is_nan() { a } else { greatest(a, b) }
}
