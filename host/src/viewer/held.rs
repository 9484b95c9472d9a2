//! Which keys are held while a window does not have the keyboard, and so is not told.

use super::event::Modifiers;
use winit::window::Window;

/// Shift and Ctrl as the window's display has them now; none where it cannot be asked: only X11 is, on Linux.
#[cfg(target_os = "linux")]
pub fn modifiers(window: &Window) -> Option<Modifiers> {
    use winit::raw_window_handle::{HasWindowHandle, RawWindowHandle};
    use x11rb::connection::Connection;
    use x11rb::protocol::xproto::{ConnectionExt, KeyButMask};

    let handle = window.window_handle().ok()?.as_raw();
    if !matches!(handle, RawWindowHandle::Xlib(_) | RawWindowHandle::Xcb(_)) {
        return None;
    }
    let (connection, screen) = x11rb::connect(None).ok()?;
    let root = connection.setup().roots.get(screen)?.root;
    let held = connection.query_pointer(root).ok()?.reply().ok()?.mask;
    Some(Modifiers {
        shift: held.contains(KeyButMask::SHIFT),
        control: held.contains(KeyButMask::CONTROL),
    })
}

/// None: only X11 is asked, on Linux.
#[cfg(not(target_os = "linux"))]
pub fn modifiers(_: &Window) -> Option<Modifiers> {
    None
}
