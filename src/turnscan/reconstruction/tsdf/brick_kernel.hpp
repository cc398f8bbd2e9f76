#pragma once
// The inner loops of integration into the TSDF: which bricks of samples a view observes, and their
// update. A kernel (core/simd/kernel_choice.hpp).

#include <cstddef>
#include <cstdint>
#include <turnscan/core/lens.hpp>
#include <turnscan/core/simd/kernel_choice.hpp>

namespace turnscan::tsdf {

/// A brick has 8^3 samples in 2^3 parts of 4^3; a group has 4^3 bricks. Within each the first
/// coordinate runs fastest.
inline constexpr std::size_t kParts = 8;
inline constexpr std::size_t kPartLanes = 16;  ///< size of a vector for the parts
inline constexpr std::size_t kPartSamples = 64;
inline constexpr std::size_t kGroupBricks = 64;

/// Sums over the views that were integrated.
struct PartSums {
  float distance[kPartSamples];  ///< weight times distance along the ray; positive in front
  float weight[kPartSamples];    ///< of the measurements within the truncation
  float free[kPartSamples];      ///< number of views that saw past the sample
};
struct BrickSums {
  PartSums part[kParts];
};

enum class Projection : std::uint8_t { kPinhole, kDistorted, kRational, kParallel };

/// Min/max-depth bounds of a view for the visibility of boxes of one size. Conservative: they
/// contain all pixels onto which a box may project.
struct BoundsLevel {
  float half_z;          ///< of a box along the view's z, including rounding
  float least_z;         ///< boxes whose centre is nearer are unobserved
  float nearest_z;       ///< boxes whose centre is nearer count as near a surface
  float half_u, half_v;  ///< maximum distance in pixels from the image of its centre to the image
                         ///< of a point of the box
  int window_width, window_height;  ///< pixels of a window that contains the image of a box
  int shift, width;  ///< bounds are for every 2^shift-th pixel and row, `width` of them per row
  /// Two words for the window of pixels that begins there: nearest and farthest measurement (65535
  /// and 0 if there is none), least and largest free depth, low half first.
  const std::uint32_t* bounds;
};

/// A view in the layout of the loops. For a pinhole, x and y are in pixels at z = 1, otherwise
/// metres.
struct BrickKernelView {
  const std::uint32_t* pixels;  ///< as DepthView::pixels
  int width, height;
  Projection projection;
  float rows[9], shift[3];  ///< p_view = rows * p_table + shift
  float fx, fy, cx, cy;
  BrownConrady<float> lens;
  float unit, bias;
  float focal_x, focal_y;       ///< divisors of x and y for metres
  float truncation;             ///< along the ray
  float truncation_z_fraction;  ///< lower bound of the truncation's share along z
  float inverse_fade, edge_weight;
  /// From a part's first sample to each; 8 times these are the offsets from a group's first brick
  /// to each.
  float x[kPartSamples], y[kPartSamples], z[kPartSamples];
  float part_x[kPartLanes], part_y[kPartLanes], part_z[kPartLanes];  ///< from a brick's first part
  float part_center[3], brick_center[3];                             ///< from the first sample
  BoundsLevel brick_bounds, part_bounds;
};

/// One bit for each of the 64 bricks of a group. A brick has at most one of the bits; one without
/// any is unobserved.
struct VisibilityMasks {
  std::uint64_t free;          ///< the view saw past the whole brick
  std::uint64_t near_surface;  ///< it may have measured a surface within the truncation
  std::uint64_t partly_free;   ///< it measured none, but may have seen past some of the samples
};
/// The same for the parts of a brick; free ones count as partly free.
struct PartVisibilityMasks {
  unsigned near_surface, partly_free;
};

struct BrickKernel {
  /// first: the position of the group's first sample, table frame.
  VisibilityMasks (*group_visibility)(const BrickKernelView& view, const float first[3]);
  /// first: the brick's first sample.
  PartVisibilityMasks (*part_visibility)(const BrickKernelView& view, const float first[3]);
  /// Integrates a view into the samples of these parts of a brick. Returns whether it measured a
  /// surface within the truncation distance of any.
  bool (*integrate)(const BrickKernelView& view, const float first[3], unsigned parts,
                    BrickSums& sums);
  /// Writes a level's bounds: windows end where the image ends. planes: room for 4 values per
  /// pixel.
  void (*compute_bounds)(const BrickKernelView& view, const BoundsLevel& level,
                         std::uint16_t* planes, std::uint32_t* bounds);
};
using BrickKernels = KernelChoice<BrickKernel>;

}  // namespace turnscan::tsdf
