//! What devices are made to suffer, so that tests see what comes of it.

use std::sync::atomic::{AtomicU64, Ordering};

/// The variable of the environment that says so.
const VARIABLE: &str = "OKTANT_TEST_GPU";

/// Limits below a device's own.
#[derive(Debug)]
pub(super) struct Hardship {
    /// The largest binding, bytes.
    pub(super) binding: u64,
    /// The largest scene, bytes: what is beyond counts as out of memory.
    pub(super) memory: u64,
    /// Whether a software adapter counts as a GPU in any case.
    pub(super) software: bool,
    /// It is lost instead of being waited for when this comes to 0.
    waits: AtomicU64,
}

impl Default for Hardship {
    fn default() -> Self {
        Hardship {
            binding: u64::MAX,
            memory: u64::MAX,
            software: false,
            waits: AtomicU64::new(u64::MAX),
        }
    }
}

impl Hardship {
    /// What the environment says: any of `software`, `binding=BYTES`, `memory=BYTES` and `waits=N`, separated by commas.
    ///
    /// # Errors
    /// What it says else, in words.
    pub(super) fn of_environment() -> Result<Self, String> {
        let text = std::env::var(VARIABLE).unwrap_or_default();
        Self::parse(&text).ok_or_else(|| {
            format!("{VARIABLE} is \"{text}\", and takes software, binding=BYTES, memory=BYTES and waits=N, separated by commas")
        })
    }

    fn parse(text: &str) -> Option<Self> {
        let mut hardship = Hardship::default();
        for part in text.split(',').filter(|part| !part.is_empty()) {
            if part == "software" {
                hardship.software = true;
                continue;
            }
            let (name, number) = part.split_once('=')?;
            let number = number.parse().ok()?;
            match name {
                "binding" => hardship.binding = number,
                "memory" => hardship.memory = number,
                "waits" => hardship.waits = AtomicU64::new(number),
                _ => return None,
            }
        }
        Some(hardship)
    }

    /// Whether the device is to be lost now that it is waited for.
    pub(super) fn ends_here(&self) -> bool {
        self.waits.fetch_sub(1, Ordering::Relaxed) == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_read() {
        let hardship = Hardship::parse("software,memory=1000,waits=2").unwrap();
        assert_eq!(
            (hardship.software, hardship.binding, hardship.memory),
            (true, u64::MAX, 1000)
        );
        assert_eq!([(); 4].map(|()| hardship.ends_here()), [false, false, true, false]);
        assert!(!Hardship::parse("").unwrap().ends_here());
        for wrong in ["memory", "memory=much", "luck=3"] {
            assert!(Hardship::parse(wrong).is_none(), "{wrong}");
        }
    }
}
