//! `oktant man`.

use super::Failure;
use super::arguments::{Arguments, ManArguments};
use super::render::counted;
use clap::CommandFactory;
use clap_mangen::Man;
use oktant::output::TextFile;
use std::io;

/// What stands at the foot of every page.
const PROGRAM: &str = concat!("oktant ", env!("CARGO_PKG_VERSION"));

/// A manual page.
struct Page {
    /// As `man` knows it: `oktant-render` is of `oktant render`.
    name: String,
    /// In roff.
    text: String,
}

/// Prints a page, or writes those of all commands into a folder.
pub fn run(arguments: &ManArguments) -> Result<(), Failure> {
    let pages = pages()?;
    let Some(folder) = &arguments.output else {
        return super::print(&page(&pages, arguments.command.as_deref())?.text);
    };
    // First of all, so that none is written where one cannot be.
    let files = pages
        .iter()
        .map(|page| TextFile::create(&folder.join(format!("{}.1", page.name))))
        .collect::<Result<Vec<_>, _>>()?;
    for (file, page) in files.into_iter().zip(&pages) {
        file.save(&page.text)?;
    }
    eprintln!("{}: {}", folder.display(), counted(pages.len(), "page"));
    Ok(())
}

/// The page of a command, or of the program.
fn page<'a>(pages: &'a [Page], command: Option<&str>) -> Result<&'a Page, Failure> {
    let name = command.map_or("oktant".into(), |command| format!("oktant-{command}"));
    pages.iter().find(|page| page.name == name).ok_or_else(|| {
        let names: Vec<_> = pages
            .iter()
            .filter_map(|page| page.name.strip_prefix("oktant-"))
            .collect();
        Failure::usage(format!("There is no such command: give one of {}.", names.join(", ")))
    })
}

/// The page of the program first, then that of each command.
fn pages() -> Result<Vec<Page>, Failure> {
    // The command `help` needs no page, for every command has one.
    let mut program = Arguments::command().disable_help_subcommand(true);
    program.build();
    let mut pages = vec![Page::new(&program)?];
    for command in program.get_subcommands() {
        pages.push(Page::new(command)?);
    }
    Ok(pages)
}

impl Page {
    fn new(command: &clap::Command) -> io::Result<Self> {
        let mut text = Vec::new();
        Man::new(command.clone()).source(PROGRAM).render(&mut text)?;
        let name = command.get_display_name().unwrap_or_else(|| command.get_name());
        Ok(Page {
            name: name.into(),
            text: String::from_utf8_lossy(&text).into_owned(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_has_a_page_with_all_its_options() {
        let pages = pages().unwrap_or_else(|failure| panic!("{}", failure.sentence));
        let mut program = Arguments::command();
        program.build();
        let commands: Vec<_> = program
            .get_subcommands()
            .filter(|command| command.get_name() != "help")
            .collect();
        assert_eq!(pages.len(), 1 + commands.len());
        for command in commands {
            let Ok(page) = page(&pages, Some(command.get_name())) else {
                panic!("{} has no page", command.get_name());
            };
            assert!(page.text.starts_with(".ie"), "it is roff: {}", &page.text[..40]);
            let title = page.text.lines().find(|line| line.starts_with(".TH"));
            assert!(title.is_some_and(|title| title.contains(PROGRAM)), "{title:?}");
            for long in command.get_arguments().filter_map(clap::Arg::get_long) {
                let option = format!("\\-\\-{}", long.replace('-', "\\-"));
                assert!(page.text.contains(&option), "{option} of {}", command.get_name());
            }
        }
        assert!(page(&pages, None).is_ok_and(|page| page.name == "oktant"));
        assert!(
            page(&pages, Some("draw")).is_err_and(|failure| failure.code == 2 && failure.sentence.contains("render"))
        );
    }
}
