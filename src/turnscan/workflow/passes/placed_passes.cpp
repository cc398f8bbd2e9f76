#include <turnscan/workflow/passes/placed_passes.hpp>

#include <algorithm>

namespace turnscan {

namespace {

Result<> check_stated(const std::vector<std::uint32_t>& passes,
                      const std::vector<PassPose>& stated) {
  std::vector<std::uint32_t> seen;
  for (const PassPose& pose : stated) {
    if (std::find(passes.begin(), passes.end(), pose.pass) == passes.end())
      return fail(ErrorCode::kInvalidOption, "--pass-pose {}: the recording has no such pass",
                  pose.pass);
    if (std::find(seen.begin(), seen.end(), pose.pass) != seen.end())
      return fail(ErrorCode::kInvalidOption, "--pass-pose {} is given twice", pose.pass);
    seen.push_back(pose.pass);
  }
  return {};
}

/// The first pass lies as it does, unless somebody says otherwise.
Result<Pose> pose_of(std::uint32_t pass, bool first, const std::vector<PassPose>& stated) {
  const auto found =
      std::find_if(stated.begin(), stated.end(), [&](const PassPose& p) { return p.pass == pass; });
  if (found != stated.end()) return found->T_first_table;
  if (first) return Pose::Identity();
  return fail(ErrorCode::kInvalidOption,
              "--pass-pose is not given for pass {}; give it for each pass but the first", pass);
}

}  // namespace

Result<PlacedPasses> place_passes(const FrameSequence& sequence,
                                  const std::vector<PassPose>& stated,
                                  const ReconstructOptions& options) {
  if (options.merge.pass)
    return fail(ErrorCode::kInvalidOption,
                "--pass takes one pass, --pass-pose fuses all; give one of them");
  const std::vector<std::uint32_t> passes = passes_of(sequence);
  TURNSCAN_TRY(check_stated(passes, stated));
  PlacedPasses out;
  std::vector<SequencePass> parts;
  for (const std::uint32_t pass : passes) {
    PassPlacement placement;
    TURNSCAN_ASSIGN(placement.T_object_table, pose_of(pass, parts.empty(), stated));
    placement.turntable = sequence.header().turntable;
    placement.name = fmt::format("pass {}", pass);
    out.placements.push_back(std::move(placement));
    parts.push_back({&sequence, pass});
  }
  TURNSCAN_ASSIGN(out.frames, JoinedFrames::create(parts, options.merge.speed_rad_s));
  return out;
}

}  // namespace turnscan
