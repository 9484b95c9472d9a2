//! The thread that renders, so that the window never waits.

use super::notice::Mailbox;
use super::task::{Destination, Task};
use super::worker::Worker;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::thread::{self, JoinHandle};

/// The window's end of the thread.
pub struct Renderer {
    /// None once it is closed.
    tasks: Option<Sender<Task>>,
    cancel: Arc<AtomicBool>,
    closes: Arc<AtomicBool>,
    thread: Option<JoinHandle<Vec<Destination>>>,
}

impl Renderer {
    /// Starts the thread; it ends when the renderer is dropped.
    pub fn start(mailbox: Mailbox) -> Self {
        let (tasks, queue) = channel();
        let (cancel, closes) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicBool::new(false)));
        let worker = Worker::new(mailbox, cancel.clone(), closes.clone());
        Renderer {
            tasks: Some(tasks),
            cancel,
            closes,
            thread: Some(thread::spawn(move || worker.work(&queue))),
        }
    }

    /// Gives the thread a picture to show. It must have none: it says [`super::notice::Notice::Finished`] after each.
    pub fn show(&self, task: Task) {
        self.cancel.store(false, Ordering::Relaxed);
        self.send(task);
    }

    /// Gives the thread a picture to save. It must have none: it says [`super::notice::Notice::Saved`] after each.
    pub fn save(&self, task: Task) {
        self.send(task);
    }

    fn send(&self, task: Task) {
        if let Some(tasks) = &self.tasks {
            // The thread is gone only when the window is.
            drop(tasks.send(task));
        }
    }

    /// Makes the thread give up the picture that is to be shown soon.
    pub fn cancel(&self) {
        self.cancel.store(true, Ordering::Relaxed);
    }

    /// Makes the thread give up everything, and waits until it has cleaned up. Returns where pictures were to be saved
    /// that are not.
    pub fn close(&mut self) -> Vec<Destination> {
        self.give_up();
        // It may be waiting for one.
        self.tasks = None;
        let thread = self.thread.take();
        thread.and_then(|thread| thread.join().ok()).unwrap_or_default()
    }

    fn give_up(&self) {
        self.closes.store(true, Ordering::Relaxed);
        self.cancel();
    }
}

impl Drop for Renderer {
    fn drop(&mut self) {
        self.give_up();
    }
}
