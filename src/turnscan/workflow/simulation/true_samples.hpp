#pragma once
// Every sample of a virtual scan, with its ground truth.

#include <filesystem>
#include <turnscan/core/run_context.hpp>
#include <turnscan/simulator/virtual_passes.hpp>

namespace turnscan {

/// Writes folder/NNNNNN.ply for each frame that was not dropped (the number is the frame's index):
/// one vertex for each sample whose ray hits something, with or without a return. Creates the
/// folder. Fails with kCancelled, kIo, and as write_file_atomically().
Result<> write_true_samples(const std::filesystem::path& folder, const VirtualPasses& scan,
                            const RunContext& context);

}  // namespace turnscan
