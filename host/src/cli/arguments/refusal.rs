//! What would do where a combination of parts is not offered.

use oktant_shared::parts::{BoxKind, Parts};

/// Why a combination is refused, in one sentence that says what would do.
pub fn refusal(parts: Parts) -> String {
    let Parts {
        traversal,
        triangle,
        box_test,
    } = parts;
    if !traversal.takes_box_test() && box_test != BoxKind::default() {
        return format!("--box {box_test} does nothing with --traversal {traversal}; leave it out.");
    }
    let offered = Parts::OFFERED.iter().filter(|parts| parts.traversal == traversal);
    let choices: Vec<String> = offered
        .map(|parts| match traversal.takes_box_test() {
            true => format!("--triangle {} --box {}", parts.triangle, parts.box_test),
            false => format!("--triangle {}", parts.triangle),
        })
        .collect();
    let asked = match traversal.takes_box_test() {
        true => format!("--triangle {triangle} --box {box_test}"),
        false => format!("--triangle {triangle}"),
    };
    format!(
        "--traversal {traversal} is not offered with {asked}; give {}.",
        choices.join(", or ")
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use oktant_shared::parts::{TraversalKind, TriangleKind};

    #[test]
    fn what_is_refused_is_told_with_what_would_do() {
        let plucker = Parts {
            triangle: TriangleKind::Plucker,
            traversal: TraversalKind::Bvh2,
            ..Parts::default()
        };
        assert_eq!(
            refusal(plucker),
            "--traversal bvh2 is not offered with --triangle plucker --box kay-kajiya; give --triangle watertight --box \
             kay-kajiya, or --triangle watertight --box williams."
        );
        let brute = Parts {
            traversal: TraversalKind::Brute,
            ..plucker
        };
        assert_eq!(
            refusal(brute),
            "--traversal brute is not offered with --triangle plucker; give --triangle watertight."
        );
        let boxes = Parts {
            box_test: BoxKind::Williams,
            ..Parts::default()
        };
        assert_eq!(
            refusal(boxes),
            "--box williams does nothing with --traversal octants; leave it out."
        );
    }

    #[test]
    fn what_takes_no_box_test_is_offered_with_none() {
        for parts in Parts::OFFERED {
            assert!(
                parts.traversal.takes_box_test() || parts.box_test == BoxKind::default(),
                "{parts}"
            );
        }
    }
}
