#pragma once
// Fuses passes of one or more recordings into one mesh; passes that do not fit get meshes of their
// own.

#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/workflow/passes/pass_places.hpp>

namespace turnscan {

/// A pass that was not joined with any other, or the unjoined objects on its table, with their own
/// meshes.
struct PassApart {
  std::uint32_t number = 0;
  std::string name;
  /// Why it was not joined; empty for the first pass if no other was joined with it.
  std::string reason;
  Reconstruction reconstruction;
};

struct JoinedRun {
  Reconstruction reconstruction;  ///< without objects if no two passes were joined
  std::vector<PassApart> apart;
};

/// Registers the objects of the passes, at least two, and fuses each over all passes that show it;
/// objects without a partner are reconstructed separately, in the frame of their own table. The
/// sink gets the stages of the fused ones. Fails as place_passes() and reconstruct() do. If no mesh
/// of a separate pass can be made, it has none.
Result<JoinedRun> join_and_reconstruct(const std::vector<PassOfMany>& passes,
                                       const ReconstructOptions& options, const StageSink& sink,
                                       const RunContext& context);

}  // namespace turnscan
