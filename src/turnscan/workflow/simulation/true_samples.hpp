#pragma once
// Every sample of a virtual scan, with what was there to see.

#include <filesystem>
#include <turnscan/core/run_context.hpp>
#include <turnscan/simulator/virtual_passes.hpp>

namespace turnscan {

/// Writes folder/NNNNNN.ply for each frame that was not dropped (the number is the frame's index):
/// a vertex for each sample whose ray hits something, whether it gave a return or not. The folder
/// is made. Fails with kCancelled, kIo, and as write_file_atomically().
Result<> write_true_samples(const std::filesystem::path& folder, const VirtualPasses& scan,
                            const RunContext& context);

}  // namespace turnscan
