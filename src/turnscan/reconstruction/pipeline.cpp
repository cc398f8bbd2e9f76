#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/reconstruction/stream.hpp>
#include <turnscan/reconstruction/texture/texture_objects.hpp>

namespace turnscan {

Result<Reconstruction> reconstruct(const FrameSequence& sequence, const ReconstructOptions& options,
                                   const StageSink& sink, const RunContext& context,
                                   std::vector<PassPlacement> passes) {
  TURNSCAN_ASSIGN(auto stream, ReconstructionStream::create(sequence.header(), options, passes));
  TURNSCAN_TRY(context.check());
  if (options.texture.texture) TURNSCAN_TRY(texture::check_colors(sequence));
  TURNSCAN_TRY(stream.add(sequence, 0, context));
  TURNSCAN_ASSIGN(Reconstruction out, stream.finish(sink, context));
  if (options.texture.texture)
    TURNSCAN_TRY(texture::texture_objects(sequence, options, passes, out, context));
  return out;
}

}  // namespace turnscan
