#pragma once
// The stages strung together: frames in, one closed mesh per object out.

#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/options.hpp>
#include <turnscan/reconstruction/pass_placement.hpp>
#include <turnscan/reconstruction/result.hpp>

namespace turnscan {

/// Runs the stages. sink may be empty. Fails with kTooFewPoints when nothing survives (and says at
/// which stage), kMissingData, kInvalidOption, kCancelled, and what the sequence fails with.
/// With surface.repair every mesh is watertight, or the error says which is not and why not.
/// passes: see ReconstructionStream::create().
Result<Reconstruction> reconstruct(const FrameSequence& sequence, const ReconstructOptions& options,
                                   const StageSink& sink, const RunContext& context,
                                   std::vector<PassPlacement> passes = {});

}  // namespace turnscan
