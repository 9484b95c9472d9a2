//! Starting the program, looking at its window and reaching into it.

mod display;
mod dragging;
mod report;

pub use display::{Display, screen_of};
pub use dragging::drop_files;
pub use report::{Report, value_in};

use oktant::backend::Backend;
use oktant::backend::cpu::Cpu;
use oktant::mesh_source::MeshSource;
use oktant::progress::silent;
use oktant::scene::Scene;
use oktant::structure::StructureOptions;
use oktant::view::{Shading, View};
use oktant_tests::program::oktant;
use std::io::Read;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, LazyLock};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// A picture with red, green and blue a pixel.
pub type Image = image::RgbImage;

/// Whatever takes longer has gone wrong.
const PATIENCE: Duration = Duration::from_secs(60);

/// A folder in which the program runs.
pub struct Session {
    folder: TempDir,
}

impl Session {
    pub fn new() -> Self {
        Session {
            folder: tempfile::tempdir().expect("there is a temporary folder"),
        }
    }

    /// Where it is.
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// Writes a file; returns its name.
    pub fn write(&self, name: &str, text: &str) -> String {
        std::fs::write(self.folder.path().join(name), text).expect("the folder can be written");
        name.into()
    }

    /// Saves a file as many editors do: under another name first.
    pub fn replace(&self, name: &str, text: &str) {
        let file = |name: &str| self.folder.path().join(name);
        self.write("new", text);
        std::fs::rename(file("new"), file(name)).expect("files can be renamed");
    }

    /// Names of all files there.
    pub fn files(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.folder.path()).expect("the folder can be read");
        entries
            .map(|entry| {
                entry
                    .expect("it can be read to its end")
                    .file_name()
                    .to_string_lossy()
                    .into()
            })
            .collect()
    }

    /// The program with arguments, in the folder.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(oktant());
        command
            .args(arguments)
            .current_dir(self.folder.path())
            .env("OKTANT_STATE", "")
            .stdin(Stdio::null());
        command
    }

    /// Starts the viewer with arguments, and with a script if that is not empty.
    pub fn start(&self, arguments: &[&str], script: &str) -> Running {
        let mut all = vec!["view"];
        all.extend(arguments);
        if !script.is_empty() {
            self.write("script.txt", script);
            all.extend(["--script", "script.txt"]);
        }
        self.start_with(&all)
    }

    /// Starts the program.
    pub fn start_with(&self, arguments: &[&str]) -> Running {
        start(&mut self.command(arguments))
    }

    /// The picture in a file that is about to appear; files appear complete.
    pub fn await_picture(&self, name: &str) -> Image {
        let path = self.folder.path().join(name);
        let start = Instant::now();
        while !path.exists() {
            assert!(start.elapsed() < PATIENCE, "{name} was not written");
            thread::sleep(Duration::from_millis(20));
        }
        image::open(path).expect("the program writes PNG files").to_rgb8()
    }
}

/// A program that runs.
pub struct Running {
    child: Child,
    output: Option<JoinHandle<String>>,
    error: Option<JoinHandle<String>>,
}

/// Starts a command.
pub fn start(command: &mut Command) -> Running {
    let mut child = command
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let output = listen(child.stdout.take().expect("it is a pipe"));
    let error = listen(child.stderr.take().expect("it is a pipe"));
    Running {
        child,
        output: Some(output),
        error: Some(error),
    }
}

/// Reads what is printed while it is: whoever fills a pipe waits.
fn listen(mut pipe: impl Read + Send + 'static) -> JoinHandle<String> {
    thread::spawn(move || {
        let mut text = String::new();
        pipe.read_to_string(&mut text).expect("the program prints text");
        text
    })
}

impl Running {
    /// Waits for its end, which must be a good one.
    pub fn finish(&mut self) -> Report {
        self.finish_within(PATIENCE)
    }

    /// Waits so long for its end, which must be a good one.
    pub fn finish_within(&mut self, patience: Duration) -> Report {
        let report = self.wait_within(patience);
        assert_eq!(report.code, Some(0), "{report}");
        report
    }

    /// Waits for its end.
    pub fn wait(&mut self) -> Report {
        self.wait_within(PATIENCE)
    }

    /// Whether it has.
    pub fn has_ended(&mut self) -> bool {
        self.child.try_wait().expect("a child can be waited for").is_some()
    }

    /// Memory that is resident, bytes, as Linux tells it.
    pub fn resident_memory(&self) -> u64 {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.child.id()));
        let status = status.expect("the process is there");
        let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
        let kibibytes = line.map(|line| line.trim().trim_end_matches("kB").trim().parse::<u64>());
        kibibytes.expect("Linux tells it").expect("a number") << 10
    }

    fn wait_within(&mut self, patience: Duration) -> Report {
        let start = Instant::now();
        let status = loop {
            if let Some(status) = self.child.try_wait().expect("a child can be waited for") {
                break status;
            }
            assert!(start.elapsed() < patience, "the window does not close");
            thread::sleep(Duration::from_millis(5));
        };
        let heard = |pipe: &mut Option<JoinHandle<String>>| {
            let pipe = pipe.take().expect("it ends once");
            pipe.join().expect("it was read to its end")
        };
        Report {
            code: status.code(),
            standard_output: heard(&mut self.output),
            standard_error: heard(&mut self.error),
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        // It has ended, or the test failed.
        drop(self.child.kill());
        drop(self.child.wait());
    }
}

/// Runs a command to its end, whatever that is.
pub fn ended(command: &mut Command) -> Report {
    let output = command.output().expect("the program starts");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    Report {
        code: output.status.code(),
        standard_output: text(&output.stdout),
        standard_error: text(&output.stderr),
    }
}

/// Plays a script to its good end.
pub fn run(session: &Session, arguments: &[&str], script: &str) -> Report {
    session.start(arguments, script).finish()
}

/// The picture that `oktant render` makes of the bunny.
pub fn rendered_by_the_command(session: &Session, view: &View, size: [u32; 2]) -> Image {
    assert_eq!(view.target, glam::Vec3::ZERO, "the command line cannot pan");
    let mut arguments: Vec<String> = vec!["render".into(), "--backend".into(), "cpu".into()];
    let mut option = |name: &str, value: String| arguments.push(format!("--{name}={value}"));
    option("output", "rendered.png".into());
    option("size", format!("{}x{}", size[0], size[1]));
    option("samples", view.samples.count().to_string());
    option(
        "shading",
        if view.shading == Shading::Flat { "flat" } else { "phong" }.into(),
    );
    for (prefix, place) in [("", view.camera), ("light-", view.light)] {
        option(&format!("{prefix}azimuth"), place.azimuth.to_string());
        option(&format!("{prefix}elevation"), place.elevation.to_string());
        option(&format!("{prefix}distance"), place.distance.to_string());
    }
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    session.start_with(&arguments).finish();
    session.await_picture("rendered.png")
}

/// The picture of the bunny that this very process renders, with both eyes' rows where there are two.
pub fn offline(view: &View, size: [u32; 2]) -> Image {
    static SCENE: LazyLock<Arc<Scene>> = LazyLock::new(|| {
        let mesh = MeshSource::Bunny.load(&silent).expect("the bunny is sound");
        Arc::new(Scene::new(&mesh, &StructureOptions::default(), &silent).expect("the bunny has triangles"))
    });
    let frame = view.frame(&SCENE, size[0], size[1]);
    let picture = Cpu::new(SCENE.clone())
        .render(&frame, &silent)
        .expect("the CPU renders");
    Image::from_raw(picture.width, picture.height, picture.to_rgb8(&view.tone)).expect("as many pixels as asked for")
}

/// Mean difference of two pictures' channels, of 255.
pub fn difference(one: &Image, other: &Image) -> f64 {
    assert_eq!(one.dimensions(), other.dimensions());
    let sum: u64 = one
        .iter()
        .zip(other.iter())
        .map(|(a, b)| u64::from(a.abs_diff(*b)))
        .sum();
    sum as f64 / one.len() as f64
}

/// Share of the pixels none of whose channels differs by more than 1 of 255; 0 for pictures of different sizes.
pub fn agreement(one: &Image, other: &Image) -> f64 {
    if one.dimensions() != other.dimensions() {
        return 0.0;
    }
    let alike = one
        .pixels()
        .zip(other.pixels())
        .filter(|(a, b)| a.0.iter().zip(b.0).all(|(a, b)| a.abs_diff(b) <= 1))
        .count();
    alike as f64 / (one.width() * one.height()) as f64
}
