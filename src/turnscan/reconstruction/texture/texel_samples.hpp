#pragma once
// Colours of the texels in the views that see them best.

#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/texture/color_view.hpp>
#include <turnscan/reconstruction/texture/texel_blocks.hpp>

namespace turnscan::texture {

/// Number of views per block, best first: the best of all, and some from more oblique directions.
inline constexpr std::size_t kSlots = 8;
inline constexpr std::uint16_t kNoView = 0xffff;

/// Views chosen per block and slot.
struct ChosenViews {
  std::vector<std::array<std::uint16_t, kSlots>> view;  ///< kNoView: no further one sees it
  /// Weight by resolution and incidence; falls to 0 for views that are barely chosen, so that the
  /// weights of neighbouring blocks are similar.
  std::vector<std::array<float, kSlots>> weight;
  double pixels_per_m = 0.0;  ///< of the best views, median
};

/// Determines which views show each block, by occlusion tests with the mesh, excluding rims. The
/// result does not depend on the number of threads. Fails with kCancelled.
Result<ChosenViews> choose_views(const TriangleMesh& mesh, const TexelBlocks& blocks,
                                 const std::vector<ColorView>& views, const RunContext& context);

/// A slot of a block that uses a view.
struct ViewSlot {
  std::uint32_t block;
  std::uint8_t slot;
};

/// Per view the slots that use it, in the order of the blocks.
std::vector<std::vector<ViewSlot>> slots_by_view(const ChosenViews& chosen, std::size_t views);

struct Sample {
  static constexpr std::uint8_t kWell = 1, kNearRim = 2;
  std::uint8_t r = 0, g = 0, b = 0;
  std::uint8_t valid : 4 = 0;
  std::uint8_t lit : 4 = 0;  ///< by a lamp whose shading is removed: Lit (lamp_view.hpp)
};

struct TexelSamples {
  std::vector<Sample> samples;   ///< per block, slot and texel
  std::vector<float> sharpness;  ///< per view, over the median; 0: it has no image
  const Sample* of(std::size_t block, std::size_t slot) const {
    return &samples[(block * kSlots + slot) * kBlockTexels];
  }
  Sample* of(std::size_t block, std::size_t slot) {
    return &samples[(block * kSlots + slot) * kBlockTexels];
  }
};

/// Reads the frame of each view once, on all cores, with only a few in memory at a time. Fails as
/// FrameSequence::read(), with kFormat if an image does not have its camera's size, with
/// kCancelled.
Result<TexelSamples> sample_views(const FrameSequence& sequence, const TriangleMesh& mesh,
                                  const TexelBlocks& blocks, const std::vector<ColorView>& views,
                                  const ChosenViews& chosen, const RunContext& context);

/// The image of a view's frame; empty if the frame has none. Fails as sample_views().
Result<ColorImage> image_of(const FrameSequence& sequence, const ColorView& view);

/// Bilinear; 0 to 255. u, v at least one pixel inside.
Vec3f pixel_at(const ColorImage& image, float u, float v);

}  // namespace turnscan::texture
