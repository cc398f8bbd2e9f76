#pragma once
// Runs tasks on this machine, each in its own process.

#include <memory>
#include <turnscan/io/file/folder.hpp>
#include <turnscan/workflow/engine/engine.hpp>

namespace turnscan::engine {

/// Resource limits on this machine.
struct LocalLimits {
  int jobs = 1;                    ///< maximum number of concurrent jobs
  std::uint64_t memory_bytes = 0;  ///< for all jobs together; a single job may exceed it
};

/// Memory available now (of this control group, if it is limited), minus a tenth.
std::uint64_t usable_memory_bytes();

/// Starts jobs in order as long as they fit; their output goes to the engine's folder. Jobs end
/// with the thread that created the engine.
std::unique_ptr<Engine> make_local_engine(const JobCommand& command, const LocalLimits& limits,
                                          file::Folder folder);

}  // namespace turnscan::engine
