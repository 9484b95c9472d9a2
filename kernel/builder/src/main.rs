//! Compiles oktant's kernel, or checks that the committed module still belongs to its sources.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use oktant_kernel_builder::{Error, MANIFEST_FILE, Manifest, disassemble};

use crate::compiler::Compiler;

mod compiler;

/// The crates in the kernel's folder that are compiled with it, each to a module of its own.
const MODULES: [&str; 3] = ["lists", "parts", "probes"];

/// Compiles oktant's kernel to SPIR-V with rust-gpu and writes the module and its manifest.
///
/// Exit code: 0 when all is well, 1 when not (one sentence says what to do), 2 for a wrong command line.
#[derive(Debug, Parser)]
#[command(version)]
struct Arguments {
    /// Compile and compare with what is there instead of writing.
    #[arg(long, group = "mode")]
    check: bool,
    /// Compare only the hash of the sources; needs no compiler.
    #[arg(long, group = "mode")]
    hash: bool,
    /// Print the module that is there as SPIR-V assembly.
    #[arg(long, group = "mode")]
    disassemble: bool,
    /// The kernel crate [default: kernel, in oktant's workspace, and the crates kernel/lists, kernel/parts and
    /// kernel/probes, each of which has a folder of its name in --out].
    #[arg(long = "crate", value_name = "DIR")]
    crate_dir: Option<PathBuf>,
    /// Where the module and its manifest belong [default: compiled, in the kernel crate].
    ///
    /// Only with this option do RUSTGPU_CODEGEN_ARGS and RUSTGPU_RUSTFLAGS reach the compiler.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    // SAFETY: main has started no thread.
    unsafe { compiler::pin_environment(arguments.out.is_some()) };
    match run(&arguments) {
        // Whoever closed standard output early (`| head`) has seen enough.
        Ok(text) => match writeln!(io::stdout(), "{text}") {
            Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
                eprintln!("Cannot write to standard output: {error}.");
                ExitCode::FAILURE
            }
            _ => ExitCode::SUCCESS,
        },
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> Result<String, Error> {
    let kernel = Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .expect("the builder lies in the folder of the kernel");
    let crate_dir = arguments.crate_dir.as_deref().unwrap_or(kernel);
    let out = arguments.out.clone().unwrap_or_else(|| crate_dir.join("compiled"));
    let mut done = build(arguments, crate_dir, &out)?;
    if arguments.crate_dir.is_none() && !arguments.disassemble {
        for module in MODULES {
            done += "\n";
            done += &build(arguments, &crate_dir.join(module), &out.join(module))?;
        }
    }
    Ok(done)
}

fn build(arguments: &Arguments, crate_dir: &Path, out: &Path) -> Result<String, Error> {
    if arguments.disassemble {
        let manifest = Manifest::read(&out.join(MANIFEST_FILE))?;
        return disassemble(&read(&out.join(manifest.file))?);
    }
    if arguments.check || arguments.hash {
        return check(crate_dir, out, arguments.check);
    }
    let (module, manifest) = Compiler::find(crate_dir)?.compile(crate_dir)?;
    manifest.write(&module, out)?;
    Ok(format!(
        "Wrote {} ({} bytes, {} entry points) and its manifest.",
        out.join(&manifest.file).display(),
        module.len(),
        manifest.entry_points.len()
    ))
}

fn check(crate_dir: &Path, out: &Path, compile: bool) -> Result<String, Error> {
    let manifest = Manifest::read(&out.join(MANIFEST_FILE))?;
    let what = format!("What is compiled in {}", out.display());
    manifest.check_sources(crate_dir)?;
    let module = read(&out.join(&manifest.file))?;
    manifest.check_module(&module)?;
    if !compile {
        return Ok(format!("{what} belongs to its sources."));
    }
    let compiler = match Compiler::find(crate_dir) {
        Ok(compiler) if compiler.version() == manifest.rustc => compiler,
        Ok(compiler) => {
            return Ok(format!(
                "{what} belongs to its sources; its bytes were not compared, because it was compiled by {} and here is {}.",
                manifest.rustc,
                compiler.version()
            ));
        }
        Err(Error::NoCompiler) => {
            return Ok(format!(
                "{what} belongs to its sources; its bytes were not compared, because rust-gpu's compiler is not installed."
            ));
        }
        Err(error) => return Err(error),
    };
    let (fresh, described) = compiler.compile(crate_dir)?;
    if fresh != module {
        return Err(Error::Stale(format!(
            "{} compiles the same sources to other bytes",
            compiler.version()
        )));
    }
    if described != manifest {
        return Err(Error::Stale("the manifest is not what the builder would write".into()));
    }
    Ok(format!("{what} is, byte for byte, what its sources compile to."))
}

fn read(path: &Path) -> Result<Vec<u8>, Error> {
    fs::read(path).map_err(|source| Error::Read {
        path: path.to_path_buf(),
        source,
    })
}
