//! Numbers as programs write them in ascii files, put into the form that ply-rs reads.
//!
//! ply-rs 0.1.3 wants a digit on both sides of the point, a small `e` and no NaN.

/// A decimal number, cut into its parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Decimal<'a> {
    negative: bool,
    whole: &'a [u8],
    fraction: &'a [u8],
    /// With its sign; empty where there is none.
    exponent: &'a [u8],
}

impl<'a> Decimal<'a> {
    /// Takes `[+-](digits[.[digits]] | .digits)[(e|E)[+-]digits]`, and nothing else.
    pub(super) fn parse(word: &'a [u8]) -> Option<Self> {
        let (negative, rest) = match word {
            [b'-', rest @ ..] => (true, rest),
            [b'+', rest @ ..] => (false, rest),
            rest => (false, rest),
        };
        let (whole, rest) = digits(rest);
        let (fraction, rest) = match rest {
            [b'.', rest @ ..] => digits(rest),
            rest => (&[][..], rest),
        };
        if whole.is_empty() && fraction.is_empty() {
            return None;
        }
        let exponent = match rest {
            [] => rest,
            [b'e' | b'E', exponent @ ..] => {
                let unsigned = match exponent {
                    [b'+' | b'-', unsigned @ ..] => unsigned,
                    unsigned => unsigned,
                };
                match digits(unsigned) {
                    ([_, ..], []) => exponent,
                    _ => return None,
                }
            }
            _ => return None,
        };
        Some(Self {
            negative,
            whole,
            fraction,
            exponent,
        })
    }

    /// Appends the number in ply-rs's form, with every digit it has.
    pub(super) fn write(self, text: &mut String) {
        if self.negative {
            text.push('-');
        }
        push_digits(text, if self.whole.is_empty() { b"0" } else { self.whole });
        if !self.fraction.is_empty() {
            text.push('.');
            push_digits(text, self.fraction);
        }
        if !self.exponent.is_empty() {
            text.push('e');
            push_digits(text, self.exponent);
        }
    }

    /// The number, where it is a whole one that i64 holds; `3.0` and `3e0` are whole.
    pub(super) fn whole(self) -> Option<i64> {
        if self.exponent.is_empty() && self.fraction.iter().all(|&digit| digit == b'0') {
            let mut value: i64 = 0;
            for digit in self.whole {
                value = value.checked_mul(10)?.checked_add(i64::from(digit - b'0'))?;
            }
            return Some(if self.negative { -value } else { value });
        }
        let mut text = String::new();
        self.write(&mut text);
        let value: f64 = text.parse().ok()?;
        // Beyond 2^53 an f64 no longer says which whole number was meant.
        (value.fract() == 0.0 && value.abs() <= 9_007_199_254_740_992.0).then_some(value as i64)
    }
}

/// Whether this is how some program writes NaN or infinity (`nan`, `-nan(ind)`, `Infinity`, `1.#QNAN`).
pub(super) fn is_not_finite(word: &[u8]) -> bool {
    let unsigned = match word {
        [b'+' | b'-', unsigned @ ..] => unsigned,
        unsigned => unsigned,
    };
    let starts_with = |name: &[u8]| {
        unsigned
            .get(..name.len())
            .is_some_and(|start| start.eq_ignore_ascii_case(name))
    };
    starts_with(b"nan") || starts_with(b"inf") || starts_with(b"1.#")
}

fn digits(text: &[u8]) -> (&[u8], &[u8]) {
    let end = text
        .iter()
        .position(|byte| !byte.is_ascii_digit())
        .unwrap_or(text.len());
    text.split_at(end)
}

fn push_digits(text: &mut String, digits: &[u8]) {
    // All ASCII, so every byte is a character.
    text.extend(digits.iter().map(|&byte| char::from(byte)));
}
