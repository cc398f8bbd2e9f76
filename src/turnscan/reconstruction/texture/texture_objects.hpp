#pragma once
// Textures for the meshes of a reconstruction, from the colour images of its frames.

#include <turnscan/reconstruction/options.hpp>
#include <turnscan/reconstruction/pass_placement.hpp>
#include <turnscan/reconstruction/result.hpp>

namespace turnscan::texture {

struct ColorView;

/// Whether a frame of a depth camera has a colour image: the first that is not dropped is read.
/// Fails with kMissingData when there is none, and as FrameSequence::read().
Result<> check_colors(const FrameSequence& sequence);

/// Gives a mesh a texture. views: of all frames that saw it (color_views()). Fails with
/// kResourceLimit, kFormat, kCancelled and what the sequence fails with. The same for any number of
/// threads.
Result<TextureReport> texture_mesh(const FrameSequence& sequence, std::vector<ColorView> views,
                                   const TextureOptions& options, TriangleMesh& mesh,
                                   const RunContext& context);

/// The same for all objects. sequence, options and passes: those of the reconstruction. Frames are
/// read a second time, a few at once.
Result<> texture_objects(const FrameSequence& sequence, const ReconstructOptions& options,
                         const std::vector<PassPlacement>& passes, Reconstruction& reconstruction,
                         const RunContext& context);

}  // namespace turnscan::texture
