#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/reconstruction/stream.hpp>

namespace turnscan {

namespace {

/// Frames that are read and worked on together: enough to keep the cores busy, few enough to keep
/// memory flat.
constexpr std::size_t kBatch = 64;

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

const std::vector<std::string>& saveable_stages() {
  static const std::vector<std::string> stages{"merged",  "voxels",   "candidates",
                                               "refined", "oriented", "fitted"};
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
