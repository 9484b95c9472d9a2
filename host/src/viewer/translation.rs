//! From events to inputs: what buttons, keys and their combinations mean.

use super::bearing::Bearing;
use super::event::{Button, Event, Key, Modifiers};
use super::input::Input;
use super::seeing::See;
use super::written_camera::Form;
use glam::Vec3;
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
    /// Keys that are held down and steer a flight.
    steering: Vec<char>,
    modifiers: Modifiers,
    last_click: Option<(Instant, [f64; 2])>,
    scale: f64,
}

/// The keys that steer a flight, and where they lead: to the right, upwards and ahead.
const STEERING: [(char, Vec3); 6] = [
    ('w', Vec3::Z),
    ('s', Vec3::NEG_Z),
    ('a', Vec3::NEG_X),
    ('d', Vec3::X),
    ('e', Vec3::Y),
    ('q', Vec3::NEG_Y),
];

impl Default for Translation {
    fn default() -> Self {
        Translation {
            pointer: None,
            held: None,
            steering: Vec::new(),
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
            Event::Released(key) => {
                self.steering.retain(|held| key != Key::Character(*held));
                None
            }
            Event::Dropped(ref paths) if self.modifiers != Modifiers::default() => Some(Input::Add(paths.clone())),
            Event::Dropped(ref paths) => Some(Input::Open(paths.clone())),
            Event::Resized { size, scale } => {
                self.scale = scale;
                Some(Input::Resize { size, scale })
            }
            Event::Unfocused => {
                self.held = None;
                self.steering.clear();
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

    /// Where the keys lead that are held down, to the right, upwards and ahead, each -1, 0 or 1; and whether fast.
    pub fn heading(&self) -> (Vec3, bool) {
        let held = STEERING.iter().filter(|(key, _)| self.steering.contains(key));
        (held.map(|(_, way)| *way).sum(), self.modifiers.shift)
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

    fn key(&mut self, key: Key) -> Option<Input> {
        let Modifiers { shift, control } = self.modifiers;
        Some(match key {
            Key::Character('c') if control && shift => Input::CopyCamera(Form::Table),
            Key::Character('c') if control => Input::CopyCamera(Form::Arguments),
            Key::Character(digit @ '1'..='9') if control => Input::SaveView(number(digit)),
            Key::Character(digit @ '1'..='9') => Input::RecallView(number(digit)),
            Key::Keypad(digit) => return keypad(digit, control),
            Key::Escape => Input::Leave,
            Key::Tab => Input::TogglePanel,
            Key::Character('/') => Input::Prompt,
            Key::Character('s') if self.modifiers.control => Input::Save(None),
            Key::Character('o') if self.modifiers.control => Input::Choose {
                beside: self.modifiers.shift,
            },
            Key::Character('r') if self.modifiers.control => Input::ToggleRecent,
            Key::Character(_) if self.modifiers.control => return None,
            Key::Character('f') => Input::Frame,
            Key::Character('r') => Input::Reset,
            Key::Character('p') if shift => Input::ToggleProjection,
            Key::Character('p') => Input::ToggleShading,
            Key::Character('k') => Input::Widen(1.0),
            Key::Character('j') => Input::Widen(-1.0),
            Key::Character(letter @ 'x'..='z') => Input::Stand(Bearing::Axis {
                axis: letter as usize - 'x' as usize,
                is_negative: shift,
            }),
            Key::Character('g') => Input::ToggleFlight,
            Key::Character(letter) if STEERING.iter().any(|(key, _)| *key == letter) => {
                if !self.steering.contains(&letter) {
                    self.steering.push(letter);
                }
                Input::TakeOff
            }
            Key::Character('m') => Input::NextSamples,
            Key::Character('t') => Input::NextTone,
            Key::Character('+' | '=') => Input::Expose(1.0),
            Key::Character('-') => Input::Expose(-1.0),
            Key::Character('.') => Input::Deepen(1),
            Key::Character(',') => Input::Deepen(-1),
            Key::Character('l') => Input::NextStereo,
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

/// The number on a key.
fn number(digit: char) -> usize {
    digit as usize - '0' as usize
}

/// What a digit of the keypad asks for, as in Blender; Ctrl is the other side.
fn keypad(digit: char, is_opposite: bool) -> Option<Input> {
    Some(match (digit, is_opposite) {
        ('1', false) => Input::Stand(Bearing::Front),
        ('1', true) => Input::Stand(Bearing::Back),
        ('3', false) => Input::Stand(Bearing::Right),
        ('3', true) => Input::Stand(Bearing::Left),
        ('7', false) => Input::Stand(Bearing::Top),
        ('7', true) => Input::Stand(Bearing::Bottom),
        ('5', false) => Input::ToggleProjection,
        _ => return None,
    })
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
        let axis = |axis, is_negative| Input::Stand(Bearing::Axis { axis, is_negative });
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
            ('l', Some(Input::NextStereo)),
            ('1', Some(Input::RecallView(1))),
            ('9', Some(Input::RecallView(9))),
            ('0', None),
            ('k', Some(Input::Widen(1.0))),
            ('j', Some(Input::Widen(-1.0))),
            ('y', Some(axis(1, false))),
            ('g', Some(Input::ToggleFlight)),
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
            ('/', Some(Input::Prompt)),
            ('w', Some(Input::TakeOff)),
            ('u', None),
        ] {
            assert_eq!(hand.does(character(key)), input, "{key}");
        }
        assert_eq!(hand.does(Event::Key(Key::Escape)), Some(Input::Leave));
        assert_eq!(hand.does(Event::Key(Key::Tab)), Some(Input::TogglePanel));
        assert_eq!(hand.does(Event::CloseRequested), Some(Input::Quit));
        hand.modifiers(true, false);
        assert_eq!(hand.does(character('v')), Some(Input::See(See::Previous)));
        assert_eq!(hand.does(character('p')), Some(Input::ToggleProjection));
        assert_eq!(hand.does(character('z')), Some(axis(2, true)));
        assert_eq!(
            hand.does(character('4')),
            Some(Input::RecallView(4)),
            "a French keyboard"
        );
        hand.modifiers(false, true);
        assert_eq!(hand.press(Button::Left), None, "nobody knows where");
        hand.moves(7.0, 9.0);
        assert_eq!(hand.press(Button::Left), Some(Input::See(See::Pin([7.0, 9.0]))));
        assert_eq!(hand.moves(8.0, 9.0), None, "a pin is not dragged");
        hand.release(Button::Left);
        assert_eq!(hand.does(character('s')), Some(Input::Save(None)));
        assert_eq!(hand.does(character('2')), Some(Input::SaveView(2)));
        assert_eq!(hand.does(character('c')), Some(Input::CopyCamera(Form::Arguments)));
        assert_eq!(hand.does(character('f')), None, "Ctrl+F is something else");
        hand.modifiers(true, true);
        assert_eq!(hand.does(character('c')), Some(Input::CopyCamera(Form::Table)));
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

    #[test]
    fn the_keypad_looks_from_all_sides() {
        let mut hand = Hand::new();
        let sides = |hand: &mut Hand| {
            "13579"
                .chars()
                .map(|digit| hand.does(Event::Key(Key::Keypad(digit))))
                .collect::<Vec<_>>()
        };
        let stand = |bearing| Some(Input::Stand(bearing));
        let [front, right, top] = [Bearing::Front, Bearing::Right, Bearing::Top].map(stand);
        assert_eq!(
            sides(&mut hand),
            [front, right, Some(Input::ToggleProjection), top, None]
        );
        hand.modifiers(false, true);
        let [back, left, bottom] = [Bearing::Back, Bearing::Left, Bearing::Bottom].map(stand);
        assert_eq!(sides(&mut hand), [back, left, None, bottom, None]);
    }

    #[test]
    fn what_is_held_down_steers() {
        let mut hand = Hand::new();
        let key = |c| Event::Key(Key::Character(c));
        let release = |c| Event::Released(Key::Character(c));
        hand.does(key('w'));
        hand.does(key('d'));
        assert_eq!(hand.translation.heading(), (Vec3::new(1.0, 0.0, 1.0), false));
        hand.does(key('a'));
        hand.modifiers(true, false);
        assert_eq!(hand.translation.heading(), (Vec3::Z, true), "left and right together");
        hand.does(release('w'));
        hand.does(release('d'));
        hand.does(release('f'));
        assert_eq!(hand.translation.heading().0, Vec3::NEG_X);
        hand.does(Event::Unfocused);
        assert_eq!(
            hand.translation.heading(),
            (Vec3::ZERO, false),
            "it may be released elsewhere"
        );
        hand.modifiers(false, true);
        assert_eq!(hand.does(key('s')), Some(Input::Save(None)));
        assert_eq!(hand.translation.heading().0, Vec3::ZERO, "Ctrl+S is something else");
    }
}
