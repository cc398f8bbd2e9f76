#pragma once

#include <optional>
#include <turnscan/core/option_table.hpp>

namespace turnscan {

/// Texturing of the finished meshes from the colour images of the frames.
struct TextureOptions {
  bool texture = false;
  /// Side of the texture image in pixels; nullopt: as many as the resolution of the cameras
  /// warrants, at most 4096.
  std::optional<int> size_px;
  bool refine_camera = true;  ///< estimate the true poses of the colour cameras
  bool albedo = false;        ///< remove the shading of a static light on a turning object
};
OptionTable describe(TextureOptions& options);

}  // namespace turnscan
