//! `oktant config`.

use super::Failure;
use super::arguments::ConfigArguments;
use super::configuration::{self, Configuration, FILE_VARIABLE, Origin, Preference};
use super::kernels::aligned;
use serde::Serialize;

/// Everything there is to say.
#[derive(Serialize)]
struct Listing {
    /// The file, there or not; none where nobody wants one.
    path: Option<String>,
    settings: Vec<Setting>,
}

/// A setting that is in force.
#[derive(Serialize)]
struct Setting {
    name: &'static str,
    value: String,
    /// "default", "file" or "environment".
    origin: &'static str,
    /// The variable of the environment that says it.
    variable: String,
}

/// Says what is preferred, and where it is from; or where the file is.
pub fn run(arguments: &ConfigArguments) -> Result<(), Failure> {
    if arguments.path {
        let (Some(path), _) = configuration::path() else {
            return Err(Failure {
                sentence: format!("There is no configuration file as long as {FILE_VARIABLE} is empty; unset it."),
                code: 1,
            });
        };
        return super::print(&format!("{}\n", path.display()));
    }
    let listing = Listing::new(&Configuration::read()?);
    let text = if arguments.json {
        format!("{}\n", serde_json::to_string_pretty(&listing)?)
    } else {
        listing.text()
    };
    super::print(&text)
}

impl Listing {
    fn new(configuration: &Configuration) -> Self {
        let setting = |preference: &Preference| {
            let (value, origin) = configuration.value(preference);
            Setting {
                name: preference.name,
                value,
                origin: match origin {
                    Origin::Default => "default",
                    Origin::File => "file",
                    Origin::Environment => "environment",
                },
                variable: preference.variable(),
            }
        };
        Listing {
            path: configuration.path.as_ref().map(|path| path.display().to_string()),
            settings: Preference::all().iter().map(setting).collect(),
        }
    }

    fn text(&self) -> String {
        let mut rows = vec![["setting", "value", "from", "variable"].map(String::from)];
        rows.extend(self.settings.iter().map(|setting| {
            [
                setting.name.into(),
                setting.value.clone(),
                setting.origin.into(),
                setting.variable.clone(),
            ]
        }));
        let path = self.path.as_deref().unwrap_or("none");
        format!("file: {path}\n\n{}", aligned(&rows))
    }
}
