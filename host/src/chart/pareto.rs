//! The Pareto front: what nothing else beats in one respect without losing in the other.

use serde::{Deserialize, Serialize};

/// Which values are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Better {
    /// Small ones.
    Lower,
    /// Great ones.
    Higher,
}

impl Better {
    /// The value such that less is better.
    fn cost(self, value: f64) -> f64 {
        match self {
            Better::Lower => value,
            Better::Higher => -value,
        }
    }
}

/// Which of the points no other dominates, which is to be as good in both respects and better in one; in the order of x.
/// Points that are the same do not dominate each other.
pub fn front(points: &[[f64; 2]], better: [Better; 2]) -> Vec<usize> {
    let costs: Vec<[f64; 2]> = points
        .iter()
        .map(|point| [better[0].cost(point[0]), better[1].cost(point[1])])
        .collect();
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&a, &b| {
        costs[a][0]
            .total_cmp(&costs[b][0])
            .then(costs[a][1].total_cmp(&costs[b][1]))
    });
    let mut front: Vec<usize> = Vec::new();
    for index in order {
        let is_better = front
            .last()
            .is_none_or(|&last| costs[index][1] < costs[last][1] || costs[index] == costs[last]);
        if is_better {
            front.push(index);
        }
    }
    front.sort_by(|&a, &b| points[a][0].total_cmp(&points[b][0]));
    front
}
