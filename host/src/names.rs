//! What a file calls what is in it.

/// Names of parts of a scene, for people.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    /// By material id, as far as there are some.
    pub materials: Vec<Option<String>>,
    /// The image that is around.
    pub environment: Option<String>,
}

impl Names {
    /// The name of a material, if it has one.
    pub fn material(&self, index: usize) -> Option<&str> {
        self.materials.get(index)?.as_deref()
    }

    /// The materials that have names: ids and names.
    pub fn materials(&self) -> impl Iterator<Item = (usize, &str)> {
        let named = self.materials.iter().enumerate();
        named.filter_map(|(index, name)| Some((index, name.as_deref()?)))
    }
}

/// A name, or text with names in it, as a line has it: what would end the line, or is no letter at all, is a space.
pub fn on_one_line(text: &str) -> String {
    text.replace(char::is_control, " ")
}
