#pragma once
// Tasks on this machine, each in a process of its own.

#include <memory>
#include <turnscan/workflow/engine/engine.hpp>

namespace turnscan::engine {

/// What may be used of a machine.
struct LocalLimits {
  int jobs = 1;                    ///< at once, at most
  std::uint64_t memory_bytes = 0;  ///< for all jobs together; one alone may have more
};

/// Memory that can be had now (of this control group, where it is limited), less a tenth.
std::uint64_t usable_memory_bytes();

/// Starts jobs in their order while they fit; the engine's folder gets their output. Jobs end with
/// the thread that made the engine.
std::unique_ptr<Engine> make_local_engine(const JobCommand& command, const LocalLimits& limits,
                                          const std::filesystem::path& folder);

}  // namespace turnscan::engine
