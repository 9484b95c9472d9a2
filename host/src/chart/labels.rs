//! Labels beside points, where there is room for them.

use super::font;

/// A rectangle: left, upper, right and lower limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Area {
    pub low: [f64; 2],
    pub high: [f64; 2],
}

impl Area {
    fn around([x, y]: [f64; 2], reach: f64) -> Self {
        Area {
            low: [x - reach, y - reach],
            high: [x + reach, y + reach],
        }
    }

    fn meets(&self, other: &Area) -> bool {
        (0..2).all(|axis| self.low[axis] < other.high[axis] && other.low[axis] < self.high[axis])
    }

    fn is_within(&self, other: &Area) -> bool {
        (0..2).all(|axis| self.low[axis] >= other.low[axis] && self.high[axis] <= other.high[axis])
    }

    fn nearest([x, y]: [f64; 2], area: &Area) -> [f64; 2] {
        [x.clamp(area.low[0], area.high[0]), y.clamp(area.low[1], area.high[1])]
    }
}

/// A label that somebody wants.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Wish<'a> {
    /// Where its point is.
    pub at: [f64; 2],
    pub text: &'a str,
    /// How far its marker reaches.
    pub reach: f64,
    /// Whether it is left out where there is no room nearby.
    pub is_optional: bool,
}

/// Where a label has its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// Left end of the line that its letters stand on.
    pub at: [f64; 2],
    /// A line to its point, where it is not close to it.
    pub leader: Option<[[f64; 2]; 2]>,
}

/// How far away from their markers labels may be.
const DISTANCES: [f64; 11] = [3.0, 7.0, 13.0, 21.0, 31.0, 43.0, 57.0, 75.0, 95.0, 120.0, 150.0];
/// Of those that are optional.
const NEAR: f64 = 57.0;
/// Directions in which a place is looked for, the best first, in sixteenths of a turn from the right, clockwise.
const DIRECTIONS: [u32; 16] = [0, 8, 15, 1, 12, 4, 14, 2, 9, 7, 10, 6, 13, 3, 11, 5];
/// Half the size of what a marker takes.
const MARKER: f64 = 6.0;

/// A place for each label within an area, off each other and off the obstacles, which are points; the first are served first.
pub(super) fn places(wishes: &[Wish<'_>], obstacles: &[[f64; 2]], within: &Area, size: f64) -> Vec<Option<Place>> {
    let mut taken: Vec<Area> = Vec::new();
    let mut leaders: Vec<[[f64; 2]; 2]> = Vec::new();
    let mut places = Vec::new();
    for wish in wishes {
        let extent = [font::width(wish.text, size), size];
        let found = candidates(wish, extent).find(|(area, _)| {
            let leader = [wish.at, Area::nearest(wish.at, area)];
            area.is_within(within)
                && !taken.iter().any(|other| area.meets(other) || crosses(&leader, other))
                && !obstacles.iter().any(|point| area.meets(&Area::around(*point, MARKER)))
                && !leaders.iter().any(|other| crosses(other, area) || cut(other, &leader))
        });
        let place = found.map(|(area, distance)| {
            let leader = [wish.at, Area::nearest(wish.at, &area)];
            taken.push(area);
            let is_away = distance > 7.0;
            if is_away {
                leaders.push(leader);
            }
            Place {
                at: [area.low[0], area.high[1] - 0.2 * size],
                leader: is_away.then_some(leader),
            }
        });
        places.push(place);
    }
    places
}

/// Where a label might be, with its distance from the point.
fn candidates<'a>(wish: &'a Wish<'a>, extent: [f64; 2]) -> impl Iterator<Item = (Area, f64)> + 'a {
    let distances = DISTANCES.into_iter();
    let distances = distances.take_while(move |distance| !wish.is_optional || *distance <= NEAR);
    distances.flat_map(move |distance| {
        DIRECTIONS.into_iter().map(move |direction| {
            let (sine, cosine) = (f64::from(direction) * std::f64::consts::PI / 8.0).sin_cos();
            let away = wish.reach + distance;
            // The side of the label that faces the point is this far away.
            let middle = [
                wish.at[0] + cosine * away + 0.5 * extent[0] * towards(cosine),
                wish.at[1] + sine * away + 0.5 * extent[1] * towards(sine),
            ];
            let low = [0, 1].map(|axis| middle[axis] - 0.5 * extent[axis]);
            let high = [0, 1].map(|axis| middle[axis] + 0.5 * extent[axis]);
            (Area { low, high }, distance)
        })
    })
}

fn towards(component: f64) -> f64 {
    (component * 1.6).clamp(-1.0, 1.0)
}

/// Whether a line passes through an area; sampled, for neither is small.
fn crosses([from, to]: &[[f64; 2]; 2], area: &Area) -> bool {
    (1..12).any(|step| {
        let at = [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * f64::from(step) / 12.0);
        area.meets(&Area::around(at, 0.5))
    })
}

/// Whether two lines cross.
fn cut(a: &[[f64; 2]; 2], b: &[[f64; 2]; 2]) -> bool {
    let side = |line: &[[f64; 2]; 2], point: [f64; 2]| {
        (line[1][0] - line[0][0]) * (point[1] - line[0][1]) - (line[1][1] - line[0][1]) * (point[0] - line[0][0])
    };
    side(a, b[0]) * side(a, b[1]) < 0.0 && side(b, a[0]) * side(b, a[1]) < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_of_a_crowd_keep_off_each_other() {
        let points: Vec<[f64; 2]> = (0..12).map(|index| [200.0 + f64::from(index) * 3.0, 150.0]).collect();
        let wishes: Vec<Wish<'_>> = points
            .iter()
            .map(|&at| Wish {
                at,
                text: "watertight",
                reach: 5.0,
                is_optional: false,
            })
            .collect();
        let within = Area {
            low: [0.0, 0.0],
            high: [500.0, 400.0],
        };
        let areas: Vec<Area> = places(&wishes, &points, &within, 10.0)
            .into_iter()
            .flatten()
            .map(|Place { at: [x, y], .. }| Area {
                low: [x, y - 8.0],
                high: [x + font::width("watertight", 10.0), y + 2.0],
            })
            .collect();
        // Lines that do not cross leave no room for all of so dense a crowd.
        assert!(areas.len() >= 6, "{}", areas.len());
        for (index, area) in areas.iter().enumerate() {
            assert!(area.is_within(&within));
            assert!(!areas[..index].iter().any(|other| other.meets(area)), "{area:?}");
        }
    }
}
