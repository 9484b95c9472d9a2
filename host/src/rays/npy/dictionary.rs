//! The header of a `.npy` file: a Python dictionary with three keys.

/// What the header of an array of numbers says.
#[derive(Debug, PartialEq)]
pub struct Dictionary<'a> {
    /// Type of the elements, such as `<f4`.
    pub descr: &'a str,
    /// Whether the first index varies fastest.
    pub fortran_order: bool,
    /// Length of each axis.
    pub shape: Vec<u64>,
}

impl<'a> Dictionary<'a> {
    /// Understands a header, or says what is wrong with it.
    pub fn parse(text: &'a str) -> Result<Self, String> {
        let mut text = Text(text);
        let (mut descr, mut fortran_order, mut shape) = (None, None, None);
        text.expect('{')?;
        while !text.eat('}') {
            let key = text.quoted()?;
            text.expect(':')?;
            match key {
                // The descriptions of arrays of records are lists.
                "descr" if text.starts_with('[') => return Err("its elements have several fields".into()),
                "descr" => descr = Some(text.quoted()?),
                "fortran_order" => fortran_order = Some(text.boolean()?),
                "shape" => shape = Some(text.tuple()?),
                other => return Err(format!("it has the key \"{}\"", shortened(other))),
            }
            if !text.eat(',') && !text.starts_with('}') {
                return Err(text.unexpected("a comma"));
            }
        }
        Ok(Dictionary {
            descr: descr.ok_or("it lacks the type of the elements, descr")?,
            fortran_order: fortran_order.ok_or("it lacks the order of the elements, fortran_order")?,
            shape: shape.ok_or("it lacks the shape")?,
        })
    }
}

/// What is left of the header.
struct Text<'a>(&'a str);

impl<'a> Text<'a> {
    fn starts_with(&mut self, wanted: char) -> bool {
        self.0 = self.0.trim_ascii_start();
        self.0.starts_with(wanted)
    }

    fn eat(&mut self, wanted: char) -> bool {
        let is_there = self.starts_with(wanted);
        if is_there {
            self.0 = &self.0[wanted.len_utf8()..];
        }
        is_there
    }

    fn expect(&mut self, wanted: char) -> Result<(), String> {
        if self.eat(wanted) {
            Ok(())
        } else {
            Err(self.unexpected(&format!("\"{wanted}\"")))
        }
    }

    fn quoted(&mut self) -> Result<&'a str, String> {
        let quote = if self.eat('\'') {
            '\''
        } else if self.eat('"') {
            '"'
        } else {
            return Err(self.unexpected("a string"));
        };
        let (content, rest) = self.0.split_once(quote).ok_or("a string has no end")?;
        self.0 = rest;
        Ok(content)
    }

    fn boolean(&mut self) -> Result<bool, String> {
        for (name, value) in [("True", true), ("False", false)] {
            if let Some(rest) = self.0.trim_ascii_start().strip_prefix(name) {
                self.0 = rest;
                return Ok(value);
            }
        }
        Err(self.unexpected("True or False"))
    }

    fn tuple(&mut self) -> Result<Vec<u64>, String> {
        let mut numbers = Vec::new();
        self.expect('(')?;
        while !self.eat(')') {
            self.0 = self.0.trim_ascii_start();
            let end = self.0.find(|c: char| !c.is_ascii_digit()).unwrap_or(self.0.len());
            let (digits, rest) = self.0.split_at(end);
            let number = digits.parse().map_err(|_| self.unexpected("a size"))?;
            numbers.push(number);
            // Python 2 wrote long integers so.
            self.0 = rest.strip_prefix('L').unwrap_or(rest);
            if !self.eat(',') && !self.starts_with(')') {
                return Err(self.unexpected("a comma"));
            }
        }
        Ok(numbers)
    }

    fn unexpected(&self, wanted: &str) -> String {
        format!("{wanted} should stand where it has \"{}\"", shortened(self.0))
    }
}

/// The beginning of a text, with control characters escaped.
fn shortened(text: &str) -> String {
    text.chars().take(20).flat_map(char::escape_debug).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_as_numpy_writes_them() {
        let text = "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 6), }          \n";
        let wanted = Dictionary {
            descr: "<f8",
            fortran_order: false,
            shape: vec![3, 6],
        };
        assert_eq!(Dictionary::parse(text), Ok(wanted));
        let text = "{ \"shape\":(3L,),'fortran_order':True,'descr' : '|b1'}";
        let wanted = Dictionary {
            descr: "|b1",
            fortran_order: true,
            shape: vec![3],
        };
        assert_eq!(Dictionary::parse(text), Ok(wanted));
        assert_eq!(
            Dictionary::parse("{'descr': '<f4', 'fortran_order': False, 'shape': ()}").map(|d| d.shape),
            Ok(Vec::new())
        );
    }

    #[test]
    fn others_are_refused_with_a_reason() {
        for (text, reason) in [
            ("", "\"{\""),
            ("{", "a string"),
            ("{'descr", "no end"),
            ("{'descr': '<f4', }", "fortran_order"),
            ("{'descr': [('x', '<f4')], }", "several fields"),
            ("{'descr': '<f4', 'fortran_order': 1, }", "True or False"),
            ("{'descr': '<f4', 'fortran_order': True, 'shape': (-1, 6), }", "a size"),
            (
                "{'descr': '<f4', 'fortran_order': True, 'shape': (99999999999999999999, 6), }",
                "a size",
            ),
            (
                "{'descr': '<f4', 'fortran_order': True, 'shape': ((((((((((1, 6), }",
                "a size",
            ),
            ("{'descr': '<f4', 'fortran_order': True, 'shape': (1 6), }", "a comma"),
            ("{'descr': '<f4' 'fortran_order': True, 'shape': (1, 6), }", "a comma"),
            ("{'answer': 42}", "answer"),
        ] {
            let error = Dictionary::parse(text).unwrap_err();
            assert!(error.contains(reason), "{text}: {error}");
        }
    }
}
