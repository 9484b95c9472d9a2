//! From events to inputs: what buttons, keys and their combinations mean.

use super::event::{Button, Event, Key, Modifiers};
use super::input::Input;
use super::seeing::See;
use std::time::{Duration, Instant};

/// Two presses within this time are a double click.
const DOUBLE_CLICK: Duration = Duration::from_millis(400);
/// If they are at most so far apart, pixels at scale factor 1.
const DOUBLE_CLICK_REACH: f64 = 5.0;

/// Remembers what an event does not say: where the pointer was and what is held down.
#[derive(Debug)]
pub struct Translation {
    pointer: Option<[f64; 2]>,
    held: Option<Button>,
    modifiers: Modifiers,
    last_click: Option<(Instant, [f64; 2])>,
    scale: f64,
}

impl Default for Translation {
    fn default() -> Self {
        Translation {
            pointer: None,
            held: None,
            modifiers: Modifiers::default(),
            last_click: None,
            scale: 1.0,
        }
    }
}

impl Translation {
    /// What an event asks for, if anything.
    pub fn translate(&mut self, event: &Event, now: Instant) -> Option<Input> {
        match *event {
            Event::PointerMoved { x, y } => {
                let [from_x, from_y] = self.pointer.replace([x, y])?;
                let (right, down) = ((x - from_x) as f32, (y - from_y) as f32);
                if right == 0.0 && down == 0.0 {
                    return None;
                }
                let held = self.held?;
                // A drag is no click, even if it ends where it began.
                if self.last_click.is_some_and(|(_, place)| !self.reaches(place, [x, y])) {
                    self.last_click = None;
                }
                match held {
                    Button::Left if self.modifiers.shift => Some(Input::Pan { right, down }),
                    Button::Left => Some(Input::Turn { right, down }),
                    Button::Right => Some(Input::TurnLight { right, down }),
                    Button::Middle => Some(Input::Pan { right, down }),
                }
            }
            Event::Button {
                button: Button::Left,
                pressed: true,
            } if self.modifiers.control => self.pointer.map(|at| {
                if self.modifiers.shift {
                    Input::Pick(at)
                } else {
                    Input::See(See::Pin(at))
                }
            }),
            Event::Button { button, pressed: true } => {
                self.held = Some(button);
                if button == Button::Left {
                    self.click(now)
                } else {
                    self.last_click = None;
                    None
                }
            }
            Event::Button { button, pressed: false } => {
                if self.held == Some(button) {
                    self.held = None;
                }
                None
            }
            Event::Wheel(notches) => (notches != 0.0 && notches.is_finite()).then_some(Input::Zoom(notches)),
            Event::Modifiers(modifiers) => {
                self.modifiers = modifiers;
                None
            }
            Event::Key(key) => self.key(key),
            Event::Dropped(ref paths) if self.modifiers != Modifiers::default() => Some(Input::Add(paths.clone())),
            Event::Dropped(ref paths) => Some(Input::Open(paths.clone())),
            Event::Resized { size, scale } => {
                self.scale = scale;
                Some(Input::Resize { size, scale })
            }
            Event::Unfocused => {
                self.held = None;
                self.modifiers = Modifiers::default();
                None
            }
            Event::CloseRequested => Some(Input::Quit),
        }
    }

    /// Where the pointer is, physical pixels from the window's upper left corner; none where nobody has seen it.
    pub fn pointer(&self) -> Option<[f64; 2]> {
        self.pointer
    }

    fn click(&mut self, now: Instant) -> Option<Input> {
        let at = self.pointer.unwrap_or_default();
        match self.last_click {
            Some((time, place)) if now.saturating_duration_since(time) <= DOUBLE_CLICK && self.reaches(place, at) => {
                // A third press begins anew.
                self.last_click = None;
                Some(Input::Frame)
            }
            _ => {
                self.last_click = Some((now, at));
                None
            }
        }
    }

    /// Whether two places are near enough for a double click.
    fn reaches(&self, a: [f64; 2], b: [f64; 2]) -> bool {
        (a[0] - b[0]).hypot(a[1] - b[1]) <= DOUBLE_CLICK_REACH * self.scale
    }

    fn key(&self, key: Key) -> Option<Input> {
        Some(match key {
            Key::Escape => Input::Leave,
            Key::Tab => Input::TogglePanel,
            Key::Character('s') if self.modifiers.control => Input::Save(None),
            Key::Character('o') if self.modifiers.control => Input::Choose {
                beside: self.modifiers.shift,
            },
            Key::Character('r') if self.modifiers.control => Input::ToggleRecent,
            Key::Character(_) if self.modifiers.control => return None,
            Key::Character('f') => Input::Frame,
            Key::Character('r') => Input::Reset,
            Key::Character('p') => Input::ToggleShading,
            Key::Character('m') => Input::NextSamples,
            Key::Character('t') => Input::NextTone,
            Key::Character('+' | '=') => Input::Expose(1.0),
            Key::Character('-') => Input::Expose(-1.0),
            Key::Character('.') => Input::Deepen(1),
            Key::Character(',') => Input::Deepen(-1),
            Key::Character('3') => Input::NextStereo,
            Key::Character(']') => Input::PartEyes(1.0),
            Key::Character('[') => Input::PartEyes(-1.0),
            Key::Character('b') => Input::SwitchBackend,
            Key::Character('h' | '?') => Input::ToggleHelp,
            Key::Character('i') => Input::ToggleFigures,
            Key::Character('o') => Input::ToggleOracle,
            Key::Character('v') if self.modifiers.shift => Input::See(See::Previous),
            Key::Character('v') => Input::See(See::Next),
            Key::Character('c') => Input::See(See::NextCells),
            Key::Character('>') => Input::See(See::Deeper(1)),
            Key::Character('<') => Input::See(See::Deeper(-1)),
            Key::Character(_) => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Hand {
        translation: Translation,
        now: Instant,
    }

    impl Hand {
        fn new() -> Self {
            Hand {
                translation: Translation::default(),
                now: Instant::now(),
            }
        }

        fn after(&mut self, milliseconds: u64, event: Event) -> Option<Input> {
            self.now += Duration::from_millis(milliseconds);
            self.translation.translate(&event, self.now)
        }

        fn does(&mut self, event: Event) -> Option<Input> {
            self.after(1, event)
        }

        fn press(&mut self, button: Button) -> Option<Input> {
            self.does(Event::Button { button, pressed: true })
        }

        fn release(&mut self, button: Button) -> Option<Input> {
            self.does(Event::Button { button, pressed: false })
        }

        fn moves(&mut self, x: f64, y: f64) -> Option<Input> {
            self.does(Event::PointerMoved { x, y })
        }

        fn modifiers(&mut self, shift: bool, control: bool) {
            self.does(Event::Modifiers(Modifiers { shift, control }));
        }
    }

    #[test]
    fn drags() {
        let mut hand = Hand::new();
        assert_eq!(hand.moves(10.0, 10.0), None);
        let (right, down) = (5.0, -3.0);
        for (button, shift, input) in [
            (Button::Left, false, Input::Turn { right, down }),
            (Button::Right, false, Input::TurnLight { right, down }),
            (Button::Middle, false, Input::Pan { right, down }),
            (Button::Left, true, Input::Pan { right, down }),
            (Button::Right, true, Input::TurnLight { right, down }),
        ] {
            hand.modifiers(shift, false);
            hand.moves(100.0, 100.0);
            assert_eq!(hand.press(button), None);
            assert_eq!(hand.moves(105.0, 97.0), Some(input));
            assert_eq!(hand.moves(105.0, 97.0), None, "a move that goes nowhere");
            assert_eq!(hand.release(button), None);
            assert_eq!(hand.moves(0.0, 0.0), None, "nothing is held");
            hand.now += Duration::from_secs(1);
        }
    }

    #[test]
    fn the_newest_button_counts_and_focus_lets_go() {
        let mut hand = Hand::new();
        hand.moves(0.0, 0.0);
        hand.press(Button::Left);
        hand.press(Button::Right);
        hand.release(Button::Left);
        assert!(matches!(hand.moves(1.0, 0.0), Some(Input::TurnLight { .. })));
        hand.does(Event::Unfocused);
        assert_eq!(hand.moves(2.0, 0.0), None);
    }

    #[test]
    fn double_clicks() {
        let mut hand = Hand::new();
        hand.moves(50.0, 50.0);
        let click = |hand: &mut Hand| {
            let input = hand.press(Button::Left);
            hand.release(Button::Left);
            input
        };
        assert_eq!(click(&mut hand), None);
        assert_eq!(click(&mut hand), Some(Input::Frame));
        assert_eq!(click(&mut hand), None, "three are no two double clicks");
        hand.now += Duration::from_secs(1);
        assert_eq!(click(&mut hand), None, "too late");
        hand.moves(60.0, 50.0);
        assert_eq!(click(&mut hand), None, "too far away");
        hand.now += Duration::from_secs(1);
        hand.press(Button::Left);
        hand.moves(90.0, 50.0);
        hand.moves(60.0, 50.0);
        hand.release(Button::Left);
        assert_eq!(click(&mut hand), None, "a drag there and back is no click");
        hand.does(Event::Resized {
            size: [10, 10],
            scale: 2.0,
        });
        hand.moves(70.0, 50.0);
        assert_eq!(
            click(&mut hand),
            Some(Input::Frame),
            "near enough where pixels are small"
        );
    }

    #[test]
    fn keys_and_the_rest() {
        let mut hand = Hand::new();
        let character = |c| Event::Key(Key::Character(c));
        for (key, input) in [
            ('f', Some(Input::Frame)),
            ('r', Some(Input::Reset)),
            ('p', Some(Input::ToggleShading)),
            ('m', Some(Input::NextSamples)),
            ('t', Some(Input::NextTone)),
            ('+', Some(Input::Expose(1.0))),
            ('=', Some(Input::Expose(1.0))),
            ('-', Some(Input::Expose(-1.0))),
            ('.', Some(Input::Deepen(1))),
            (',', Some(Input::Deepen(-1))),
            ('3', Some(Input::NextStereo)),
            (']', Some(Input::PartEyes(1.0))),
            ('[', Some(Input::PartEyes(-1.0))),
            ('b', Some(Input::SwitchBackend)),
            ('h', Some(Input::ToggleHelp)),
            ('?', Some(Input::ToggleHelp)),
            ('i', Some(Input::ToggleFigures)),
            ('o', Some(Input::ToggleOracle)),
            ('v', Some(Input::See(See::Next))),
            ('c', Some(Input::See(See::NextCells))),
            ('>', Some(Input::See(See::Deeper(1)))),
            ('<', Some(Input::See(See::Deeper(-1)))),
            ('w', None),
            ('a', None),
            ('s', None),
            ('d', None),
        ] {
            assert_eq!(hand.does(character(key)), input, "{key}");
        }
        assert_eq!(hand.does(Event::Key(Key::Escape)), Some(Input::Leave));
        assert_eq!(hand.does(Event::Key(Key::Tab)), Some(Input::TogglePanel));
        assert_eq!(hand.does(Event::CloseRequested), Some(Input::Quit));
        hand.modifiers(true, false);
        assert_eq!(hand.does(character('v')), Some(Input::See(See::Previous)));
        hand.modifiers(false, true);
        assert_eq!(hand.press(Button::Left), None, "nobody knows where");
        hand.moves(7.0, 9.0);
        assert_eq!(hand.press(Button::Left), Some(Input::See(See::Pin([7.0, 9.0]))));
        assert_eq!(hand.moves(8.0, 9.0), None, "a pin is not dragged");
        hand.release(Button::Left);
        assert_eq!(hand.does(character('s')), Some(Input::Save(None)));
        assert_eq!(hand.does(character('f')), None, "Ctrl+F is something else");
        hand.modifiers(true, true);
        hand.moves(30.0, 40.0);
        assert_eq!(hand.press(Button::Left), Some(Input::Pick([30.0, 40.0])));
        assert_eq!(hand.moves(35.0, 40.0), None, "it holds nothing");
        assert_eq!(hand.does(Event::Wheel(1.5)), Some(Input::Zoom(1.5)));
        assert_eq!(hand.does(Event::Wheel(0.0)), None);
        let paths = vec!["a.ply".into(), "b.stl".into()];
        assert_eq!(
            hand.does(Event::Dropped(paths.clone())),
            Some(Input::Add(paths.clone()))
        );
        assert_eq!(
            hand.does(character('o')),
            Some(Input::Choose { beside: true }),
            "with Shift, too"
        );
        hand.modifiers(false, false);
        assert_eq!(hand.does(Event::Dropped(paths.clone())), Some(Input::Open(paths)));
        hand.modifiers(false, true);
        assert_eq!(hand.does(character('o')), Some(Input::Choose { beside: false }));
        assert_eq!(hand.does(character('r')), Some(Input::ToggleRecent));
    }
}
