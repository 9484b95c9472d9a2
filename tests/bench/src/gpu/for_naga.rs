//! Modules as naga understands them.

use rspirv::binary::Assemble;
use rspirv::dr::{Instruction, Operand, load_words};
use rspirv::spirv::{Decoration, Op};
use std::collections::HashSet;

/// A module whose buffers that are only read say so: glslang says it of what is in them, naga expects it of the variable, and
/// wgpu compares that with the layout.
///
/// # Errors
/// Where this is no SPIR-V.
pub fn for_naga(words: &[u32]) -> Result<Vec<u32>, String> {
    let mut module = load_words(words).map_err(|error| error.to_string())?;
    let is_read_only = |decoration: &Instruction| {
        decoration.class.opcode == Op::MemberDecorate
            && decoration
                .operands
                .contains(&Operand::Decoration(Decoration::NonWritable))
    };
    let first = |decoration: &Instruction| match decoration.operands.first() {
        Some(Operand::IdRef(id)) => Some(*id),
        _ => None,
    };
    let blocks: HashSet<u32> = module
        .annotations
        .iter()
        .filter(|decoration| is_read_only(decoration))
        .filter_map(first)
        .collect();
    let is_pointer = |of: &Instruction| match of.operands.as_slice() {
        [_, Operand::IdRef(pointee)] => of.class.opcode == Op::TypePointer && blocks.contains(pointee),
        _ => false,
    };
    let pointers: HashSet<u32> = module
        .types_global_values
        .iter()
        .filter(|of| is_pointer(of))
        .filter_map(|of| of.result_id)
        .collect();
    let variables = module.types_global_values.iter().filter(|of| {
        of.class.opcode == Op::Variable && of.result_type.is_some_and(|pointer| pointers.contains(&pointer))
    });
    let said = variables.filter_map(|variable| variable.result_id).map(|id| {
        let operands = vec![Operand::IdRef(id), Operand::Decoration(Decoration::NonWritable)];
        Instruction::new(Op::Decorate, None, None, operands)
    });
    module.annotations.extend(said);
    Ok(module.assemble())
}
