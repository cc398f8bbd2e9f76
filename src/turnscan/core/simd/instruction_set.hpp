#pragma once
// Instruction sets for which kernels are built. Sources compiled for them include this: it must not
// define inline functions that the linker could merge with those of other sources.

namespace turnscan {

/// kAvx512 means AVX-512 F, DQ, BW and VL.
enum class InstructionSet { kPortable, kAvx2, kAvx512 };

/// Whether this machine can run code built for it; true for kPortable.
bool machine_has(InstructionSet set);

}  // namespace turnscan
