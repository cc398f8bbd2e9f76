#pragma once
// Textures the meshes of a reconstruction from the colour images of its frames.

#include <turnscan/reconstruction/options.hpp>
#include <turnscan/reconstruction/pass_placement.hpp>
#include <turnscan/reconstruction/result.hpp>

namespace turnscan::texture {

struct ColorView;

/// Checks that frames of a depth camera have a colour image by reading the first that is not
/// dropped. Fails with kMissingData if there is none, and as FrameSequence::read().
Result<> check_colors(const FrameSequence& sequence);

/// Textures a mesh. views: of all frames that saw it (color_views()). Fails with kResourceLimit,
/// kFormat, kCancelled and the errors of the sequence. The result does not depend on the number of
/// threads.
Result<TextureReport> texture_mesh(const FrameSequence& sequence, std::vector<ColorView> views,
                                   const TextureOptions& options, TriangleMesh& mesh,
                                   const RunContext& context);

/// The same for all objects. sequence, options and passes: those of the reconstruction. Reads the
/// frames a second time, a few at once.
Result<> texture_objects(const FrameSequence& sequence, const ReconstructOptions& options,
                         const std::vector<PassPlacement>& passes, Reconstruction& reconstruction,
                         const RunContext& context);

}  // namespace turnscan::texture
