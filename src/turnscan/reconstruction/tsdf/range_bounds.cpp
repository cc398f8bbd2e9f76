#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <turnscan/reconstruction/tsdf/range_bounds.hpp>

namespace turnscan::tsdf {

namespace {

constexpr int kPartSide = 4;  // samples

/// Properties of a rational lens up to an undistorted or a distorted radius at z = 1.
struct RationalReach {
  double stretch = 1.0;  ///< upper bound of the distortion's derivative
  double shrink = 1.0;   ///< lower bound of the distorted radius by the undistorted one
  double radius = 0.0;   ///< the undistorted one
};

/// Computes the bounds up to the undistorted radius, or if `distorted` is given to that one.
/// Sampled: the factor is a fraction of polynomials of r^2 without poles up to the lens's largest
/// radius, and constant beyond.
RationalReach rational_reach(const BrownConrady<float>& lens, double radius,
                             std::optional<double> distorted = std::nullopt) {
  constexpr int kSamples = 256;
  constexpr double kSafety = 1.02;
  const double end = distorted ? std::sqrt(double(lens.largest_r2)) : radius;
  RationalReach out;
  double before = 0.0;
  for (int i = 1; i <= kSamples; ++i) {
    const double r = end * i / kSamples;
    float x = float(r), y = 0.0f;
    distort_rational(BrownConrady<float>{lens.k1, lens.k2, 0, 0, lens.k3, lens.k4, lens.k5, lens.k6,
                                         lens.largest_r2},
                     x, y);
    out.radius = r;
    out.shrink = std::min(out.shrink, double(x) / r);
    out.stretch = std::max({out.stretch, double(x) / r, (double(x) - before) * kSamples / end});
    before = double(x);
    if (distorted && before >= *distorted) break;
  }
  out.stretch = kSafety * out.stretch +
                6.0 * out.radius * (std::abs(double(lens.p1)) + std::abs(double(lens.p2)));
  out.shrink /= kSafety;
  return out;
}

/// Upper bound of the derivative of the lens's distortion, up to a radius at z = 1.
double largest_stretch(const views::DepthView& view, double radius) {
  if (!view.distorted) return 1.0;
  const auto& k = view.lens;
  if (k.rational()) return rational_reach(k, radius).stretch;
  const double r2 = radius * radius;
  return 1.0 +
         r2 * (3.0 * std::abs(double(k.k1)) +
               r2 * (5.0 * std::abs(double(k.k2)) + r2 * 7.0 * std::abs(double(k.k3)))) +
         6.0 * radius * (std::abs(double(k.p1)) + std::abs(double(k.p2)));
}

/// Largest |x / z| and |y / z| in the window, with a margin.
std::array<double, 2> largest_slope(const views::DepthView& view) {
  constexpr double kMargin = 32.0;  // pixels
  const auto reach = [](float middle, int size, float focal) {
    return (std::max(std::abs(double(middle)), std::abs(size - double(middle))) + kMargin) /
           double(focal);
  };
  const std::array<double, 2> out{reach(view.cx, view.width, view.fx),
                                  reach(view.cy, view.height, view.fy)};
  if (!view.distorted || !view.lens.rational()) return out;
  // With a wide lens the rays are much farther out than their image points.
  const double shrink = rational_reach(view.lens, 0.0, std::hypot(out[0], out[1])).shrink;
  return {out[0] / shrink, out[1] / shrink};
}

/// Half extent of the box around a cube of samples along a row of the view's rotation.
double half_extent(const views::DepthView& view, int row, int side, double cell_m) {
  return 0.5 * (side - 1) * cell_m * double(view.rotation.row(row).cwiseAbs().sum());
}

double radius_of(int side, double cell_m) { return 0.5 * std::sqrt(3.0) * side * cell_m; }

}  // namespace

void RangeBounds::set_projection(const views::DepthView& view) {
  BrickKernelView& f = view_;
  f.pixels = view.pixels.data();
  f.width = view.width, f.height = view.height;
  f.projection = view.parallel          ? Projection::kParallel
                 : !view.distorted      ? Projection::kPinhole
                 : view.lens.rational() ? Projection::kRational
                                        : Projection::kDistorted;
  const bool pinhole = f.projection == Projection::kPinhole;
  const float scale[3] = {pinhole ? view.fx : 1.0f, pinhole ? view.fy : 1.0f, 1.0f};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      f.rows[3 * row + column] = scale[row] * view.rotation(row, column);
    f.shift[row] = scale[row] * view.translation[row];
  }
  f.focal_x = 1.0f / scale[0], f.focal_y = 1.0f / scale[1];
  f.fx = view.fx, f.fy = view.fy, f.cx = view.cx, f.cy = view.cy;
  f.lens = view.lens;
  f.unit = view.unit_m, f.bias = view.bias_m;
}

void RangeBounds::set_steps(const views::DepthView& view, double cell_m) {
  BrickKernelView& f = view_;
  const auto step = [&](int row, double i, double j, double k) {
    const double scale = row == 0   ? 1.0 / double(f.focal_x)
                         : row == 1 ? 1.0 / double(f.focal_y)
                                    : 1.0;
    return float(cell_m * scale *
                 (i * double(view.rotation(row, 0)) + j * double(view.rotation(row, 1)) +
                  k * double(view.rotation(row, 2))));
  };
  float* const samples[3] = {f.x, f.y, f.z};
  float* const parts[3] = {f.part_x, f.part_y, f.part_z};
  for (int row = 0; row < 3; ++row) {
    for (int l = 0; l < int(kPartSamples); ++l)
      samples[row][l] = step(row, l & 3, l >> 2 & 3, l >> 4);
    for (int l = 0; l < int(kParts); ++l)
      parts[row][l] =
          step(row, kPartSide * (l & 1), kPartSide * (l >> 1 & 1), kPartSide * (l >> 2));
    const double part = 0.5 * (kPartSide - 1), brick = 0.5 * (kBrickSide - 1);
    f.part_center[row] = step(row, part, part, part);
    f.brick_center[row] = step(row, brick, brick, brick);
  }
}

/// side: samples along the boxes. Boxes nearer than nearest_m are not bounded, since their images
/// are too large.
void RangeBounds::set_level(const views::DepthView& view, int side, double cell_m, double nearest_m,
                            BoundsLevel& level) const {
  const double half_z = half_extent(view, 2, side, cell_m);
  const double rounding = 2e-6 * (65535.0 * double(view.unit_m) + std::abs(double(view.bias_m)));
  level.half_z = float(half_z + rounding);
  level.least_z = level.nearest_z = -1e30f;
  double half[2] = {half_extent(view, 0, side, cell_m), half_extent(view, 1, side, cell_m)};
  if (!view.parallel) {
    const double nearest = std::max(nearest_m, 4.0 * radius_of(side, cell_m));
    level.nearest_z = float(nearest);
    const std::array<double, 2> out = largest_slope(view);
    const double wider = largest_stretch(view, std::hypot(out[0], out[1]));
    for (std::size_t a = 0; a < 2; ++a)
      half[a] = wider * (half[a] + out[a] * half_z) / (nearest - half_z);
  }
  level.half_u = float(1.001 * half[0] * double(view.fx) + 0.01);
  level.half_v = float(1.001 * half[1] * double(view.fy) + 0.01);
  const auto size = [](float reach, int most) {
    return int(std::min(2.0f * reach, float(most))) + 2;
  };
  level.window_width = size(level.half_u, view.width);
  level.window_height = size(level.half_v, view.height);
  const int least = std::min(level.window_width, level.window_height);
  level.shift = least < 6 ? 0 : least < 12 ? 1 : 2;
  level.window_width += (1 << level.shift) - 1;
  level.window_height += (1 << level.shift) - 1;
  level.width = (view.width + (1 << level.shift) - 1) >> level.shift;
}

void RangeBounds::set_view(const views::DepthView& view, const VolumeScale& scale) {
  set_projection(view);
  set_steps(view, scale.cell_m);
  BrickKernelView& f = view_;
  f.truncation = float(scale.truncation_m);
  f.inverse_fade = 1.0f / float(std::max(scale.truncation_m - scale.full_weight_behind_m, 1e-9));
  f.edge_weight = scale.edge_weight;
  f.truncation_z_fraction = 1.0f;
  if (!view.parallel) {
    const std::array<double, 2> out = largest_slope(view);
    f.truncation_z_fraction = float(1.0 / (largest_stretch(view, std::hypot(out[0], out[1])) *
                                           std::sqrt(1.0 + out[0] * out[0] + out[1] * out[1])));
  }
  const double nearest = double(view.nearest) * double(view.unit_m) + double(view.bias_m);
  const double brick = radius_of(kBrickSide, scale.cell_m);
  // Nearer than the object, only bricks with large images are bounded.
  set_level(view, kBrickSide, scale.cell_m, 0.75 * nearest, f.brick_bounds);
  set_level(view, kPartSide, scale.cell_m, nearest - scale.truncation_m - 2.5 * brick,
            f.part_bounds);
  if (!view.parallel) f.brick_bounds.least_z = float(2.0 * brick);
}

void RangeBounds::compute() {
  const std::size_t pixels = std::size_t(view_.width) * std::size_t(view_.height);
  const std::unique_ptr<std::uint16_t[]> planes(new std::uint16_t[4 * pixels]);
  const auto fill = [&](BoundsLevel& level, std::vector<std::uint32_t>& bounds) {
    const int rows = (view_.height + (1 << level.shift) - 1) >> level.shift;
    bounds.resize(2 * std::size_t(level.width) * std::size_t(rows));
    BrickKernels::current().compute_bounds(view_, level, planes.get(), bounds.data());
    level.bounds = bounds.data();
  };
  fill(view_.brick_bounds, brick_bounds_);
  fill(view_.part_bounds, part_bounds_);
}

/// Same arithmetic as the kernel, step by step: both must give the same result.
Visibility RangeBounds::visibility(const float first[3], std::size_t brick) const {
  const BrickKernelView& f = view_;
  const BoundsLevel& level = f.brick_bounds;
  const auto along = [&](int row, const float* steps) {
    const float* r = f.rows + 3 * row;
    const float place = r[0] * first[0] + r[1] * first[1] + r[2] * first[2] + f.shift[row];
    return place + f.brick_center[row] + 8.0f * steps[brick];
  };
  const float x = along(0, f.x), y = along(1, f.y), z = along(2, f.z);
  if (!(z > level.least_z)) return Visibility::kUnobserved;
  if (z < level.nearest_z) return Visibility::kNearSurface;
  const DepthRange range = depth_range_around(x, y, z);
  const auto metres = [&](std::uint32_t raw) { return float(raw) * f.unit + f.bias; };
  const float back = z + (level.half_z + f.truncation), front = z - (level.half_z + f.truncation);
  const float seen = z - (level.half_z - f.truncation_z_fraction * f.truncation);
  if (range.farthest > 0 && metres(range.nearest) < back && metres(range.farthest) > front)
    return Visibility::kNearSurface;
  if (range.least > 0 && metres(range.least) > back) return Visibility::kFree;
  return range.most > 0 && metres(range.most) > seen ? Visibility::kPartlyFree
                                                     : Visibility::kUnobserved;
}

/// Depth range over the pixels around the image of a brick's centre, as in the bounds.
RangeBounds::DepthRange RangeBounds::depth_range_around(float x, float y, float z) const {
  const BrickKernelView& f = view_;
  const BoundsLevel& level = f.brick_bounds;
  const float inverse = f.projection == Projection::kParallel ? 1.0f : 1.0f / std::max(z, 1e-6f);
  float a = x * inverse, b = y * inverse;
  if (f.projection == Projection::kDistorted) distort<TangentialProduct::kShared>(f.lens, a, b);
  if (f.projection == Projection::kRational)
    distort_rational<TangentialProduct::kShared>(f.lens, a, b);
  if (f.projection != Projection::kPinhole) a *= f.fx, b *= f.fy;
  const float u = a + (f.cx + (0.5f - level.half_u)), v = b + (f.cy + (0.5f - level.half_v));
  const auto begin = [&](float at, int size) {
    const int pixel = int(std::min(std::max(at, 0.0f), float(size - 1)));
    return pixel >> level.shift << level.shift;
  };
  const int u0 = begin(u, f.width), v0 = begin(v, f.height);
  const int u1 = std::min(f.width, u0 + level.window_width),
            v1 = std::min(f.height, v0 + level.window_height);
  DepthRange out;
  for (int row = v0; row < v1; ++row) {
    for (int column = u0; column < u1; ++column) {
      const std::uint32_t word = f.pixels[std::size_t(row) * std::size_t(f.width) + column];
      const std::uint32_t raw = word & 0xffffu, free = word >> 16 & 0xfffeu;
      if (raw != 0) out.nearest = std::min(out.nearest, raw);
      out.farthest = std::max(out.farthest, raw);
      out.least = std::min(out.least, free);
      out.most = std::max(out.most, free);
    }
  }
  return out;
}

}  // namespace turnscan::tsdf
