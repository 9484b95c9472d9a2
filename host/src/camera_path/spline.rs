//! A smooth curve through points in time.
//!
//! E. Catmull and R. Rom, "A class of local interpolating splines", 1974, of degree 3, with times as in P. Barry and
//! R. Goldman, "A recursive evaluation algorithm for a class of Catmull-Rom splines", 1988: the slope in a knot is that of
//! the parabola through it and its neighbours. At the ends, where one neighbour is missing, it is that of the line to the
//! other. It is computed in the form of Hermite, which meets the knots exactly.

/// A point that the curve passes through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knot<const N: usize> {
    /// When.
    pub time: f64,
    /// Where.
    pub value: [f64; N],
}

/// The curve at a time. There is at least one knot, and each is later than the one before; before the first the curve is
/// there, after the last there.
pub fn value<const N: usize>(knots: &[Knot<N>], time: f64) -> [f64; N] {
    let after = knots.partition_point(|knot| knot.time <= time);
    let (Some(before), Some(next)) = (after.checked_sub(1), knots.get(after)) else {
        return knots[after.min(knots.len() - 1)].value;
    };
    let knot = &knots[before];
    let length = next.time - knot.time;
    let u = (time - knot.time) / length;
    let [from, to] = [slopes(knots, before), slopes(knots, after)];
    // The cubic polynomials of Hermite.
    let end = u * u * (3.0 - 2.0 * u);
    let leaving = u * (1.0 - u) * (1.0 - u);
    let arriving = u * u * (u - 1.0);
    std::array::from_fn(|i| {
        knot.value[i] + end * (next.value[i] - knot.value[i]) + length * (leaving * from[i] + arriving * to[i])
    })
}

/// How fast each number changes in a knot.
fn slopes<const N: usize>(knots: &[Knot<N>], at: usize) -> [f64; N] {
    let chord = |from: &Knot<N>, to: &Knot<N>| -> ([f64; N], f64) {
        let length = to.time - from.time;
        (std::array::from_fn(|i| (to.value[i] - from.value[i]) / length), length)
    };
    let before = at.checked_sub(1).map(|before| chord(&knots[before], &knots[at]));
    let after = knots.get(at + 1).map(|next| chord(&knots[at], next));
    match (before, after) {
        (Some((before, length_before)), Some((after, length_after))) => std::array::from_fn(|i| {
            (before[i] * length_after + after[i] * length_before) / (length_before + length_after)
        }),
        (Some((slopes, _)), None) | (None, Some((slopes, _))) => slopes,
        (None, None) => [0.0; N],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn knots(of: impl Fn(f64) -> f64) -> Vec<Knot<1>> {
        let times = [-2.0, 0.0, 0.5, 3.0, 4.0, 4.25];
        times
            .map(|time| Knot {
                time,
                value: [of(time)],
            })
            .to_vec()
    }

    #[test]
    fn knots_are_met_exactly() {
        let knots = knots(|time| (time * 7.7).sin() * 1e3);
        for knot in &knots {
            assert_eq!(value(&knots, knot.time), knot.value);
        }
        assert_eq!(value(&knots, -9.0), knots[0].value);
        assert_eq!(value(&knots, 9.0), knots[5].value);
        assert_eq!(value(&knots[..1], 1.0), knots[0].value);
    }

    #[test]
    fn lines_are_kept_and_so_are_parabolas_between_inner_knots() {
        let line = |time: f64| 3.0 - 2.0 * time;
        let parabola = |time: f64| time * time - time;
        for i in 0..=100 {
            let time = -2.0 + f64::from(i) * 0.0625;
            assert!((value(&knots(line), time)[0] - line(time)).abs() < 1e-12);
            if (0.0..=4.0).contains(&time) {
                assert!(
                    (value(&knots(parabola), time)[0] - parabola(time)).abs() < 1e-12,
                    "{time}"
                );
            }
        }
    }

    #[test]
    fn speed_has_no_jumps() {
        let knots = knots(|time| (time * 3.0).cos());
        let h = 1e-6;
        for knot in &knots[1..5] {
            let at = |time| value(&knots, time)[0];
            let [before, after] = [at(knot.time) - at(knot.time - h), at(knot.time + h) - at(knot.time)];
            assert!((before - after).abs() / h < 1e-4, "at {}", knot.time);
        }
    }
}
