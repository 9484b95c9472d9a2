//! Compiled kernels with something changed.

use oktant_kernel_builder::{MANIFEST_FILE, Manifest, sha256};
use std::fs;
use std::path::Path;

const OP_ENTRY_POINT: u32 = 15;
const OP_EXECUTION_MODE: u32 = 16;
const OP_LOAD: u32 = 61;
const LOCAL_SIZE: u32 = 17;
/// Words before the first instruction.
const HEADER: usize = 5;

/// A compiled kernel, whose manifest follows it.
#[derive(Clone)]
pub struct CompiledKernel {
    /// What it says about the kernel, but for the hash.
    pub manifest: Manifest,
    words: Vec<u32>,
}

impl CompiledKernel {
    /// The one that is part of the program.
    ///
    /// # Panics
    /// Where it is not in the repository.
    pub fn committed() -> Self {
        Self::of("compiled")
    }

    /// The one for lists of pixels, which belongs into the folder `lists`.
    ///
    /// # Panics
    /// Where it is not in the repository.
    pub fn lists() -> Self {
        Self::of("compiled/lists")
    }

    /// The one for other parts than the default ones, which belongs into the folder `parts`.
    ///
    /// # Panics
    /// Where it is not in the repository.
    pub fn parts() -> Self {
        Self::of("compiled/parts")
    }

    fn of(folder: &str) -> Self {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../kernel").join(folder);
        let manifest = Manifest::read(&folder.join(MANIFEST_FILE)).expect("the kernel has a manifest");
        let bytes = fs::read(folder.join(&manifest.file)).expect("the kernel is there");
        let words = bytes.chunks_exact(4).map(|word| {
            let word = word.try_into().expect("words have four bytes");
            u32::from_le_bytes(word)
        });
        CompiledKernel {
            words: words.collect(),
            manifest,
        }
    }

    /// The module.
    pub fn bytes(&self) -> Vec<u8> {
        self.words.iter().flat_map(|word| word.to_le_bytes()).collect()
    }

    /// Writes the module and its manifest into a folder.
    ///
    /// # Panics
    /// Where the folder cannot be written.
    pub fn write(&self, folder: &Path) {
        let bytes = self.bytes();
        let manifest = Manifest {
            sha256: sha256(&bytes),
            ..self.manifest.clone()
        };
        manifest.write(&bytes, folder).expect("the folder can be written");
    }

    /// With another name for an entry point.
    ///
    /// # Panics
    /// Where there is none of that name.
    pub fn renamed(&self, from: &str, to: &str) -> Self {
        let mut is_done = false;
        let kernel = self.with_each(|instruction| {
            if instruction[0] & 0xffff != OP_ENTRY_POINT || name(&instruction[3..]) != from {
                return;
            }
            is_done = true;
            let mut padded = to.as_bytes().to_vec();
            padded.resize((to.len() / 4 + 1) * 4, 0);
            let new = padded
                .chunks_exact(4)
                .map(|word| u32::from_le_bytes(word.try_into().expect("words have four bytes")));
            instruction.splice(3..3 + from.len() / 4 + 1, new);
            instruction[0] = (instruction.len() as u32) << 16 | OP_ENTRY_POINT;
        });
        assert!(is_done, "there is an entry point {from}");
        kernel
    }

    /// With the names of two entry points exchanged.
    pub fn exchanged(&self, one: &str, other: &str) -> Self {
        self.renamed(one, "meanwhile")
            .renamed(other, one)
            .renamed("meanwhile", other)
    }

    /// With workgroups of half the width where they are so wide.
    pub fn narrowed(&self, width: u32) -> Self {
        self.with_each(|instruction| {
            if instruction[0] & 0xffff == OP_EXECUTION_MODE && instruction[2] == LOCAL_SIZE && instruction[3] == width {
                instruction[3] /= 2;
            }
        })
    }

    /// With a load from nowhere: SPIR-V in form, but not in sense.
    pub fn senseless(&self) -> Self {
        let bound = self.words[3];
        let mut is_done = false;
        self.with_each(|instruction| {
            if instruction[0] & 0xffff == OP_LOAD && !is_done {
                instruction[3] = bound + 1;
                is_done = true;
            }
        })
    }

    /// With something done to each instruction.
    fn with_each(&self, mut change: impl FnMut(&mut Vec<u32>)) -> Self {
        let (header, mut rest) = self.words.split_at(HEADER);
        let mut words = header.to_vec();
        while let Some(first) = rest.first() {
            let (instruction, after) = rest.split_at((first >> 16) as usize);
            let mut instruction = instruction.to_vec();
            change(&mut instruction);
            words.extend(instruction);
            rest = after;
        }
        CompiledKernel {
            words,
            manifest: self.manifest.clone(),
        }
    }
}

/// The text at the beginning of words.
fn name(words: &[u32]) -> String {
    let bytes = words.iter().flat_map(|word| word.to_le_bytes());
    bytes.take_while(|byte| *byte != 0).map(char::from).collect()
}
