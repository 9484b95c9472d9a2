//! What readers warn of, for those who have no terminal.

use std::fmt::Debug;
use std::sync::{Arc, Mutex, PoisonError};
use tracing::field::{Field, Visit};
use tracing::level_filters::LevelFilter;
use tracing::span::{Attributes, Id, Record};
use tracing::{Dispatch, Event, Level, Metadata, Subscriber, dispatcher, subscriber};

/// Does something; returns what came of it, and what oktant warned of meanwhile on this thread. Who is told of warnings
/// otherwise is told of these too.
pub fn overheard<T>(work: impl FnOnce() -> T) -> (T, Vec<String>) {
    let heard = Arc::new(Mutex::new(Vec::new()));
    let listener = Listener {
        heard: heard.clone(),
        others: dispatcher::get_default(Dispatch::clone),
        most: LevelFilter::current().max(LevelFilter::WARN),
    };
    let result = subscriber::with_default(listener, work);
    let warnings = std::mem::take(&mut *heard.lock().unwrap_or_else(PoisonError::into_inner));
    (result, warnings)
}

/// All of them in one sentence; none where there are none.
pub fn sentence(warnings: &[String]) -> Option<String> {
    let (first, others) = warnings.split_first()?;
    let first = first.trim_end_matches('.');
    Some(match others.len() {
        0 => format!("{first}."),
        more => format!("{first}; and {more} more."),
    })
}

/// Keeps warnings, and hands everything on.
struct Listener {
    heard: Arc<Mutex<Vec<String>>>,
    others: Dispatch,
    /// The level of the least important things that somebody listens to.
    most: LevelFilter,
}

/// Whether it is a warning of oktant's.
fn is_warning(metadata: &Metadata<'_>) -> bool {
    *metadata.level() == Level::WARN && metadata.is_event() && metadata.target().starts_with("oktant")
}

impl Subscriber for Listener {
    fn enabled(&self, metadata: &Metadata<'_>) -> bool {
        is_warning(metadata) || self.others.enabled(metadata)
    }

    fn max_level_hint(&self) -> Option<LevelFilter> {
        Some(self.most)
    }

    fn event(&self, event: &Event<'_>) {
        if is_warning(event.metadata()) {
            let mut text = Text::default();
            event.record(&mut text);
            self.heard.lock().unwrap_or_else(PoisonError::into_inner).push(text.0);
        }
        if self.others.enabled(event.metadata()) {
            self.others.event(event);
        }
    }

    fn new_span(&self, span: &Attributes<'_>) -> Id {
        self.others.new_span(span)
    }

    fn record(&self, span: &Id, values: &Record<'_>) {
        self.others.record(span, values);
    }

    fn record_follows_from(&self, span: &Id, follows: &Id) {
        self.others.record_follows_from(span, follows);
    }

    fn enter(&self, span: &Id) {
        self.others.enter(span);
    }

    fn exit(&self, span: &Id) {
        self.others.exit(span);
    }

    fn clone_span(&self, span: &Id) -> Id {
        self.others.clone_span(span)
    }

    fn try_close(&self, span: Id) -> bool {
        self.others.try_close(span)
    }
}

/// What an event says.
#[derive(Default)]
struct Text(String);

impl Visit for Text {
    fn record_debug(&mut self, field: &Field, value: &dyn Debug) {
        if field.name() == "message" {
            self.0 = format!("{value:?}");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn warnings_are_overheard() {
        let (result, warnings) = overheard(|| {
            tracing::warn!("{}: one", "a.obj");
            tracing::info!("nothing to worry about");
            tracing::warn!(target: "somebody", "else");
            // Who listens within this hears it first.
            let (_, inner) = overheard(|| tracing::warn!("two"));
            assert_eq!(inner, ["two"]);
            7
        });
        assert_eq!((result, warnings), (7, vec!["a.obj: one".to_owned(), "two".to_owned()]));
        assert!(overheard(|| ()).1.is_empty());
    }

    #[test]
    fn the_first_is_told_and_the_others_are_counted() {
        let told = |warnings: &[&str]| sentence(&warnings.iter().map(ToString::to_string).collect::<Vec<_>>());
        assert_eq!(told(&[]), None);
        assert_eq!(told(&["a is missing"]).as_deref(), Some("a is missing."));
        assert_eq!(
            told(&["a is missing.", "b", "c"]).as_deref(),
            Some("a is missing; and 2 more.")
        );
    }
}
