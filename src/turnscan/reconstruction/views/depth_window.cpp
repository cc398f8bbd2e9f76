#include <algorithm>
#include <cmath>
#include <span>
#include <turnscan/reconstruction/views/depth_window.hpp>

namespace turnscan::views {

namespace {

constexpr std::uint16_t kFar = 65534;  // stands for "empty in the relevant range"

constexpr std::array<std::array<int, 2>, 4> kSides{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};

/// Whether a neighbour is so much farther that the pixel may be a mixture of both.
bool beside_edge(const RawWindow& raw, int x, int y, int step) {
  const int own = raw.at(x, y);
  return std::any_of(kSides.begin(), kSides.end(), [&](const auto& side) {
    const int u = x + side[0], v = y + side[1];
    if (u < 0 || v < 0 || u >= raw.width || v >= raw.height) return true;
    const std::uint16_t other = raw.at(u, v);
    return !measured(other) || int(other) > own + step;
  });
}

/// In gaps of up to this many pixels between two rims the background is mixed everywhere.
constexpr int kNarrowGap = 2;

/// Whether the pixel is a flying pixel behind a rim, between the surface on one side and the
/// background on another: a mixture of both, and a measurement of neither. So is one between two
/// rims, in a narrow gap. A steep slope is not: there the step to the nearer side is as high as the
/// one before it.
bool flying(const RawWindow& raw, int x, int y, int step) {
  const int own = raw.at(x, y);
  const auto depth = [&](int u, int v) {
    const bool within = u >= 0 && v >= 0 && u < raw.width && v < raw.height;
    return within && measured(raw.at(u, v)) ? int(raw.at(u, v)) : int(kFar);
  };
  // Whether a rim is `pixels` away, with nothing nearer in between.
  const auto rim = [&](int dx, int dy, int pixels) {
    const int near = depth(x + pixels * dx, y + pixels * dy), climb = own - near;
    return climb > step && 2 * (near - depth(x + (pixels + 1) * dx, y + (pixels + 1) * dy)) < climb;
  };
  bool before = false;
  std::array<int, 4> distance{};  // to the rim on each side; 0: none close enough
  for (std::size_t side = 0; side < kSides.size(); ++side) {
    const auto [dx, dy] = kSides[side];
    before |= depth(x + dx, y + dy) - own > step;
    for (int pixels = kNarrowGap; pixels > 0; --pixels)
      if (rim(dx, dy, pixels)) distance[side] = pixels;
  }
  const auto gap = [&](int one, int other) {
    return one > 0 && other > 0 && one + other - 1 <= kNarrowGap;
  };
  const bool beside_rim = std::count(distance.begin(), distance.end(), 1) > 0;
  return (before && beside_rim) || gap(distance[0], distance[1]) || gap(distance[2], distance[3]);
}

/// A pixel this close to another may look past what that one sees: half a pixel at the edge, and
/// one pixel by which the sensor's filter spreads it.
constexpr int kMayLookPast = 2;
static_assert(kMayLookPast >= kNarrowGap, "pack_window tells from free depths that no rim is near");

/// to[i] = min(to[i], from[i]).
void take_least(std::span<std::uint16_t> to, const std::uint16_t* from) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = std::min(to[i], from[i]);
}

/// Per pixel the minimum depth around it, up to which it observed free space.
Image<std::uint16_t> free_depths(const RawWindow& raw) {
  const int w = raw.width, h = raw.height;
  constexpr int kReach = kMayLookPast;
  const auto width = std::size_t(w);
  Image<std::uint16_t> rows(w, h), out(w, h);
  std::vector<std::uint16_t> padded(width + 2 * kReach, kFar);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x)
      padded[std::size_t(x + kReach)] = measured(raw.at(x, y)) ? raw.at(x, y) : kFar;
    const std::span row(&rows.at(0, y), width);
    std::copy_n(padded.begin(), width, row.begin());
    for (int k = 1; k <= 2 * kReach; ++k) take_least(row, padded.data() + k);
  }
  for (int y = 0; y < h; ++y) {
    const std::span row(&out.at(0, y), width);
    std::copy_n(&rows.at(0, y), width, row.begin());
    for (int v = std::max(0, y - kReach); v <= std::min(h - 1, y + kReach); ++v)
      take_least(row, &rows.at(0, v));
    for (int x = 0; x < w; ++x)
      if (raw.at(x, y) == kNoReturn) out.at(x, y) = 0;
  }
  return out;
}

}  // namespace

void pack_window(const RawWindow& raw, double edge_step_m, DepthView& view) {
  const int step = int(std::lround(edge_step_m / double(view.unit_m)));
  view.width = raw.width + 2;
  view.height = raw.height + 2;
  const Image<std::uint16_t> free = free_depths(raw);
  view.pixels.assign(std::size_t(view.width) * std::size_t(view.height), 0);
  std::uint16_t nearest = kFar;
  for (int y = 0; y < raw.height; ++y) {
    for (int x = 0; x < raw.width; ++x) {
      const std::uint16_t own = raw.at(x, y);
      // A flying pixel behind a rim has a much nearer surface beside it.
      const bool behind = int(own) - int(free.at(x, y)) > step;
      const bool on_surface = measured(own) && !(behind && flying(raw, x, y, step));
      const std::uint32_t depth = on_surface ? own : 0u;
      if (depth != 0) nearest = std::min(nearest, own);
      view.pixels[std::size_t(y + 1) * std::size_t(view.width) + std::size_t(x + 1)] =
          DepthView::pack(depth, depth != 0 && beside_edge(raw, x, y, step), free.at(x, y));
    }
  }
  view.nearest = nearest;
}

void set_pose(DepthView& view, const Pose& T_table_view) {
  const Pose inverse = T_table_view.inverse();
  view.rotation = inverse.linear().cast<float>();
  view.translation = inverse.translation().cast<float>();
}

}  // namespace turnscan::views
