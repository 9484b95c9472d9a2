//! What happens to the window, apart from the window system.

use std::path::PathBuf;
use winit::event::{ElementState, MouseButton, MouseScrollDelta, WindowEvent};
use winit::keyboard::{Key as WinitKey, KeyCode, NamedKey, PhysicalKey};

/// An event of the window, or one that a script makes.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// The pointer is there, in physical pixels from the window's upper left corner.
    PointerMoved {
        /// To the right.
        x: f64,
        /// Downwards.
        y: f64,
    },
    /// A button of the mouse.
    Button {
        /// Which.
        button: Button,
        /// Down or up.
        pressed: bool,
    },
    /// The wheel, in notches; positive away from the person.
    Wheel(f32),
    /// Keys that change the meaning of others.
    Modifiers(Modifiers),
    /// A key went down (not by repetition).
    Key(Key),
    /// A key went up.
    Released(Key),
    /// Files were dropped together.
    Dropped(Vec<PathBuf>),
    /// The window's inside has another size, in physical pixels, or another scale factor.
    Resized {
        /// Width and height.
        size: [u32; 2],
        /// The scale factor.
        scale: f64,
    },
    /// The window lost the keyboard: releases of buttons and keys may go elsewhere.
    Unfocused,
    /// The window is asked to close.
    CloseRequested,
}

/// A button of the mouse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Button {
    /// The left one.
    Left,
    /// The right one.
    Right,
    /// The middle one, or the wheel pressed.
    Middle,
}

/// Keys that change the meaning of others.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Modifiers {
    /// Shift.
    pub shift: bool,
    /// Ctrl, or the command key of a Mac.
    pub control: bool,
}

/// A key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Key {
    /// One with a character, letters in lower case.
    Character(char),
    /// A digit of the keypad.
    Keypad(char),
    /// Esc.
    Escape,
    /// Tab.
    Tab,
}

/// The keypad's digits from 1 on.
const KEYPAD: [KeyCode; 9] = [
    KeyCode::Numpad1,
    KeyCode::Numpad2,
    KeyCode::Numpad3,
    KeyCode::Numpad4,
    KeyCode::Numpad5,
    KeyCode::Numpad6,
    KeyCode::Numpad7,
    KeyCode::Numpad8,
    KeyCode::Numpad9,
];

/// Pixels that a touchpad scrolls for one notch of a wheel.
const PIXELS_PER_NOTCH: f64 = 40.0;

impl Event {
    /// What winit tells, where it matters here; `size` and `scale` are the window's.
    pub fn from_winit(event: &WindowEvent, size: [u32; 2], scale: f64) -> Option<Self> {
        Some(match event {
            WindowEvent::CursorMoved { position, .. } => Event::PointerMoved {
                x: position.x,
                y: position.y,
            },
            WindowEvent::MouseInput { state, button, .. } => Event::Button {
                button: match button {
                    MouseButton::Left => Button::Left,
                    MouseButton::Right => Button::Right,
                    MouseButton::Middle => Button::Middle,
                    _ => return None,
                },
                pressed: *state == ElementState::Pressed,
            },
            WindowEvent::MouseWheel { delta, .. } => Event::Wheel(match delta {
                MouseScrollDelta::LineDelta(_, lines) => *lines,
                MouseScrollDelta::PixelDelta(pixels) => (pixels.y / (PIXELS_PER_NOTCH * scale)) as f32,
            }),
            WindowEvent::ModifiersChanged(modifiers) => {
                let state = modifiers.state();
                Event::Modifiers(Modifiers {
                    shift: state.shift_key(),
                    control: state.control_key() || state.super_key(),
                })
            }
            WindowEvent::KeyboardInput { event, .. } if !event.repeat => {
                let key = key(&event.logical_key, event.physical_key)?;
                match event.state {
                    ElementState::Pressed => Event::Key(key),
                    ElementState::Released => Event::Released(key),
                }
            }
            WindowEvent::DroppedFile(path) => Event::Dropped(vec![path.clone()]),
            WindowEvent::Resized(size) => Event::Resized {
                size: [size.width, size.height],
                scale,
            },
            WindowEvent::ScaleFactorChanged { scale_factor, .. } => Event::Resized {
                size,
                scale: *scale_factor,
            },
            WindowEvent::Focused(false) => Event::Unfocused,
            WindowEvent::CloseRequested => Event::CloseRequested,
            _ => return None,
        })
    }
}

fn key(logical: &WinitKey, physical: PhysicalKey) -> Option<Key> {
    // Whether digits or arrows are on them: the lamp of NumLock is not looked at.
    if let PhysicalKey::Code(code) = physical
        && let Some(digit) = KEYPAD.iter().position(|known| *known == code)
    {
        return Some(Key::Keypad(char::from(b'1' + digit as u8)));
    }
    match logical {
        WinitKey::Named(NamedKey::Escape) => return Some(Key::Escape),
        WinitKey::Named(NamedKey::Tab) => return Some(Key::Tab),
        WinitKey::Character(text) if text.is_ascii() => {
            let mut characters = text.chars();
            if let (Some(character), None) = (characters.next(), characters.next()) {
                return Some(Key::Character(character.to_ascii_lowercase()));
            }
        }
        _ => {}
    }
    // Keyboards without Latin letters: the key where a Latin keyboard has the letter.
    let PhysicalKey::Code(code) = physical else {
        return None;
    };
    Some(Key::Character(match code {
        KeyCode::KeyA => 'a',
        KeyCode::KeyB => 'b',
        KeyCode::KeyC => 'c',
        KeyCode::KeyD => 'd',
        KeyCode::KeyE => 'e',
        KeyCode::KeyF => 'f',
        KeyCode::KeyG => 'g',
        KeyCode::KeyH => 'h',
        KeyCode::KeyI => 'i',
        KeyCode::KeyJ => 'j',
        KeyCode::KeyK => 'k',
        KeyCode::KeyL => 'l',
        KeyCode::KeyM => 'm',
        KeyCode::KeyO => 'o',
        KeyCode::KeyP => 'p',
        KeyCode::KeyQ => 'q',
        KeyCode::KeyR => 'r',
        KeyCode::KeyS => 's',
        KeyCode::KeyT => 't',
        KeyCode::KeyV => 'v',
        KeyCode::KeyW => 'w',
        KeyCode::KeyX => 'x',
        KeyCode::KeyY => 'y',
        KeyCode::KeyZ => 'z',
        KeyCode::Digit1 => '1',
        KeyCode::Digit2 => '2',
        KeyCode::Digit3 => '3',
        KeyCode::Digit4 => '4',
        KeyCode::Digit5 => '5',
        KeyCode::Digit6 => '6',
        KeyCode::Digit7 => '7',
        KeyCode::Digit8 => '8',
        KeyCode::Digit9 => '9',
        KeyCode::Equal => '=',
        KeyCode::Minus => '-',
        KeyCode::Period => '.',
        KeyCode::Comma => ',',
        KeyCode::BracketLeft => '[',
        KeyCode::BracketRight => ']',
        KeyCode::Slash => '/',
        _ => return None,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use winit::dpi::{PhysicalPosition, PhysicalSize};
    use winit::event::{DeviceId, TouchPhase};

    fn from(event: &WindowEvent) -> Option<Event> {
        Event::from_winit(event, [640, 480], 2.0)
    }

    #[test]
    fn pointer_wheel_and_size() {
        let device_id = DeviceId::dummy();
        let moved = WindowEvent::CursorMoved {
            device_id,
            position: PhysicalPosition::new(3.0, 4.0),
        };
        assert_eq!(from(&moved), Some(Event::PointerMoved { x: 3.0, y: 4.0 }));
        let wheel = |delta| WindowEvent::MouseWheel {
            device_id,
            delta,
            phase: TouchPhase::Moved,
        };
        assert_eq!(
            from(&wheel(MouseScrollDelta::LineDelta(5.0, -2.0))),
            Some(Event::Wheel(-2.0))
        );
        assert_eq!(
            from(&wheel(MouseScrollDelta::PixelDelta(PhysicalPosition::new(0.0, 80.0)))),
            Some(Event::Wheel(1.0)),
            "pixels are physical ones"
        );
        assert_eq!(
            from(&WindowEvent::Resized(PhysicalSize::new(0, 0))),
            Some(Event::Resized {
                size: [0, 0],
                scale: 2.0
            })
        );
        let press = |button| {
            from(&WindowEvent::MouseInput {
                device_id,
                state: ElementState::Pressed,
                button,
            })
        };
        assert_eq!(
            press(MouseButton::Right),
            Some(Event::Button {
                button: Button::Right,
                pressed: true
            })
        );
        assert_eq!(press(MouseButton::Back), None);
        assert_eq!(
            from(&WindowEvent::DroppedFile("a.ply".into())),
            Some(Event::Dropped(vec!["a.ply".into()]))
        );
        assert_eq!(from(&WindowEvent::Focused(true)), None);
    }

    #[test]
    fn keys_of_all_keyboards() {
        let code = |code| PhysicalKey::Code(code);
        let character = |text: &str| WinitKey::Character(text.into());
        assert_eq!(key(&character("F"), code(KeyCode::KeyF)), Some(Key::Character('f')));
        assert_eq!(key(&character("?"), code(KeyCode::Slash)), Some(Key::Character('?')));
        assert_eq!(
            key(&character("\u{430}"), code(KeyCode::KeyF)),
            Some(Key::Character('f')),
            "a Cyrillic keyboard"
        );
        assert_eq!(
            key(&character("a"), code(KeyCode::KeyQ)),
            Some(Key::Character('a')),
            "a French keyboard"
        );
        assert_eq!(
            key(&WinitKey::Named(NamedKey::Escape), code(KeyCode::Escape)),
            Some(Key::Escape)
        );
        assert_eq!(
            key(&character("1"), code(KeyCode::Digit1)),
            Some(Key::Character('1')),
            "a digit above the letters"
        );
        for logical in [character("5"), WinitKey::Named(NamedKey::Clear)] {
            assert_eq!(
                key(&logical, code(KeyCode::Numpad5)),
                Some(Key::Keypad('5')),
                "the keypad, with NumLock and without"
            );
        }
        assert_eq!(key(&WinitKey::Named(NamedKey::Tab), code(KeyCode::Tab)), Some(Key::Tab));
        assert_eq!(key(&WinitKey::Named(NamedKey::Home), code(KeyCode::Home)), None);
    }
}
