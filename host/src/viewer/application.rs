//! The window: takes events and notices, and leaves the work to others.

use super::draft::{Draft, Paces};
use super::event::{Event, Modifiers};
use super::figures::Figures;
use super::input::Input;
use super::kernel_file::KernelFile;
use super::load_queue::LoadQueue;
use super::notice::{Image, Mailbox, Notice};
use super::opener::open_gpu;
use super::oracle::Comparison;
use super::overlay::{Line, Overlay};
use super::panel::{Inventory, Panel};
use super::player::Player;
use super::pulse::Pulse;
use super::recent::Recent;
use super::recovery::Recovery;
use super::remembered::StateFile;
use super::renderer::Renderer;
use super::saved_views::SavedViews;
use super::schedule::Schedule;
use super::screen::Screen;
use super::seeing::Seeing;
use super::session::{Effect, Session};
use super::showing::Part;
use super::sight::Sight;
use super::state::{About, GpuState, Message, SaveProgress, Work};
use super::task::{Destination, Task};
use super::translation::Translation;
use super::watcher::Watcher;
use super::{ViewerError, ViewerOptions};
use crate::backend::BackendChoice;
use crate::backend::gpu::GpuOptions;
use crate::model::Focus;
use crate::names::Names;
use crate::preferences::Preferences;
use crate::scene::Scene;
use crate::source::Source;
use crate::standpoint::Origin;
use crate::structure::StructureOptions;
use crate::view::View;
use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};
use winit::window::Window;

/// A message is shown for so long.
const MESSAGE: Duration = Duration::from_secs(8);

/// Everything that belongs to the window.
pub struct Application {
    /// When the viewer was started.
    pub(super) start: Instant,
    pub(super) options: ViewerOptions,
    /// What is remembered from the last time.
    pub(super) state: StateFile,
    /// Views that were saved since.
    pub(super) saved_views: SavedViews,
    /// The clipboard, once something was put on it.
    pub(super) clipboard: Option<arboard::Clipboard>,
    /// Until when the camera has flown, while it does.
    pub(super) flown: Option<Instant>,
    pub(super) mailbox: Mailbox,
    pub(super) session: Session,
    pub(super) translation: Translation,
    pub(super) schedule: Schedule,
    pub(super) renderer: Renderer,
    /// What the renderer shows.
    pub(super) work: Work,
    /// Pictures to save, first come first served.
    pub(super) saves: VecDeque<(Destination, Task)>,
    /// The one that is being saved.
    pub(super) saving: Option<SaveProgress>,
    /// How fast the CPU renders the scene, and the GPU.
    pub(super) paces: [Paces; 2],
    /// How long a draft may take.
    pub(super) target: Duration,
    /// How the last picture was simplified that was begun.
    pub(super) last_draft: Draft,
    pub(super) figures: Figures,
    /// How soon events are answered.
    pub(super) pulse: Pulse,
    /// How far the picture is from the oracle's.
    pub(super) comparison: Comparison,
    /// The work behind it.
    pub(super) sight: Sight,
    pub(super) scene: Option<Arc<Scene>>,
    /// What its structure was built with, and what the newest load builds one with.
    pub(super) built: StructureOptions,
    pub(super) building: StructureOptions,
    /// What it consists of, once that is counted.
    pub(super) inventory: Option<Inventory>,
    /// What its file calls its parts.
    pub(super) names: Names,
    /// Number of the load that it came from.
    pub(super) shown_load: u64,
    /// What the scene was made from.
    pub(super) source: Source,
    /// What it says of what is looked at.
    pub(super) focus: Option<Focus>,
    /// Notices when a file of the scene is saved.
    pub(super) watcher: Watcher,
    pub(super) loads: LoadQueue,
    /// Loads done of what was shown already.
    pub(super) reloads: u64,
    /// Files that were dropped together, as far as they are told of.
    pub(super) dropped: Vec<PathBuf>,
    /// What was held then, where the window had to ask.
    pub(super) held_at_drop: Option<Modifiers>,
    /// What was opened before.
    pub(super) recent: Recent,
    /// Whether the person is asked for files.
    pub(super) is_choosing: bool,
    /// The file of the kernel, if it is not the one that is part of the program.
    pub(super) kernel: Option<KernelFile>,
    pub(super) gpu: GpuState,
    /// Whether the GPU is to render, once it is there.
    pub(super) wants_gpu: bool,
    /// Whether one that is software will do.
    pub(super) takes_software: bool,
    /// What was done for it when it gave up.
    pub(super) recovery: Recovery,
    pub(super) window: Option<Arc<Window>>,
    pub(super) screen: Option<Screen>,
    /// The picture to show, and whether the window shows it.
    pub(super) image: Option<Image>,
    pub(super) is_shown: bool,
    /// Samples of each of its pixels.
    pub(super) samples: u32,
    /// Which part of the picture is shown, and when the other one has its turn.
    pub(super) part: Part,
    pub(super) next_turn: Option<Instant>,
    /// At the right side, once there is a window.
    pub(super) panel: Option<Panel>,
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
    /// Begins to load the source and to open the GPU; the window comes with [`ApplicationHandler::resumed`].
    pub fn new(
        options: ViewerOptions,
        kernel: Option<KernelFile>,
        start: Instant,
        mailbox: Mailbox,
        player: Option<Player>,
    ) -> Self {
        let (state, complaint) = StateFile::read(options.state.clone());
        let mut application = Application {
            start,
            saved_views: SavedViews::default(),
            clipboard: None,
            flown: None,
            session: Session::new(
                options.look.applied(View::default(), &Origin::default()),
                options.size.unwrap_or(Preferences::of_process().size),
                1.0,
            ),
            translation: Translation::default(),
            schedule: Schedule::new(start),
            renderer: Renderer::start(mailbox.clone()),
            work: Work::Idle,
            saves: VecDeque::new(),
            saving: None,
            paces: [Paces::guessed(true); 2],
            target: options.target,
            last_draft: Draft::FINE,
            figures: Figures::default(),
            pulse: Pulse::default(),
            comparison: Comparison::default(),
            sight: Sight::default(),
            scene: None,
            built: options.structure,
            building: options.structure,
            inventory: None,
            names: Names::default(),
            shown_load: 0,
            source: options.source.clone(),
            focus: None,
            watcher: Watcher::start(mailbox.clone(), || Notice::Changed),
            loads: LoadQueue::default(),
            reloads: 0,
            dropped: Vec::new(),
            held_at_drop: None,
            recent: state.remembered.recent.clone(),
            is_choosing: false,
            kernel,
            gpu: GpuState::Closed,
            wants_gpu: false,
            takes_software: false,
            recovery: Recovery::default(),
            window: None,
            screen: None,
            image: None,
            is_shown: false,
            samples: 0,
            part: Part::Whole,
            next_turn: None,
            panel: None,
            panels: Vec::new(),
            overlay: Overlay::default(),
            title: String::new(),
            message: None,
            retry: None,
            player,
            last_save: None,
            quits: false,
            failure: None,
            state,
            mailbox,
            options,
        };
        application.session.seeing = Seeing::new(application.options.structure.parts.traversal);
        let remembered = application.state.remembered.panel;
        application.session.panel = application.options.panel.unwrap_or(remembered);
        if let Some(sentence) = complaint {
            application.tell(sentence, true);
        }
        application.session.structure = application.options.structure;
        application.load(application.options.source.clone());
        match application.options.backend {
            BackendChoice::Cpu => {}
            // A kernel cannot do without.
            BackendChoice::Auto => application.open_gpu(false, application.kernel.is_some()),
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
        self.show_message(text, is_warning, About::Other);
    }

    /// Tells the person of what failed; what is done at last of the same kind takes it back.
    pub(super) fn warn(&mut self, text: String, about: About) {
        eprintln!("{text}");
        self.show_message(text, true, about);
    }

    /// Shows a sentence for a while, of which standard error knows.
    pub(super) fn show_message(&mut self, text: String, is_warning: bool, about: About) {
        self.message = Some(Message {
            text,
            is_warning,
            about,
            until: Instant::now() + MESSAGE,
        });
        self.redraw();
    }

    pub(super) fn redraw(&self) {
        if let Some(window) = &self.window {
            window.request_redraw();
        }
    }

    pub(super) fn open_gpu(&mut self, software: bool, is_required: bool) {
        self.wants_gpu = true;
        self.takes_software = software;
        self.gpu = GpuState::Opening { is_required };
        let options = GpuOptions {
            software,
            module: self.options.module,
            kernel: self.kernel.as_ref().map(|file| file.kernel.clone()),
        };
        open_gpu(options, &self.mailbox);
    }

    /// Takes an event of the window's or of a script's.
    pub(super) fn take_event(&mut self, event: &Event, now: Instant) {
        if let Some(input) = self.chosen_recent(event) {
            self.take_input(input, now);
            return;
        }
        // What is held down has led somewhere until now, and leads elsewhere from now on.
        self.fly(now);
        if let Some(input) = self.translation.translate(event, now) {
            self.take_input(input, now);
        }
        self.fly(now);
    }

    /// Takes an input; the window says why where it cannot be.
    pub(super) fn take_input(&mut self, input: Input, now: Instant) {
        if let Err(reason) = self.ask(input, now) {
            self.tell(sentence(&reason), true);
        }
    }

    /// Takes an input, or says why it cannot be.
    pub(super) fn ask(&mut self, input: Input, now: Instant) -> Result<(), String> {
        match self.session.apply(input) {
            Effect::Nothing => {}
            Effect::Redraw => self.redraw(),
            Effect::Show => {
                self.is_shown = false;
                self.redraw();
            }
            Effect::Render => self.schedule.change(now),
            Effect::Restage => self.restage(now),
            Effect::Pick(at) => self.pick(at),
            Effect::Rebuild => self.reload(),
            Effect::Backend(choice) => self.want_backend(choice, now),
            Effect::Save(path) => self.save(path),
            Effect::Open(paths) => self.open_files(paths),
            Effect::Add(paths) => self.add_files(paths),
            Effect::Choose { beside } => self.choose_files(beside),
            Effect::Recent(index) => return self.open_recent(index),
            Effect::Prompt => self.prompt(now),
            Effect::Typed(step) => self.take_typed(&step, now),
            Effect::SwitchBackend => self.switch_backend(now),
            Effect::ViewSaved(number) => self.keep_view(number),
            Effect::Copy(form) => self.copy_camera(form),
            Effect::Land => self.land(now),
            Effect::Refused(reason) => return Err(reason),
            Effect::Quit => self.quits = true,
        }
        Ok(())
    }

    /// Gives what is shown the staging of the session; its structure stays.
    pub(super) fn restage(&mut self, now: Instant) {
        let Some(scene) = &self.scene else { return };
        let staged = scene.staged(&self.session.staging);
        if staged.is_plain() != scene.is_plain() {
            self.paces = [Paces::guessed(staged.is_plain()); 2];
        }
        self.scene = Some(Arc::new(staged));
        self.schedule.change(now);
    }

    fn save(&mut self, path: Option<PathBuf>) {
        let destination = path.map_or_else(|| Destination::Folder(self.options.pictures.clone()), Destination::File);
        match self.save_task(destination.clone()) {
            Some(task) => self.saves.push_back((destination, task)),
            None => self.tell(
                "There is no picture to save yet; wait until the scene is shown.".into(),
                true,
            ),
        }
    }

    fn switch_backend(&mut self, now: Instant) {
        // Whoever presses the key takes any GPU.
        let choice = if self.wants_gpu {
            BackendChoice::Cpu
        } else {
            BackendChoice::Gpu
        };
        self.want_backend(choice, now);
    }

    fn want_backend(&mut self, choice: BackendChoice, now: Instant) {
        let wanted = choice != BackendChoice::Cpu;
        match self.gpu {
            _ if wanted == self.wants_gpu => return,
            GpuState::Open(_) => {
                self.wants_gpu = wanted;
                self.schedule.change(now);
            }
            GpuState::Opening { .. } => self.wants_gpu = wanted,
            GpuState::Closed if wanted => self.open_gpu(choice == BackendChoice::Gpu, false),
            GpuState::Closed => {}
        }
        self.redraw();
    }
}

/// A reason as a sentence.
pub(super) fn sentence(reason: &str) -> String {
    let mut characters = reason.chars();
    let first = characters.next().map(char::to_uppercase);
    first.into_iter().flatten().chain(characters).chain(['.']).collect()
}
