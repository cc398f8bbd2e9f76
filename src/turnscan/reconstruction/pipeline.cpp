#include <algorithm>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/reconstruction/stream.hpp>
#include <turnscan/reconstruction/texture/texture_objects.hpp>

namespace turnscan {

namespace {

/// Number of frames that are read and processed together: enough to keep the cores busy, few enough
/// to keep memory bounded.
constexpr std::size_t kFramesAtOnce = 64;

}  // namespace

Result<Reconstruction> reconstruct(const FrameSequence& sequence, const ReconstructOptions& options,
                                   const StageSink& sink, const RunContext& context,
                                   std::vector<PassPlacement> passes) {
  TURNSCAN_ASSIGN(auto stream, ReconstructionStream::create(sequence.header(), options, passes));
  TURNSCAN_TRY(context.check());
  if (options.texture.texture) TURNSCAN_TRY(texture::check_colors(sequence));
  const auto& frames = sequence.frames();
  context.begin_phase("read frames", frames.size());
  for (std::size_t begin = 0; begin < frames.size(); begin += kFramesAtOnce) {
    const std::size_t end = std::min(begin + kFramesAtOnce, frames.size());
    const std::vector<FrameInfo> infos(frames.begin() + std::ptrdiff_t(begin),
                                       frames.begin() + std::ptrdiff_t(end));
    TURNSCAN_TRY(stream.add(
        infos, [&](std::size_t i) { return sequence.read(begin + i); }, context));
  }
  TURNSCAN_ASSIGN(Reconstruction out, stream.finish(sink, context));
  if (options.texture.texture)
    TURNSCAN_TRY(texture::texture_objects(sequence, options, passes, out, context));
  return out;
}

}  // namespace turnscan
