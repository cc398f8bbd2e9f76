#pragma once
// Limits the total size of images that one file may request: it can refer to the same one any
// number of times.

#include <string_view>
#include <turnscan/core/image.hpp>
#include <turnscan/core/result.hpp>

namespace turnscan::mesh_io {

class TextureBudget {
 public:
  /// Decodes an image. Fails as decode_color(), and with kResourceLimit if the images of the file
  /// together have more than kMaxImagePixels pixels.
  Result<ColorImage> decode(std::string_view bytes);

 private:
  std::uint64_t pixels_ = 0, tries_ = 0;
};

}  // namespace turnscan::mesh_io
