//! What explains times best.

use crate::costs::Costs;

/// A time of rays, and what they did in it.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Steps of a ray, in the mean.
    pub nodes: f64,
    /// Triangle tests of a ray, in the mean.
    pub tests: f64,
    /// Nanoseconds for a ray.
    pub time: f64,
}

/// Costs, and how well they explain the times that they were fitted to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// Nanoseconds for a ray.
    pub costs: Costs,
    /// Root of the mean square of what is not explained, as a part of the time.
    pub residual: f64,
}

/// The costs of a step and a test with which the squares of what they do not explain are least, each time counted as a part
/// of its group's mean. Samples of a group have the same rays: whatever else these take is the same too, and of no interest.
///
/// `None` where steps and tests cannot be told apart, or one of them seems to cost nothing.
pub fn fit(groups: &[Vec<Sample>]) -> Option<Fit> {
    let mut rows = Vec::new();
    for group in groups {
        let mean = |part: fn(&Sample) -> f64| group.iter().map(part).sum::<f64>() / group.len() as f64;
        let (nodes, tests, time) = (mean(|one| one.nodes), mean(|one| one.tests), mean(|one| one.time));
        rows.extend(group.iter().map(|one| {
            let relative = [one.nodes - nodes, one.tests - tests, one.time - time];
            relative.map(|part| part / time)
        }));
    }
    let sum = |i: usize, j: usize| rows.iter().map(|row| row[i] * row[j]).sum::<f64>();
    let (aa, ab, bb, at, bt) = (sum(0, 0), sum(0, 1), sum(1, 1), sum(0, 2), sum(1, 2));
    let determinant = aa * bb - ab * ab;
    let node = (at * bb - bt * ab) / determinant;
    let triangle = (bt * aa - at * ab) / determinant;
    if !(determinant > 1e-9 * aa * bb && node > 0.0 && triangle > 0.0) {
        return None;
    }
    let squares = rows
        .iter()
        .map(|row| (node * row[0] + triangle * row[1] - row[2]).powi(2));
    Some(Fit {
        costs: Costs {
            node: node as f32,
            triangle: triangle as f32,
        },
        residual: (squares.sum::<f64>() / rows.len() as f64).sqrt(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn group(overhead: f64, error: f64) -> Vec<Sample> {
        let shapes = [(20.0, 3.0), (12.0, 5.0), (8.0, 9.0), (5.0, 20.0), (4.0, 41.0)];
        let of = |(at, (nodes, tests)): (usize, (f64, f64))| Sample {
            nodes,
            tests,
            time: (overhead + 3.0 * nodes + 1.5 * tests) * (1.0 + error * [1.0, -1.0, 0.0, -1.0, 1.0][at]),
        };
        shapes.into_iter().enumerate().map(of).collect()
    }

    #[test]
    fn known_costs_are_found_whatever_else_rays_take() {
        let found = fit(&[group(0.0, 0.0), group(100.0, 0.0)]).unwrap();
        assert!((found.costs.node - 3.0).abs() < 1e-5 && (found.costs.triangle - 1.5).abs() < 1e-5);
        assert!(found.residual < 1e-9);
        let rough = fit(&[group(0.0, 0.02), group(10.0, -0.02)]).unwrap();
        assert!((rough.costs.node - 3.0).abs() < 0.3 && (rough.costs.triangle - 1.5).abs() < 0.15);
        assert!(rough.residual > 0.005);
    }

    #[test]
    fn what_cannot_be_told_apart_is_refused() {
        let alike = |scale: f64| Sample {
            nodes: 2.0 * scale,
            tests: scale,
            time: 10.0 * scale,
        };
        assert_eq!(fit(&[vec![alike(1.0), alike(2.0), alike(3.0)]]), None);
        assert_eq!(fit(&[vec![alike(1.0)]]), None);
        let mut cheaper = group(0.0, 0.0);
        for sample in &mut cheaper {
            sample.time = 100.0 - sample.tests;
        }
        assert_eq!(fit(&[cheaper]), None, "tests that save time");
    }
}
