//! Where text goes that an option names a file for.

use super::Failure;
use super::arguments::is_standard_output;
use oktant::output::{OutputError, TextFile};
use std::path::Path;

/// Makes sure that a file can be written, without touching what is there; `-` is standard output.
///
/// # Errors
/// [`OutputError`] where it cannot.
pub fn create(path: &Path) -> Result<TextFile, OutputError> {
    if is_standard_output(path) {
        TextFile::standard_output()
    } else {
        TextFile::create(path)
    }
}

/// Whether one of two options takes standard output for itself, so that nothing else is printed.
///
/// # Errors
/// Both of them.
pub fn goes_to_standard_output(options: [(&str, Option<&Path>); 2]) -> Result<bool, Failure> {
    let [one, other] = options.map(|(_, path)| path.is_some_and(is_standard_output));
    let [(name, _), (other_name, _)] = options;
    if one && other {
        return Err(Failure::usage(format!(
            "Standard output takes one of {name} and {other_name}; give the other one the name of a file."
        )));
    }
    Ok(one || other)
}
