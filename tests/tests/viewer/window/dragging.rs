//! A program that files are dragged from, by the protocol of X11 (XDND, version 5).

use super::PATIENCE;
use std::path::Path;
use std::thread;
use std::time::{Duration, Instant};
use x11rb::connection::Connection;
use x11rb::protocol::Event;
use x11rb::protocol::xproto::{
    Atom, ClientMessageEvent, ConnectionExt, CreateWindowAux, EventMask, InputFocus, PropMode, SELECTION_NOTIFY_EVENT,
    SelectionNotifyEvent, SelectionRequestEvent, Window, WindowClass,
};
use x11rb::rust_connection::RustConnection;
use x11rb::wrapper::ConnectionExt as _;
use x11rb::{COPY_DEPTH_FROM_PARENT, COPY_FROM_PARENT, CURRENT_TIME, NONE};

/// Version of the protocol.
const VERSION: u32 = 5;

struct Source {
    connection: RustConnection,
    /// Where files are dropped.
    target: Window,
}

impl Source {
    fn atom(&self, name: &str) -> Atom {
        let cookie = self
            .connection
            .intern_atom(false, name.as_bytes())
            .expect("the display answers");
        cookie.reply().expect("the display knows any name").atom
    }

    fn tells(&self, what: &str, data: [u32; 5]) {
        let message = ClientMessageEvent::new(32, self.target, self.atom(what), data);
        self.connection
            .send_event(false, self.target, EventMask::NO_EVENT, message)
            .expect("the display takes it");
        self.connection.flush().expect("it does");
    }

    /// Gives the list of files to who asks for it.
    fn gives(&self, request: &SelectionRequestEvent, list: &str) {
        self.connection
            .change_property8(
                PropMode::REPLACE,
                request.requestor,
                request.property,
                request.target,
                list.as_bytes(),
            )
            .expect("the display takes it");
        let notice = SelectionNotifyEvent {
            response_type: SELECTION_NOTIFY_EVENT,
            sequence: 0,
            time: request.time,
            requestor: request.requestor,
            selection: request.selection,
            target: request.target,
            property: request.property,
        };
        self.connection
            .send_event(false, request.requestor, EventMask::NO_EVENT, notice)
            .expect("the display takes it");
        self.connection.flush().expect("it does");
    }

    /// Answers until all of that was asked or told, in any order.
    fn waits_for(&self, list: &str, mut is_asked: bool, told: &str) {
        let (start, told) = (Instant::now(), self.atom(told));
        let mut is_told = false;
        while !(is_asked && is_told) {
            match self.connection.poll_for_event().expect("the display is there") {
                Some(Event::SelectionRequest(request)) => {
                    self.gives(&request, list);
                    is_asked = true;
                }
                Some(Event::ClientMessage(message)) => is_told |= message.type_ == told,
                Some(_) => {}
                None => thread::sleep(Duration::from_millis(10)),
            }
            assert!(start.elapsed() < PATIENCE, "the window does not answer the drag");
        }
    }
}

/// Drags files to a window and drops them there, together. The window has the keyboard no more.
pub fn drop_files(target: Window, files: &[&Path]) {
    let (connection, screen) = x11rb::connect(None).expect("there is a display");
    let window = connection.generate_id().expect("there are names left");
    let root = connection.setup().roots[screen].root;
    let source = Source { connection, target };
    source
        .connection
        .create_window(
            COPY_DEPTH_FROM_PARENT,
            window,
            root,
            0,
            0,
            1,
            1,
            0,
            WindowClass::INPUT_OUTPUT,
            COPY_FROM_PARENT,
            &CreateWindowAux::new(),
        )
        .expect("a window can be made");
    // Where people drag from has the keyboard.
    source
        .connection
        .set_input_focus(InputFocus::NONE, NONE, CURRENT_TIME)
        .expect("it can be taken from a window");
    let address = |file: &&Path| format!("file://{}\r\n", file.display()).replace(' ', "%20");
    let list: String = files.iter().map(address).collect();
    let [uris, selection, copy] = ["text/uri-list", "XdndSelection", "XdndActionCopy"].map(|name| source.atom(name));
    source
        .connection
        .set_selection_owner(window, selection, CURRENT_TIME)
        .expect("it can be owned");
    source.tells("XdndEnter", [window, VERSION << 24, uris, NONE, NONE]);
    // The second time it is answered, the window has read the list: it takes one after the other.
    for is_asked in [false, true] {
        source.tells("XdndPosition", [window, 0, 100 << 16 | 100, CURRENT_TIME, copy]);
        source.waits_for(&list, is_asked, "XdndStatus");
    }
    source.tells("XdndDrop", [window, 0, CURRENT_TIME, 0, 0]);
    source.waits_for(&list, true, "XdndFinished");
}
