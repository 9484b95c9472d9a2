//! Text files: `solid`, facets of three vertices each, `endsolid`.

use super::fault::Fault;
use super::welder::Welder;
use crate::excerpt::excerpt;
use glam::DVec3;

/// Facets between two reports of progress.
const BLOCK: usize = 1 << 12;

/// Whether a file begins as text does.
pub(super) fn begins(bytes: &[u8]) -> bool {
    bytes
        .trim_ascii_start()
        .get(..5)
        .is_some_and(|word| word.eq_ignore_ascii_case(b"solid"))
}

/// Reads all facets.
pub(super) fn read(bytes: &[u8], welder: &mut Welder, progress: impl Fn(f32)) -> Result<(), Fault> {
    let mut words = Words {
        rest: bytes,
        line: 1,
        last: 1,
    };
    while let Some(word) = words.next() {
        match Keyword::of(word) {
            // What follows is a name.
            Some(Keyword::Solid | Keyword::EndSolid) => words.skip_line(),
            Some(Keyword::Facet) => {
                if welder.triangles.len().is_multiple_of(BLOCK) {
                    progress(1.0 - words.rest.len() as f32 / bytes.len() as f32);
                }
                welder.add(facet(&mut words)?)?;
            }
            _ => return Err(words.unexpected("facet or endsolid", word)),
        }
    }
    Ok(())
}

/// The corners of a facet whose first word was read.
fn facet(words: &mut Words<'_>) -> Result<[DVec3; 3], Fault> {
    words.expect("normal")?;
    for _ in 0..3 {
        // Nobody needs it, so it may be anything: some programs write nan for facets without area.
        words.some("three numbers of a normal")?;
    }
    words.expect("outer")?;
    words.expect("loop")?;
    let mut corners = [DVec3::ZERO; 3];
    for corner in &mut corners {
        words.expect("vertex")?;
        *corner = DVec3::new(words.number()?, words.number()?, words.number()?);
    }
    words.expect("endloop")?;
    words.expect("endfacet")?;
    Ok(corners)
}

/// A word that begins something.
enum Keyword {
    Solid,
    EndSolid,
    Facet,
}

impl Keyword {
    fn of(word: &[u8]) -> Option<Self> {
        Some(match () {
            () if word.eq_ignore_ascii_case(b"solid") => Keyword::Solid,
            () if word.eq_ignore_ascii_case(b"endsolid") => Keyword::EndSolid,
            () if word.eq_ignore_ascii_case(b"facet") => Keyword::Facet,
            () => return None,
        })
    }
}

/// The words of a text, which know their lines.
struct Words<'a> {
    rest: &'a [u8],
    /// Line of `rest`, from 1.
    line: usize,
    /// Line of the last word, from 1.
    last: usize,
}

impl<'a> Words<'a> {
    fn next(&mut self) -> Option<&'a [u8]> {
        let start = self.rest.iter().position(|byte| !byte.is_ascii_whitespace())?;
        self.line += newlines(&self.rest[..start]);
        self.last = self.line;
        let word = &self.rest[start..];
        let end = word.iter().position(u8::is_ascii_whitespace).unwrap_or(word.len());
        self.rest = &word[end..];
        Some(&word[..end])
    }

    fn skip_line(&mut self) {
        let end = self
            .rest
            .iter()
            .position(|byte| *byte == b'\n')
            .unwrap_or(self.rest.len());
        self.rest = &self.rest[end..];
    }

    fn some(&mut self, wanted: &'static str) -> Result<&'a [u8], Fault> {
        let line = self.last;
        self.next().ok_or(Fault::CutText { line, wanted })
    }

    fn expect(&mut self, wanted: &'static str) -> Result<(), Fault> {
        let word = self.some(wanted)?;
        if word.eq_ignore_ascii_case(wanted.as_bytes()) {
            Ok(())
        } else {
            Err(self.unexpected(wanted, word))
        }
    }

    fn number(&mut self) -> Result<f64, Fault> {
        let word = self.some("three coordinates of a vertex")?;
        let number = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
        match number {
            Some(number) if f64::is_finite(number) => Ok(number),
            _ => Err(Fault::Number {
                line: self.last,
                word: excerpt(word),
            }),
        }
    }

    fn unexpected(&self, wanted: &'static str, word: &[u8]) -> Fault {
        Fault::Unexpected {
            line: self.last,
            word: excerpt(word),
            wanted,
        }
    }
}

fn newlines(bytes: &[u8]) -> usize {
    bytes.iter().filter(|byte| **byte == b'\n').count()
}
