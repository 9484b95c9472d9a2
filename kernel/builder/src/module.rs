//! Reading a compiled module.

use rspirv::binary::Disassemble;
use rspirv::dr::{self, Operand};
use rspirv::spirv::ExecutionMode;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::Error;

/// A function of the module that the host can launch.
#[derive(Clone, Debug, Deserialize, Eq, Ord, PartialEq, PartialOrd, Serialize)]
#[serde(deny_unknown_fields)]
pub struct EntryPoint {
    /// What the host calls it by.
    pub name: String,
    /// SPIR-V's execution model, `GLCompute` for compute shaders.
    pub model: String,
    /// Invocations in a workgroup along x, y and z; only compute shaders have one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub workgroup: Option<[u32; 3]>,
}

/// The entry points of a SPIR-V module, sorted by name.
///
/// # Errors
/// [`Error::Module`] where `module` is not SPIR-V.
pub fn entry_points(module: &[u8]) -> Result<Vec<EntryPoint>, Error> {
    let module = parse(module)?;
    let mut found = Vec::new();
    for entry in &module.entry_points {
        let [
            Operand::ExecutionModel(model),
            Operand::IdRef(function),
            Operand::LiteralString(name),
            ..,
        ] = entry.operands.as_slice()
        else {
            return Err(Error::Module("an OpEntryPoint has the wrong operands".into()));
        };
        let workgroup = module
            .execution_modes
            .iter()
            .find_map(|mode| match mode.operands.as_slice() {
                [
                    Operand::IdRef(of),
                    Operand::ExecutionMode(ExecutionMode::LocalSize),
                    Operand::LiteralBit32(x),
                    Operand::LiteralBit32(y),
                    Operand::LiteralBit32(z),
                ] if of == function => Some([*x, *y, *z]),
                _ => None,
            });
        found.push(EntryPoint {
            name: name.clone(),
            model: format!("{model:?}"),
            workgroup,
        });
    }
    found.sort();
    Ok(found)
}

/// The module as SPIR-V assembly, one instruction a line.
///
/// # Errors
/// [`Error::Module`] where `module` is not SPIR-V.
pub fn disassemble(module: &[u8]) -> Result<String, Error> {
    Ok(parse(module)?.disassemble())
}

/// SHA-256 of `bytes` in lower-case hexadecimal digits.
pub fn sha256(bytes: &[u8]) -> String {
    hex(&Sha256::digest(bytes))
}

pub(crate) fn hex(digest: &[u8]) -> String {
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}

fn parse(module: &[u8]) -> Result<dr::Module, Error> {
    dr::load_bytes(module).map_err(|error| Error::Module(error.to_string()))
}
