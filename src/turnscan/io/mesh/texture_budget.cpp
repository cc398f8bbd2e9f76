#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/mesh/texture_budget.hpp>

namespace turnscan::mesh_io {

namespace {

constexpr std::uint64_t kMaxTries = 1000;  // small ones cost time, too

}  // namespace

Result<ColorImage> TextureBudget::decode(std::string_view bytes) {
  if (pixels_ >= kMaxImagePixels || ++tries_ > kMaxTries)
    return fail(ErrorCode::kResourceLimit, "the file asks for too many pictures");
  TURNSCAN_ASSIGN(ColorImage image, decode_color(bytes));
  pixels_ += image.pixels.size();
  if (pixels_ > kMaxImagePixels)
    return fail(ErrorCode::kResourceLimit, "the file asks for too many pictures");
  return image;
}

}  // namespace turnscan::mesh_io
