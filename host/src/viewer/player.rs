//! Where a script is that the window plays.

use super::event::{Button, Event, Key, Modifiers};
use super::script::Script;
use super::step::Step;
use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// Between two events that a step makes.
const EVENT_INTERVAL: Duration = Duration::from_millis(8);
/// Moves that a drag is made of.
const MOVES: u32 = 10;
/// A step that waits longer has failed.
pub const PATIENCE: Duration = Duration::from_secs(60);

/// What a step may wait for.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counts {
    /// New pictures shown.
    pub frames: u64,
    /// Loads done of what was shown already.
    pub reloads: u64,
}

/// A script and the place in it.
#[derive(Debug)]
pub struct Player {
    script: Script,
    next: usize,
    since: Instant,
    counts: Counts,
    events: VecDeque<Event>,
    next_event: Instant,
    begun: bool,
}

impl Player {
    /// At the beginning of a script.
    pub fn new(script: Script, now: Instant) -> Self {
        Player {
            script,
            next: 0,
            since: now,
            counts: Counts::default(),
            events: VecDeque::new(),
            next_event: now,
            begun: false,
        }
    }

    /// The file, for messages.
    pub fn file(&self) -> &str {
        &self.script.file
    }

    /// The step in progress and its line; none at the end.
    pub fn step(&self) -> Option<(usize, Step)> {
        self.script.steps.get(self.next).cloned()
    }

    /// True once for each step.
    pub fn begins(&mut self, now: Instant, counts: Counts) -> bool {
        if self.begun {
            return false;
        }
        self.begun = true;
        self.since = now;
        self.counts = counts;
        true
    }

    /// How long the step has been in progress.
    pub fn elapsed(&self, now: Instant) -> Duration {
        now.saturating_duration_since(self.since)
    }

    /// What there was when the step began.
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// On to the next step.
    pub fn advance(&mut self) {
        self.next += 1;
        self.begun = false;
    }

    /// Queues events.
    pub fn queue(&mut self, events: impl IntoIterator<Item = Event>) {
        self.events.extend(events);
    }

    /// Whether all events have been taken.
    pub fn is_idle(&self) -> bool {
        self.events.is_empty()
    }

    /// The next event, if it is time for it.
    pub fn event(&mut self, now: Instant) -> Option<Event> {
        if now < self.next_event {
            return None;
        }
        let event = self.events.pop_front()?;
        self.next_event = now + EVENT_INTERVAL;
        Some(event)
    }

    /// When there is something to do again.
    pub fn wakes(&self, now: Instant) -> Instant {
        self.next_event.max(now + EVENT_INTERVAL)
    }
}

/// The events of a drag from the middle of a window.
pub fn drag(size: [u32; 2], button: Button, shift: bool, by: [f64; 2]) -> Vec<Event> {
    let modifiers = |shift| Event::Modifiers(Modifiers { shift, control: false });
    let at = |part: f64| Event::PointerMoved {
        x: f64::from(size[0]) / 2.0 + by[0] * part,
        y: f64::from(size[1]) / 2.0 + by[1] * part,
    };
    let mut events = vec![at(0.0), modifiers(shift), Event::Button { button, pressed: true }];
    events.extend((1..=MOVES).map(|i| at(f64::from(i) / f64::from(MOVES))));
    events.extend([Event::Button { button, pressed: false }, modifiers(false)]);
    events
}

/// The events of a click at a place, physical pixels.
pub fn click([x, y]: [f64; 2]) -> Vec<Event> {
    let button = |pressed| Event::Button {
        button: Button::Left,
        pressed,
    };
    vec![Event::PointerMoved { x, y }, button(true), button(false)]
}

/// The events of a double click.
pub fn double_click() -> Vec<Event> {
    let button = |pressed| Event::Button {
        button: Button::Left,
        pressed,
    };
    vec![button(true), button(false), button(true), button(false)]
}

/// The events of a pin.
pub fn pin([x, y]: [f64; 2]) -> Vec<Event> {
    let modifiers = |control| Event::Modifiers(Modifiers { shift: false, control });
    let button = |pressed| Event::Button {
        button: Button::Left,
        pressed,
    };
    let moved = Event::PointerMoved { x, y };
    vec![moved, modifiers(true), button(true), button(false), modifiers(false)]
}

/// The events of a key.
pub fn key(key: Key, modifiers: Modifiers) -> Vec<Event> {
    vec![
        Event::Modifiers(modifiers),
        Event::Key(key),
        Event::Released(key),
        Event::Modifiers(Modifiers::default()),
    ]
}

#[cfg(test)]
mod tests {
    use super::super::input::Input;
    use super::super::seeing::See;
    use super::super::translation::Translation;
    use super::*;

    #[test]
    fn a_drag_goes_all_the_way() {
        let mut translation = Translation::default();
        let now = Instant::now();
        let mut sum = [0.0, 0.0];
        for event in drag([800, 600], Button::Left, true, [100.0, -50.0]) {
            if let Some(input) = translation.translate(&event, now) {
                let Input::Pan { right, down } = input else {
                    panic!("{input:?}");
                };
                sum = [sum[0] + right, sum[1] + down];
            }
        }
        assert!((sum[0] - 100.0).abs() < 1e-3 && (sum[1] + 50.0).abs() < 1e-3, "{sum:?}");
    }

    #[test]
    fn clicks_and_keys() {
        let inputs = |events: Vec<Event>| {
            let mut translation = Translation::default();
            let now = Instant::now();
            let inputs: Vec<Input> = events
                .iter()
                .filter_map(|event| translation.translate(event, now))
                .collect();
            inputs
        };
        assert_eq!(inputs(double_click()), [Input::Frame]);
        let control = Modifiers {
            control: true,
            ..Modifiers::default()
        };
        assert_eq!(inputs(key(Key::Character('s'), control)), [Input::Save(None)]);
        assert_eq!(inputs(key(Key::Character('u'), Modifiers::default())), []);
        assert_eq!(inputs(pin([3.0, 4.0])), [Input::See(See::Pin([3.0, 4.0]))]);
    }
}
