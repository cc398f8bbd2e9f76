#pragma once
// Instruction sets that kernels are built for. Sources that are compiled for them include this:
// nothing here may bring in inline functions that the linker could merge with those of others.

namespace turnscan {

/// kAvx512 means AVX-512 F, DQ, BW and VL.
enum class InstructionSet { kPortable, kAvx2, kAvx512 };

/// Whether this machine runs code built for it; true for kPortable.
bool machine_has(InstructionSet set);

}  // namespace turnscan
