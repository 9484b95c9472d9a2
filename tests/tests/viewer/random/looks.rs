//! What is to be seen at last.

use super::files::{LAST, last_scene};
use super::settings::Settings;
use crate::window::{Report, Session, agreement, value_in};
use std::collections::BTreeSet;

/// What keys may have turned on or off: figures, the list of keys, and four kinds of cells; which, nobody knows.
const STATES: usize = 16;
/// Begins what is printed of the settings.
const SETTINGS: &str = "set backend ";

/// A look at the window, by who renders.
#[derive(Clone, Copy)]
pub enum Look {
    Cpu,
    Gpu,
}

impl Look {
    fn name(self) -> &'static str {
        match self {
            Look::Cpu => "cpu",
            Look::Gpu => "gpu",
        }
    }

    /// Steps that print what is set, save the picture, and what the window shows in each state.
    pub fn steps(self) -> String {
        let name = self.name();
        let mut steps = format!("print settings\ncamera arguments\nprint\nexpect backend {name}\n");
        for state in 0..STATES {
            steps += &format!("screenshot {name}-{state}.png\n");
            steps += if state % 2 == 0 { "key I\n" } else { "key H\n" };
            if state % 4 == 3 {
                steps += "key C\n";
            }
            steps += "wait settled\n";
        }
        steps + &format!("save {name}.png\n")
    }

    /// Holds what was saved and shown against what `oktant render` makes of what was printed.
    pub fn compare(self, session: &Session, report: &Report, seed: u64) {
        let name = self.name();
        let printed = &report.standard_output;
        let start = printed.find(&format!("{SETTINGS}{name}\n")).expect("it was printed");
        let printed = &printed[start..];
        let end = printed[1..].find(SETTINGS).expect("they are printed again") + 1;
        let printed = &printed[..end];
        let settings = Settings::read(printed);
        let wanted = settings.rendered(session, &last_scene(), &value_in(printed, "size"), name);
        let colors: BTreeSet<_> = wanted.pixels().map(|pixel| pixel.0).collect();
        assert!(colors.len() > 10, "seed {seed}: there is nothing to see");
        let saved = session.await_picture(&format!("{name}.png"));
        assert_eq!(saved.dimensions(), wanted.dimensions());
        let differ = saved.pixels().zip(wanted.pixels()).filter(|(a, b)| a != b).count();
        assert_eq!(
            differ, 0,
            "seed {seed}: pixels of {LAST} differ on the {name}; {report}"
        );
        // A GPU draws the window once one was opened, also what the CPU has rendered, and encodes its colours itself: some
        // are rounded otherwise than in a file, by a step.
        let shown = (0..STATES).map(|state| session.await_picture(&format!("{name}-{state}.png")));
        let best = shown.map(|shown| agreement(&shown, &wanted)).fold(0.0, f64::max);
        assert_eq!(
            best, 1.0,
            "seed {seed}: the window shows something else on the {name}; {report}"
        );
    }
}
