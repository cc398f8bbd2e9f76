#include <turnscan/workflow/passes/join_run.hpp>

#include <algorithm>
#include <map>
#include <turnscan/core/angles.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/reconstruction/finishing/finishing.hpp>
#include <turnscan/workflow/passes/object_list.hpp>

namespace turnscan {

namespace {

Result<Reconstruction> fuse(const std::vector<PassOfMany>& passes, const ObjectPlaces& object,
                            const ReconstructOptions& options, const StageSink& sink,
                            const RunContext& context) {
  std::vector<SequencePass> parts;
  std::vector<PassPlacement> placements;
  for (std::size_t k = 0; k < passes.size(); ++k) {
    if (!object.of_pass[k]) continue;
    parts.push_back(passes[k].frames);
    placements.push_back(*object.of_pass[k]);
  }
  TURNSCAN_ASSIGN(const SequenceView frames, join_passes(parts));
  return reconstruct(frames, options, sink, context, std::move(placements));
}

Result<> keep_object(int number, Reconstruction& r, const RunContext& context) {
  FinishOptions choose;
  choose.object = number;
  TURNSCAN_TRY(finishing::finish_objects(choose, r, context));
  for (ObjectResult& object : r.objects) object.check = check_surface(object.mesh);
  std::erase_if(r.passes, [&](const FusedPass& pass) { return pass.object != number - 1; });
  for (FusedPass& pass : r.passes) pass.object = -1;
  return {};
}

/// One mesh per object; which one is largest is known only when all have been made.
Result<Reconstruction> fuse_all(const std::vector<PassOfMany>& passes,
                                const std::vector<ObjectPlaces>& objects,
                                const ReconstructOptions& options, const StageSink& sink,
                                const RunContext& context) {
  if (objects.size() == 1) return fuse(passes, objects[0], options, sink, context);
  ReconstructOptions one = options;
  one.finish.object.reset();
  std::map<std::string, PointCloud> clouds;
  std::vector<Reconstruction> made;
  for (const ObjectPlaces& object : objects) {
    const StageSink collect = [&](const std::string& stage, const PointCloud& cloud) -> Result<> {
      append_cloud(cloud, clouds[stage]);
      return {};
    };
    TURNSCAN_ASSIGN(Reconstruction r, fuse(passes, object, one, collect, context));
    made.push_back(std::move(r));
  }
  for (const auto& [stage, cloud] : clouds)
    if (sink) TURNSCAN_TRY(sink(stage, cloud));
  Reconstruction out = list_objects(std::move(made));
  if (options.finish.object) TURNSCAN_TRY(keep_object(*options.finish.object, out, context));
  return out;
}

/// Reconstructs a pass that was not joined, or the part of it that was not.
Result<PassApart> reconstruct_apart(const PassOfMany& pass, const std::string& reason,
                                    const std::optional<ObjectPartition>& left,
                                    const ReconstructOptions& options, const RunContext& context) {
  PassApart out{pass.number, pass.name, reason, {}};
  TURNSCAN_ASSIGN(const SequenceView frames, join_passes({pass.frames}));
  std::vector<PassPlacement> placements;
  if (left) {
    PassPlacement& placement = placements.emplace_back();
    placement.turntable = pass.frames.frames->header().turntable;
    placement.name = pass.name;
    placement.share = left;
  }
  auto made = reconstruct(frames, options, {}, context, std::move(placements));
  if (made) {
    out.reconstruction = std::move(*made);
    out.reconstruction.passes.clear();
  } else if (made.error().code == ErrorCode::kCancelled) {
    return tl::unexpected<Error>(std::move(made).error());
  }
  return out;
}

void note_motions(Reconstruction& r) {
  for (const FusedPass& pass : r.passes) {
    if (!pass.found) continue;
    r.notes.push_back(fmt::format(
        "{}{} was joined by its surface: its motion is known to {:.3f} mm and {:.3f} deg, {:.0f} "
        "cm2 overlap",
        pass.object < 0 ? "" : fmt::format("object {}: ", pass.object + 1), pass.name,
        pass.found->sigma_m * 1e3, pass.found->sigma_rad * kDegreesPerRadian,
        pass.found->overlap_m2 * 1e4));
  }
}

}  // namespace

Result<JoinedRun> join_and_reconstruct(const std::vector<PassOfMany>& passes,
                                       const ReconstructOptions& options, const StageSink& sink,
                                       const RunContext& context) {
  TURNSCAN_ASSIGN(const PassPlaces places, place_passes(passes, options, context));
  JoinedRun out;
  if (!places.objects.empty()) {
    TURNSCAN_ASSIGN(out.reconstruction, fuse_all(passes, places.objects, options, sink, context));
    note_motions(out.reconstruction);
    std::vector<std::string>& notes = out.reconstruction.notes;
    notes.insert(notes.end(), places.notes.begin(), places.notes.end());
  }
  for (std::size_t k = 0; k < passes.size(); ++k) {
    const bool joined =
        std::any_of(places.objects.begin(), places.objects.end(),
                    [&](const auto& object) { return object.of_pass[k].has_value(); });
    if (joined && places.reasons[k].empty()) continue;
    TURNSCAN_ASSIGN(auto apart, reconstruct_apart(passes[k], places.reasons[k], places.left[k],
                                                  options, context));
    if (!apart.reason.empty())
      out.reconstruction.notes.push_back(
          fmt::format("{} was not joined: {}", apart.name, apart.reason));
    out.apart.push_back(std::move(apart));
  }
  return out;
}

}  // namespace turnscan
