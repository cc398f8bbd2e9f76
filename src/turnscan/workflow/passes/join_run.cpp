#include <turnscan/workflow/passes/join_run.hpp>

#include <algorithm>
#include <turnscan/core/angles.hpp>

namespace turnscan {

namespace {

Result<Reconstruction> fuse(const std::vector<PassOfMany>& passes,
                            const std::vector<PassPlace>& places, const ReconstructOptions& options,
                            const StageSink& sink, const RunContext& context) {
  std::vector<SequencePass> parts;
  std::vector<PassPlacement> placements;
  for (std::size_t k = 0; k < passes.size(); ++k) {
    if (!places[k].placement) continue;
    parts.push_back(passes[k].frames);
    placements.push_back(*places[k].placement);
  }
  TURNSCAN_ASSIGN(const JoinedFrames frames, JoinedFrames::create(parts));
  return reconstruct(frames, options, sink, context, std::move(placements));
}

Result<PassApart> reconstruct_apart(const PassOfMany& pass, const std::string& reason,
                                    const ReconstructOptions& options, const RunContext& context) {
  PassApart out{pass.number, pass.name, reason, {}};
  TURNSCAN_ASSIGN(const JoinedFrames frames, JoinedFrames::create({pass.frames}));
  auto made = reconstruct(frames, options, {}, context);
  if (made) {
    out.reconstruction = std::move(*made);
  } else if (made.error().code == ErrorCode::kCancelled) {
    return tl::unexpected<Error>(std::move(made).error());
  }
  return out;
}

void note_motions(Reconstruction& r) {
  for (const FusedPass& pass : r.passes) {
    if (!pass.found) continue;
    r.notes.push_back(fmt::format(
        "{} was joined by its surface: its motion is known to {:.3f} mm and {:.3f} deg, {:.0f} cm2 "
        "overlap",
        pass.name, pass.found->sigma_m * 1e3, pass.found->sigma_rad * kDegreesPerRadian,
        pass.found->overlap_m2 * 1e4));
  }
}

}  // namespace

Result<JoinedRun> join_and_reconstruct(const std::vector<PassOfMany>& passes,
                                       const ReconstructOptions& options, const StageSink& sink,
                                       const RunContext& context) {
  TURNSCAN_ASSIGN(const std::vector<PassPlace> places, place_passes(passes, options, context));
  const auto joined = std::count_if(places.begin(), places.end(), [](const PassPlace& place) {
    return place.placement.has_value();
  });
  JoinedRun out;
  if (joined > 1) {
    TURNSCAN_ASSIGN(out.reconstruction, fuse(passes, places, options, sink, context));
    note_motions(out.reconstruction);
    for (const PassPlace& place : places)
      if (!place.doubt.empty()) out.reconstruction.notes.push_back(place.doubt);
  }
  for (std::size_t k = 0; k < passes.size(); ++k) {
    if (places[k].placement && joined > 1) continue;
    TURNSCAN_ASSIGN(auto apart, reconstruct_apart(passes[k], places[k].reason, options, context));
    if (!apart.reason.empty())
      out.reconstruction.notes.push_back(
          fmt::format("{} was not joined: {}", apart.name, apart.reason));
    out.apart.push_back(std::move(apart));
  }
  return out;
}

}  // namespace turnscan
