//! The window: takes events and notices, and leaves the work to others.

use super::event::Event;
use super::figures::Figures;
use super::input::Input;
use super::notice::{Image, Mailbox, Notice};
use super::opener::open_gpu;
use super::overlay::{Line, Overlay};
use super::pace::Pace;
use super::player::Player;
use super::renderer::Renderer;
use super::schedule::Schedule;
use super::screen::Screen;
use super::session::{Effect, Session};
use super::state::{GpuState, Loading, Message, Work};
use super::task::{Destination, Task};
use super::translation::Translation;
use super::{ViewerError, ViewerOptions};
use crate::backend::BackendChoice;
use crate::backend::gpu::GpuOptions;
use crate::scene::Scene;
use crate::source::Source;
use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, ControlFlow};
use winit::window::{Window, WindowId};

/// A message is shown for so long.
const MESSAGE: Duration = Duration::from_secs(8);

/// Everything that belongs to the window.
pub struct Application {
    /// When the viewer was started.
    pub(super) start: Instant,
    pub(super) options: ViewerOptions,
    pub(super) mailbox: Mailbox,
    pub(super) session: Session,
    pub(super) translation: Translation,
    pub(super) schedule: Schedule,
    pub(super) renderer: Renderer,
    /// What the renderer does.
    pub(super) work: Work,
    /// Pictures to save, first come first served.
    pub(super) saves: VecDeque<Task>,
    /// How fast the CPU is, and the GPU.
    pub(super) paces: [Pace; 2],
    pub(super) figures: Figures,
    pub(super) scene: Option<Arc<Scene>>,
    /// What the scene was made from.
    pub(super) source: Source,
    /// The mesh that is being loaded.
    pub(super) loading: Option<Loading>,
    /// Loads begun.
    pub(super) loads: u64,
    pub(super) gpu: GpuState,
    /// Whether the GPU is to render, once it is there.
    pub(super) wants_gpu: bool,
    pub(super) window: Option<Arc<Window>>,
    pub(super) screen: Option<Screen>,
    /// The picture to show, and whether the window shows it.
    pub(super) image: Option<Image>,
    pub(super) is_shown: bool,
    pub(super) panels: Vec<Vec<Line>>,
    pub(super) overlay: Overlay,
    pub(super) title: String,
    pub(super) message: Option<Message>,
    /// When a drawing that failed for the moment is tried again.
    pub(super) retry: Option<Instant>,
    pub(super) player: Option<Player>,
    /// Whether the last picture that was to be saved was.
    pub(super) last_save: Option<Result<PathBuf, String>>,
    /// Whether the window is to close.
    pub(super) quits: bool,
    /// Why the window closed, if it was not asked to.
    pub(super) failure: Option<ViewerError>,
}

impl Application {
    /// Begins to load the mesh and to open the GPU; the window comes with [`ApplicationHandler::resumed`].
    pub fn new(options: ViewerOptions, start: Instant, mailbox: Mailbox, player: Option<Player>) -> Self {
        let mut application = Application {
            start,
            session: Session::new(options.view, options.size, 1.0),
            translation: Translation::default(),
            schedule: Schedule::new(start),
            renderer: Renderer::start(mailbox.clone()),
            work: Work::Idle,
            saves: VecDeque::new(),
            paces: [Pace::default(); 2],
            figures: Figures::default(),
            scene: None,
            source: options.source.clone(),
            loading: None,
            loads: 0,
            gpu: GpuState::Closed,
            wants_gpu: false,
            window: None,
            screen: None,
            image: None,
            is_shown: false,
            panels: Vec::new(),
            overlay: Overlay::default(),
            title: String::new(),
            message: None,
            retry: None,
            player,
            last_save: None,
            quits: false,
            failure: None,
            mailbox,
            options,
        };
        application.load(application.options.source.clone());
        match application.options.backend {
            BackendChoice::Cpu => {}
            BackendChoice::Auto => application.open_gpu(false, false),
            BackendChoice::Gpu => application.open_gpu(true, true),
        }
        application
    }

    /// Ends with what went wrong, if anything did.
    pub fn finish(self) -> Result<(), ViewerError> {
        match self.failure {
            Some(failure) => Err(failure),
            None => Ok(()),
        }
    }

    pub(super) fn fail(&mut self, failure: impl Into<ViewerError>) {
        self.failure.get_or_insert(failure.into());
        self.quits = true;
    }

    /// Shows a sentence for a while, and tells it on standard error.
    pub(super) fn tell(&mut self, text: String, is_warning: bool) {
        eprintln!("{text}");
        self.message = Some(Message {
            text,
            is_warning,
            until: Instant::now() + MESSAGE,
        });
        self.redraw();
    }

    pub(super) fn redraw(&self) {
        if let Some(window) = &self.window {
            window.request_redraw();
        }
    }

    pub(super) fn load(&mut self, source: Source) {
        self.loads += 1;
        self.loading = Some(Loading {
            source: source.clone(),
            stage: "reading",
            fraction: 0.0,
        });
        super::loader::load(self.loads, source, self.options.octree, &self.mailbox);
        self.redraw();
    }

    pub(super) fn open_gpu(&mut self, software: bool, is_required: bool) {
        self.wants_gpu = true;
        self.gpu = GpuState::Opening { is_required };
        let options = GpuOptions {
            software,
            module: self.options.module,
        };
        open_gpu(options, &self.mailbox);
    }

    /// Takes an event of the window's or of a script's.
    pub(super) fn take_event(&mut self, event: &Event, now: Instant) {
        if let Some(input) = self.translation.translate(event, now) {
            self.take_input(input, now);
        }
    }

    /// Takes an input.
    pub(super) fn take_input(&mut self, input: Input, now: Instant) {
        match self.session.apply(input) {
            Effect::Nothing => {}
            Effect::Redraw => self.redraw(),
            Effect::Render => self.schedule.change(now),
            Effect::Save(path) => self.save(path),
            Effect::Open(path) => self.load(Source::from_path(path)),
            Effect::SwitchBackend => self.switch_backend(now),
            Effect::Quit => self.quits = true,
        }
    }

    fn save(&mut self, path: Option<PathBuf>) {
        let destination = path.map_or_else(|| Destination::Folder(self.options.pictures.clone()), Destination::File);
        match self.save_task(destination) {
            Some(task) => self.saves.push_back(task),
            None => self.tell(
                "There is no picture to save yet; wait until the mesh is shown.".into(),
                true,
            ),
        }
    }

    fn switch_backend(&mut self, now: Instant) {
        if self.wants_gpu {
            self.wants_gpu = false;
            self.schedule.change(now);
            return;
        }
        match self.gpu {
            GpuState::Open(_) => {
                self.wants_gpu = true;
                self.schedule.change(now);
            }
            GpuState::Opening { .. } => self.wants_gpu = true,
            // Whoever presses the key takes any GPU.
            GpuState::Closed => self.open_gpu(true, false),
        }
        self.redraw();
    }

    /// Puts off what can wait and says when to wake up.
    fn next_wake(&mut self, now: Instant) -> Option<Instant> {
        if self.message.as_ref().is_some_and(|message| message.until <= now) {
            self.message = None;
            self.redraw();
        }
        if self.figures.expiry().is_some_and(|expiry| expiry <= now) {
            self.figures.forget(now);
            self.redraw();
        }
        if self.retry.is_some_and(|retry| retry <= now) {
            self.retry = None;
            self.redraw();
        }
        let playing = self.play(now);
        let working = self.work(now);
        let waiting = self.message.as_ref().map(|message| message.until);
        [playing, working, waiting, self.figures.expiry(), self.retry]
            .into_iter()
            .flatten()
            .min()
    }
}

impl ApplicationHandler<Notice> for Application {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.window.is_some() {
            return;
        }
        let [width, height] = self.options.size;
        let attributes = Window::default_attributes()
            .with_title("oktant")
            .with_inner_size(PhysicalSize::new(width, height));
        let window = match event_loop.create_window(attributes) {
            Ok(window) => Arc::new(window),
            Err(error) => {
                self.fail(ViewerError::Window(error.to_string()));
                event_loop.exit();
                return;
            }
        };
        match Screen::software(window.clone()) {
            Ok(screen) => self.screen = Some(screen),
            // A display with ten bits a colour, say: a GPU may still draw on it.
            Err(_) if matches!(self.gpu, GpuState::Opening { .. }) => {}
            Err(error) => {
                self.fail(error);
                event_loop.exit();
                return;
            }
        }
        let size = window.inner_size();
        let resized = Event::Resized {
            size: [size.width, size.height],
            scale: window.scale_factor(),
        };
        self.window = Some(window);
        self.take_event(&resized, Instant::now());
        self.redraw();
    }

    fn user_event(&mut self, _: &ActiveEventLoop, notice: Notice) {
        self.take_notice(notice, Instant::now());
    }

    fn window_event(&mut self, _: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let now = Instant::now();
        if event == WindowEvent::RedrawRequested {
            self.draw(now);
            return;
        }
        let Some(event) = Event::from_winit(&event, self.session.size, self.session.scale) else {
            return;
        };
        // A script is not disturbed by the hand that happens to hold the mouse.
        let is_window = matches!(event, Event::Resized { .. } | Event::CloseRequested);
        if self.player.is_none() || is_window {
            self.take_event(&event, now);
        }
        if is_window {
            self.redraw();
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        let wake = self.next_wake(Instant::now());
        if self.quits {
            event_loop.exit();
            return;
        }
        event_loop.set_control_flow(wake.map_or(ControlFlow::Wait, ControlFlow::WaitUntil));
    }

    fn exiting(&mut self, _: &ActiveEventLoop) {
        self.renderer.cancel();
        // The screen goes before the window, and both before the event loop.
        self.image = None;
        self.screen = None;
        self.window = None;
    }
}
