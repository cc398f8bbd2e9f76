#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/reconstruction/stream.hpp>
#include <turnscan/reconstruction/unused_options.hpp>

namespace turnscan {

namespace {

/// Frames that are read and worked on together: enough to keep the cores busy, few enough to keep
/// memory flat.
constexpr std::size_t kBatch = 64;

/// Whether the method looks at an option of a stage.
bool used(SurfaceMethod method, const std::string& stage, const std::string& option) {
  const bool of_points = stage == "outliers" || stage == "candidates" || stage == "normals" ||
                         stage == "refine" || stage == "base" || option == "cloud-outliers" ||
                         option == "voxel-min-points" || option == "object-gap" ||
                         option == "repair";
  if (of_points) return method != SurfaceMethod::kVolumetric;
  if (stage == "volumetric") return method == SurfaceMethod::kVolumetric;
  if (option == "alpha") return method == SurfaceMethod::kConcaveHull;
  if (option.rfind("poisson-", 0) == 0) return method == SurfaceMethod::kPoisson;
  return true;
}

}  // namespace

std::vector<StageOptions> describe_stages(ReconstructOptions& o) {
  OptionTable merge = describe(o.merge);
  merge.flag("colour", o.color, "Carry colour to the vertices when the recording has any");
  return {{"crop", describe(o.crop)},
          {"outliers", describe(o.outliers)},
          {"merge", std::move(merge)},
          {"voxels", describe(o.voxels)},
          {"candidates", describe(o.candidates)},
          {"components", describe(o.components)},
          {"normals", describe(o.normals)},
          {"refine", describe(o.refine)},
          {"base", describe(o.base)},
          {"surface", describe(o.surface)},
          {"volumetric", describe(o.volumetric)}};
}

OptionTable describe(ReconstructOptions& options) {
  OptionTable table;
  for (StageOptions& stage : describe_stages(options)) table.append(std::move(stage.table));
  return table;
}

std::vector<std::string> unused_options(const ReconstructOptions& options) {
  ReconstructOptions given = options, standard;
  const auto stages = describe_stages(given), defaults = describe_stages(standard);
  std::vector<std::string> names;
  for (std::size_t s = 0; s < stages.size(); ++s) {
    for (std::size_t f = 0; f < stages[s].table.fields().size(); ++f) {
      const OptionField& field = stages[s].table.fields()[f];
      if (!used(options.surface.method, stages[s].stage, field.name) &&
          field.get() != defaults[s].table.fields()[f].get())
        names.push_back(field.name);
    }
  }
  return names;
}

const std::vector<std::string>& saveable_stages() {
  static const std::vector<std::string> stages{"merged",  "voxels",   "candidates",
                                               "refined", "oriented", "fitted"};
  return stages;
}

std::vector<std::string> saveable_stages(SurfaceMethod method) {
  std::vector<std::string> stages;
  for (const std::string& stage : saveable_stages()) {
    if ((stage == "fitted") == (method == SurfaceMethod::kVolumetric)) stages.push_back(stage);
  }
  return stages;
}

Result<Reconstruction> reconstruct(const FrameSequence& sequence, const ReconstructOptions& options,
                                   const StageSink& sink, const RunContext& context) {
  TURNSCAN_ASSIGN(auto stream, ReconstructionStream::create(sequence.header(), options));
  TURNSCAN_TRY(context.check());
  const auto& frames = sequence.frames();
  context.begin_phase("read frames", frames.size());
  for (std::size_t begin = 0; begin < frames.size(); begin += kBatch) {
    const std::size_t end = std::min(begin + kBatch, frames.size());
    const std::vector<FrameInfo> infos(frames.begin() + std::ptrdiff_t(begin),
                                       frames.begin() + std::ptrdiff_t(end));
    TURNSCAN_TRY(stream.add(
        infos, [&](std::size_t i) { return sequence.read(begin + i); }, context));
  }
  return stream.finish(sink, context);
}

}  // namespace turnscan
