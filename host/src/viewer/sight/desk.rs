//! Who answers questions.

use super::question::{Answer, Question};
use crate::viewer::accident::caught;
use crate::viewer::notice::{Mailbox, Notice};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

/// Answers the newest question on a thread of its own, one at a time. An old one is given up only where there was an answer
/// already, and that answer stays until there is another: so there is something to see while the camera moves.
#[derive(Default)]
pub struct Desk {
    /// Number of the last question that was begun.
    number: u64,
    cancel: Arc<AtomicBool>,
    /// What is being answered.
    running: Option<Question>,
    /// Whether there was an answer to it.
    has_answered: bool,
    answer: Option<Arc<Answer>>,
    /// What was answered to the end, or cannot be.
    done: Option<Question>,
}

/// What comes from the thread.
#[derive(Clone, Debug)]
pub enum Told {
    /// An answer, or a better one.
    Answer(Arc<Answer>),
    /// There is none, in a sentence.
    Failed(String),
    /// No more answers come: the last one is all that there is, or (false) nobody wanted it.
    Ended(bool),
}

impl Desk {
    /// Sees to it that a question is answered; where there is none, gives up and forgets all. True where something is
    /// forgotten that was to be seen.
    pub fn want(&mut self, question: Option<Question>, desk: usize, mailbox: &Mailbox) -> bool {
        let Some(question) = question else {
            let had = self.answer.is_some();
            self.clear();
            return had;
        };
        match &self.running {
            Some(running) if *running == question => {}
            Some(_) if self.has_answered => self.cancel.store(true, Ordering::Relaxed),
            Some(_) => {}
            None if self.done.as_ref() == Some(&question) => {}
            None => self.start(question, desk, mailbox),
        }
        false
    }

    /// Gives up, and forgets all.
    pub fn clear(&mut self) {
        self.cancel.store(true, Ordering::Relaxed);
        // What still comes is of an old number.
        self.number += 1;
        self.running = None;
        self.answer = None;
        self.done = None;
    }

    fn start(&mut self, question: Question, desk: usize, mailbox: &Mailbox) {
        self.number += 1;
        self.cancel = Arc::default();
        self.running = Some(question.clone());
        self.has_answered = false;
        let (number, cancel, mailbox) = (self.number, self.cancel.clone(), mailbox.clone());
        thread::spawn(move || {
            let send = |told| mailbox.send(Notice::Told { desk, number, told });
            let tell = |answer| send(Told::Answer(Arc::new(answer)));
            send(match caught(|| question.answer(&cancel, &tell)) {
                Ok(Ok(is_complete)) => Told::Ended(is_complete),
                Ok(Err(sentence)) => Told::Failed(sentence),
                Err(accident) => Told::Failed(format!(
                    "What is behind the picture could not be told by a mistake in oktant ({accident}); please report it, \
                     with the scene's files."
                )),
            });
        });
    }

    /// Takes what was told; the sentence where there is no answer.
    pub fn take(&mut self, number: u64, told: Told) -> Option<String> {
        if number != self.number {
            return None;
        }
        match told {
            Told::Answer(answer) => {
                self.answer = Some(answer);
                self.has_answered = true;
                None
            }
            Told::Ended(is_complete) => {
                self.done = self.running.take().filter(|_| is_complete);
                None
            }
            Told::Failed(sentence) => {
                self.done = self.running.take();
                self.answer = None;
                Some(sentence)
            }
        }
    }

    /// What there is to see.
    pub fn answer(&self) -> Option<&Answer> {
        self.answer.as_deref()
    }

    /// Whether a question is answered to the end, or cannot be.
    pub fn is_done(&self, question: Option<&Question>) -> bool {
        question == self.done.as_ref() && self.running.is_none()
    }
}
