//! Places in a TOML file.

/// A step from a table or array to what is in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// To the value of a key.
    Key(String),
    /// To an element, from 0.
    Index(usize),
}

/// The way from the top of a file to a value.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place(Vec<Step>);

impl Place {
    /// The whole file.
    pub const ROOT: Place = Place(Vec::new());

    /// The place of a top-level table or field.
    pub fn of(key: &str) -> Self {
        Place::ROOT.key(key)
    }

    /// The place of a key's value in the table here.
    pub fn key(&self, key: &str) -> Self {
        self.with(Step::Key(key.into()))
    }

    /// The place of an element in the array here.
    pub fn index(&self, index: usize) -> Self {
        self.with(Step::Index(index))
    }

    /// Whether the topmost step is to this key.
    pub fn is_below(&self, key: &str) -> bool {
        matches!(self.0.first(), Some(Step::Key(first)) if first == key)
    }

    fn with(&self, step: Step) -> Self {
        let mut place = self.clone();
        place.0.push(step);
        place
    }

    /// Puts a step in front.
    pub fn prepend(&mut self, step: Step) {
        self.0.insert(0, step);
    }

    /// As people say it: keys joined by dots, or `whole` at the top. Which element of an array is meant, the line says.
    pub fn name(&self, whole: &str) -> String {
        let keys: Vec<_> = self
            .0
            .iter()
            .filter_map(|step| match step {
                Step::Key(key) => Some(key.as_str()),
                Step::Index(_) => None,
            })
            .collect();
        if keys.is_empty() { whole.into() } else { keys.join(".") }
    }

    /// The steps, the topmost first.
    pub fn steps(&self) -> &[Step] {
        &self.0
    }
}
