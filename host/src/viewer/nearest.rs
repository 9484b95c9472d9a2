//! What somebody meant who mistyped a word.

/// The word that takes the fewest changes to come from `typed`, if they are few.
pub fn nearest<'a>(typed: &str, words: &[&'a str]) -> Option<&'a str> {
    let typed = typed.to_lowercase();
    words
        .iter()
        .map(|word| (changes(&typed, &word.to_lowercase()), *word))
        .min()
        .filter(|(changes, word)| *changes <= 1 + word.chars().count() / 3)
        .map(|(_, word)| word)
}

/// Letters to insert, remove or replace (V. I. Levenshtein, "Binary codes capable of correcting deletions, insertions,
/// and reversals", 1966).
fn changes(from: &str, to: &str) -> usize {
    let to: Vec<char> = to.chars().collect();
    let mut row: Vec<usize> = (0..=to.len()).collect();
    for (i, letter) in from.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, other) in to.iter().enumerate() {
            let replaced = diagonal + usize::from(letter != *other);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[to.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_and_far() {
        assert_eq!((changes("", "abc"), changes("kitten", "sitting")), (3, 3));
        let words = ["drag", "wheel", "wait"];
        assert_eq!(nearest("Darg", &words), Some("drag"));
        assert_eq!(nearest("whel", &words), Some("wheel"));
        assert_eq!(nearest("screenshot", &words), None);
    }
}
