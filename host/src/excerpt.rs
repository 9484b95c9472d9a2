//! Quoting files in messages.

/// Text from a file, fit for an error message: at most 40 characters, nothing that a terminal obeys.
pub(crate) fn excerpt(text: &[u8]) -> String {
    const LONGEST: usize = 40;
    let text = text.trim_ascii();
    // A character takes four bytes at most.
    let start = String::from_utf8_lossy(&text[..text.len().min(4 * LONGEST)]);
    let mut excerpt: String = start.chars().take(LONGEST).flat_map(char::escape_debug).collect();
    if start.chars().nth(LONGEST).is_some() || text.len() > 4 * LONGEST {
        excerpt.push_str("...");
    }
    excerpt
}
