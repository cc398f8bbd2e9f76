#pragma once
// Passes of one or more recordings in one mesh, and those that do not fit beside it.

#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/workflow/passes/pass_places.hpp>

namespace turnscan {

/// A pass that was joined with no other, or the objects on its table that were not, and their own
/// meshes.
struct PassApart {
  std::uint32_t number = 0;
  std::string name;
  std::string reason;  ///< why not; empty for the first, where no other was joined with it
  Reconstruction reconstruction;
};

struct JoinedRun {
  Reconstruction reconstruction;  ///< no object when not even two passes were joined
  std::vector<PassApart> apart;
};

/// Places the objects of the passes, at least two, and fuses each over all passes that show it;
/// what has no partner is reconstructed by itself, in its own table's frame. The sink gets the
/// stages of the fused ones. Fails as place_passes() and reconstruct() do. A pass apart of which no
/// mesh can be made has none.
Result<JoinedRun> join_and_reconstruct(const std::vector<PassOfMany>& passes,
                                       const ReconstructOptions& options, const StageSink& sink,
                                       const RunContext& context);

}  // namespace turnscan
