#pragma once

#include <optional>
#include <turnscan/core/option_table.hpp>

namespace turnscan {

/// A picture on the finished meshes, from the colour images of the frames.
struct TextureOptions {
  bool texture = false;
  /// Pixels a side of the picture; nullopt: as many as show what the cameras resolved, at most
  /// 4096.
  std::optional<int> size_px;
  bool refine_camera = true;  ///< find where the colour cameras really are
  bool albedo = false;        ///< take out what a light that stands still does to a turning object
};
OptionTable describe(TextureOptions& options);

}  // namespace turnscan
