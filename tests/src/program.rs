//! Running the program as a person would.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::LazyLock;
use std::time::{Duration, Instant};

/// The program, built from the sources as they are and with the profile of the tests.
static OKTANT: LazyLock<PathBuf> = LazyLock::new(|| {
    let tests = std::env::current_exe().expect("a test has a path");
    let profile = tests.ancestors().nth(2).expect("tests are in target/PROFILE/deps");
    // Cargo runs the tests of this crate without building the program of another; where tests run without cargo, the
    // program lies beside them.
    if let Some(cargo) = std::env::var_os("CARGO") {
        let mut build = Command::new(cargo);
        // Of the whole workspace, so that its dependencies have the features that they were compiled with for the tests.
        build.args(["build", "--quiet", "--workspace", "--bin", "oktant", "--manifest-path"]);
        build.arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("../Cargo.toml"));
        build
            .arg("--target-dir")
            .arg(profile.parent().expect("target holds the profile"));
        if profile.ends_with("release") {
            build.arg("--release");
        }
        assert!(build.status().expect("cargo runs").success(), "oktant does not build");
    }
    let oktant = profile.join("oktant").with_extension(std::env::consts::EXE_EXTENSION);
    assert!(oktant.is_file(), "{} is missing; build it first", oktant.display());
    oktant
});

/// The program's path.
pub fn oktant() -> &'static Path {
    &OKTANT
}

/// What came of a run.
#[derive(Clone, Debug)]
pub struct Run {
    /// The exit code; none where a signal ended the process.
    pub code: Option<i32>,
    /// Standard output.
    pub output: String,
    /// Standard error.
    pub error: String,
    /// From start to end.
    pub time: Duration,
    /// Most memory that was resident at a time, bytes; 0 where the system does not tell.
    pub memory: u64,
}

/// Runs the program in a folder, with neither display nor terminal.
///
/// # Panics
/// Where the program cannot be started.
pub fn run<A: AsRef<OsStr>>(folder: &Path, arguments: impl IntoIterator<Item = A>) -> Run {
    let mut command = Command::new(oktant());
    command
        .args(arguments)
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY");
    finish(command.current_dir(folder))
}

/// Runs a command to its end, with its output caught.
///
/// # Panics
/// Where it cannot be started.
pub fn finish(command: &mut Command) -> Run {
    forget_preferences(command);
    let start = Instant::now();
    let child = command
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let id = child.id();
    // The system tells the peak only as long as the process is there.
    let watch = std::thread::spawn(move || {
        let mut peak = 0;
        while let Some(now) = peak_memory(id) {
            peak = peak.max(now);
            std::thread::sleep(Duration::from_millis(1));
        }
        peak
    });
    let output = child.wait_with_output().expect("the command ends");
    Run {
        time: start.elapsed(),
        code: output.status.code(),
        output: String::from_utf8_lossy(&output.stdout).into_owned(),
        error: String::from_utf8_lossy(&output.stderr).into_owned(),
        memory: watch.join().expect("watching does not fail"),
    }
}

/// Lets a run know nothing of what the person who runs the tests prefers, unless it is told itself.
fn forget_preferences(command: &mut Command) {
    let told: Vec<_> = command.get_envs().map(|(name, _)| name.to_os_string()).collect();
    for (name, _) in std::env::vars_os() {
        if name.to_string_lossy().starts_with("OKTANT_") && !told.contains(&name) {
            command.env_remove(name);
        }
    }
    if !told.iter().any(|name| name == "OKTANT_CONFIG") {
        command.env("OKTANT_CONFIG", "");
    }
}

/// Most memory that a process had resident, bytes, as Linux tells it.
fn peak_memory(id: u32) -> Option<u64> {
    let status = std::fs::read_to_string(format!("/proc/{id}/status")).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().trim_end_matches("kB").trim().parse().ok()?;
    Some(kibibytes << 10)
}
