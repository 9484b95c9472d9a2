//! How long work reports its progress to whoever shows it.

/// Receives the name of the stage ("reading", "building") and the finished fraction of it, 0 to 1.
///
/// Called from any thread, a few hundred times a stage at most.
pub type Progress<'a> = &'a (dyn Fn(&'static str, f32) + Sync);

/// A [`Progress`] that tells nobody.
pub fn silent(_stage: &'static str, _fraction: f32) {}
