//! The lines of a text, numbered.

/// One line, without its end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<'a> {
    /// From 1, in the whole file.
    pub(super) number: usize,
    /// May be blank, may end in `\r`.
    pub(super) text: &'a [u8],
    /// Where the next line starts, in bytes from where these [`Lines`] started.
    pub(super) next: usize,
}

impl<'a> Line<'a> {
    /// What stands between blanks and tabs.
    pub(super) fn words(self) -> impl Iterator<Item = &'a [u8]> {
        self.text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
    }

    /// Whether there are no words.
    pub(super) fn is_blank(self) -> bool {
        self.text.iter().all(u8::is_ascii_whitespace)
    }
}

/// Iterates over the lines of a text; the last one may lack its end.
#[derive(Clone, Debug)]
pub(super) struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
    number: usize,
    end: u8,
}

impl<'a> Lines<'a> {
    /// The lines of `bytes`, of which the first has number `first` and all end in the byte `end`.
    pub(super) fn new(bytes: &'a [u8], first: usize, end: u8) -> Self {
        Self {
            bytes,
            at: 0,
            number: first,
            end,
        }
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = Line<'a>;

    fn next(&mut self) -> Option<Line<'a>> {
        let rest = &self.bytes[self.at..];
        if rest.is_empty() {
            return None;
        }
        let (text, used) = match rest.iter().position(|&byte| byte == self.end) {
            Some(length) => (&rest[..length], length + 1),
            None => (rest, rest.len()),
        };
        self.at += used;
        self.number += 1;
        Some(Line {
            number: self.number - 1,
            text,
            next: self.at,
        })
    }
}
