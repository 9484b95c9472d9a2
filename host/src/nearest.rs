//! What somebody meant who mistyped a word.

use strsim::damerau_levenshtein;

/// The word that takes the fewest changes to come from `typed`, if they are few.
pub fn nearest<'a>(typed: &str, words: &[&'a str]) -> Option<&'a str> {
    let typed = typed.to_lowercase();
    words
        .iter()
        .map(|word| (damerau_levenshtein(&typed, &word.to_lowercase()), *word))
        .min()
        .filter(|(changes, word)| *changes <= 1 + word.chars().count() / 3)
        .map(|(_, word)| word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_and_far() {
        let words = ["drag", "wheel", "wait"];
        assert_eq!(nearest("Darg", &words), Some("drag"));
        assert_eq!(nearest("whel", &words), Some("wheel"));
        assert_eq!(nearest("screenshot", &words), None);
    }
}
