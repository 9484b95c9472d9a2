//! The lines of OBJ and MTL files.

use std::borrow::Cow;

/// A line with something on it.
pub(super) struct Line<'a> {
    /// From 1; where it goes on after a backslash, that of its beginning.
    pub(super) number: usize,
    text: Cow<'a, [u8]>,
}

impl Line<'_> {
    /// The first word, and what follows it.
    pub(super) fn split(&self) -> (&[u8], &[u8]) {
        let text = &self.text;
        let end = text.iter().position(u8::is_ascii_whitespace).unwrap_or(text.len());
        (&text[..end], text[end..].trim_ascii())
    }
}

/// The words of a text.
pub(super) fn words(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// The lines of a file that have something on them but comments.
pub(super) fn lines(bytes: &[u8]) -> impl Iterator<Item = Line<'_>> {
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let mut physical = (1..).zip(bytes.split(|byte| *byte == b'\n'));
    std::iter::from_fn(move || {
        loop {
            let (number, first) = physical.next()?;
            let mut text = Cow::Borrowed(uncommented(first));
            while let Some(start) = text.strip_suffix(b"\\") {
                let mut joined = start.to_vec();
                joined.push(b' ');
                let next = physical.next().map_or(&b""[..], |(_, next)| uncommented(next));
                joined.extend(next);
                text = Cow::Owned(joined);
            }
            if !text.is_empty() {
                return Some(Line { number, text });
            }
        }
    })
}

fn uncommented(line: &[u8]) -> &[u8] {
    let end = line.iter().position(|byte| *byte == b'#').unwrap_or(line.len());
    line[..end].trim_ascii()
}

/// A finite number.
pub(super) fn number(word: &[u8]) -> Option<f64> {
    let number: f64 = std::str::from_utf8(word).ok()?.parse().ok()?;
    number.is_finite().then_some(number)
}
