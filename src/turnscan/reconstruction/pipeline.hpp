#pragma once
// The whole pipeline: frames in, one closed mesh per object out.

#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/options.hpp>
#include <turnscan/reconstruction/pass_placement.hpp>
#include <turnscan/reconstruction/result.hpp>

namespace turnscan {

/// Runs the stages. sink may be empty. Fails with kTooFewPoints if no points remain (the message
/// names the stage), with kMissingData, kInvalidOption and kCancelled, and with the errors of the
/// sequence. With surface.repair every mesh is watertight, or the error tells which is not and why.
/// passes: see ReconstructionStream::create().
Result<Reconstruction> reconstruct(const FrameSequence& sequence, const ReconstructOptions& options,
                                   const StageSink& sink, const RunContext& context,
                                   std::vector<PassPlacement> passes = {});

}  // namespace turnscan
