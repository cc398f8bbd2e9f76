#include "explorer/reconstruct_until.hpp"

#include <optional>

namespace turnscan::studio {

Result<std::variant<PointCloud, Reconstruction>> reconstruct_until(
    const std::string& stage, const FrameSequence& frames, const ReconstructOptions& options,
    const RunContext& context) {
  std::optional<PointCloud> reached;
  // The pipeline only stops early on an error of its sink. This error is not passed on: `reached`
  // marks it as intended.
  const StageSink stop_at = [&](const std::string& name, const PointCloud& cloud) -> Result<> {
    if (name != stage) return {};
    reached = cloud;
    return fail(ErrorCode::kCancelled, "stopped after the stage {}", stage);
  };
  auto result = reconstruct(frames, options, stop_at, context);
  if (reached) return *std::move(reached);
  if (!result) return tl::unexpected<Error>(std::move(result).error());
  return *std::move(result);
}

}  // namespace turnscan::studio
