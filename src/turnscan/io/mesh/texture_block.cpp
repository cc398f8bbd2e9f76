#include <charconv>
#include <cstring>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/mesh/texture_block.hpp>

namespace turnscan::mesh_io {

namespace {

constexpr std::string_view kTextureWord = "texture ";
using TextureCorners = std::array<Eigen::Vector2f, 3>;
static_assert(sizeof(TextureCorners) == 24 && sizeof(Rgb) == 3);

std::span<const std::byte> bytes_of(const void* data, std::size_t size) {
  return {static_cast<const std::byte*>(data), size};
}

/// Parses a positive number up to 65535 and the character after it; 0 if there is none.
int take_number(std::string_view& text, char end) {
  int value = 0;
  const auto [at, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || at == text.data() + text.size() || *at != end) return 0;
  text.remove_prefix(std::size_t(at - text.data()) + 1);
  return value >= 1 && value <= 65535 ? value : 0;
}

}  // namespace

Result<> write_texture_block(FileSink& sink, const TriangleMesh& mesh) {
  if (!has_texture(mesh)) return {};
  const MeshTexture& texture = *mesh.texture;
  TURNSCAN_TRY(sink.write(
      fmt::format("{}{} {}\n", kTextureWord, texture.image.width, texture.image.height)));
  TURNSCAN_TRY(sink.write(
      bytes_of(texture.corners.data(), texture.corners.size() * sizeof(TextureCorners))));
  return sink.write(
      bytes_of(texture.image.pixels.data(), texture.image.pixels.size() * sizeof(Rgb)));
}

Result<> take_texture_block(std::string_view& bytes, TriangleMesh& mesh) {
  if (!bytes.starts_with(kTextureWord)) return {};
  bytes.remove_prefix(kTextureWord.size());
  const int width = take_number(bytes, ' '), height = take_number(bytes, '\n');
  const std::uint64_t pixels = std::uint64_t(width) * std::uint64_t(height);
  const std::uint64_t corner_bytes = mesh.triangles.size() * sizeof(TextureCorners);
  if (pixels == 0 || pixels > kMaxImagePixels || bytes.size() < corner_bytes + pixels * sizeof(Rgb))
    return fail(ErrorCode::kFormat, "a mesh's texture is incomplete");
  auto texture = std::make_shared<MeshTexture>();
  texture->corners.resize(mesh.triangles.size());
  std::memcpy(static_cast<void*>(texture->corners.data()), bytes.data(), corner_bytes);
  bytes.remove_prefix(corner_bytes);
  texture->image = ColorImage(width, height);
  std::memcpy(static_cast<void*>(texture->image.pixels.data()), bytes.data(), pixels * sizeof(Rgb));
  bytes.remove_prefix(pixels * sizeof(Rgb));
  for (const TextureCorners& corners : texture->corners)
    for (const Eigen::Vector2f& corner : corners)
      if (!corner.allFinite())
        return fail(ErrorCode::kFormat, "a place in a mesh's texture is not finite");
  mesh.texture = std::move(texture);
  return {};
}

}  // namespace turnscan::mesh_io
