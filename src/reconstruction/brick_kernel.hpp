#pragma once
// What a view says about bricks of samples: which of them it can say something about, and what. On
// plain arrays, built once per instruction set. Internal to the volumetric method.
// The sources that include this are compiled for other instruction sets: nothing here may bring
// in inline functions that the linker could merge with those of other sources.

#include <cstddef>
#include <cstdint>
#include <turnscan/core/instruction_set.hpp>

namespace turnscan::bricks {

/// A brick has 8^3 samples in 2^3 parts of 4^3; a group of bricks is 4^3 of them. Within each the
/// first coordinate runs fastest.
inline constexpr std::size_t kParts = 8;
inline constexpr std::size_t kPartLanes = 16;  ///< room for them in a vector
inline constexpr std::size_t kPartCells = 64;
inline constexpr std::size_t kGroup = 64;

struct PartSums {
  float distance[kPartCells];  ///< weight times distance along the ray; positive in front
  float weight[kPartCells];    ///< of the measurements within the truncation
  float clear[kPartCells];     ///< how many views saw past the sample
};
struct BrickSums {
  PartSums part[kParts];
};

enum class Lens : std::uint8_t { kPinhole, kDistorted, kParallel };

/// Of what size the boxes are that a view is asked about, and what its pixels hold.
struct Level {
  float half_z;          ///< of the box along the view's z, rounding included
  float least_z;         ///< boxes whose middle lies nearer are not looked at
  float nearest;         ///< and those nearer than this are taken for what may hold a surface
  float half_u, half_v;  ///< within this, in pixels, of its middle's image lies that of a box
  int size_u, size_v;    ///< windows of so many pixels hold it
  int shift, width;      ///< bounds are of every 2^shift-th pixel and row, `width` a row
  /// Two words for the window of pixels that begins there: nearest and farthest measurement
  /// (65535 and 0 where there is none), least and largest free depth, low half first.
  const std::uint32_t* bounds;
};

/// A view as the loops need it. Of a pinhole, x and y are in pixels at z = 1, otherwise metres.
struct View {
  const std::uint32_t* pixels;  ///< as DepthView::pixels
  int width, height;
  Lens lens;
  float rows[9], shift[3];  ///< p_view = rows * p_table + shift
  float fx, fy, cx, cy;
  float k1, k2, p1, p2, k3;
  float unit, bias;
  float focal_x, focal_y;  ///< by which x and y are to be divided for metres
  float truncation;        ///< along the ray
  float clear_share;       ///< of the truncation, what it is at least along z
  float inverse_fall, edge_weight;
  /// From a part's first sample to each; 8 times as much leads from a group's first brick to each.
  float x[kPartCells], y[kPartCells], z[kPartCells];
  float part_x[kPartLanes], part_y[kPartLanes], part_z[kPartLanes];  ///< from a brick's first part
  float middle_of_part[3], middle_of_brick[3];                       ///< from the first sample
  Level bricks, parts;
};

/// Of the 64 bricks of a group: those that the view saw past as a whole, those in which it may have
/// measured a surface, and those of whose samples it may have seen past some.
struct Sights {
  std::uint64_t clear, surface, partly;
};
/// The same of a brick's parts.
struct PartSights {
  unsigned surface, partly;
};

struct Kernel {
  /// first: the position of the group's first sample, table frame.
  Sights (*look_at_group)(const View& view, const float first[3]);
  /// first: the brick's first sample.
  PartSights (*look_at_parts)(const View& view, const float first[3]);
  /// Adds what a view says about the samples of these parts of a brick. Returns whether it measured
  /// a surface within the truncation of any.
  bool (*add)(const View& view, const float first[3], unsigned parts, BrickSums& sums);
  /// Writes a level's bounds: windows end where the image ends. planes: room for 4 values a pixel.
  void (*bound)(const View& view, const Level& level, std::uint16_t* planes, std::uint32_t* bounds);
};

/// nullptr when it was not built or this machine lacks it.
const Kernel* kernel_for(InstructionSet set);
/// The widest that this machine has, or the one set by use_instruction_set.
const Kernel& kernel();
/// For tests and benchmarks: all later calls use this one. Throws std::invalid_argument when
/// kernel_for has none.
void use_instruction_set(InstructionSet set);

}  // namespace turnscan::bricks
