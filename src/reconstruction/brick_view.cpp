#include <algorithm>
#include <cmath>
#include <memory>
#include <turnscan/reconstruction/brick_view.hpp>

namespace turnscan {

namespace {

constexpr int kBrick = Volume::kSide, kPart = 4;

/// By how much a lens stretches the image at most, as far from its middle as the window goes.
double stretch(const DepthView& view, double radius) {
  if (!view.distorted) return 1.0;
  const auto& k = view.distortion;
  const double r2 = radius * radius;
  return 1.0 +
         r2 * (3.0 * std::abs(double(k[0])) +
               r2 * (5.0 * std::abs(double(k[1])) + r2 * 7.0 * std::abs(double(k[4])))) +
         6.0 * radius * (std::abs(double(k[2])) + std::abs(double(k[3])));
}

/// Largest |x / z| and |y / z| of what the window shows, and somewhat beyond.
std::array<double, 2> widest(const DepthView& view) {
  constexpr double kBeyond = 32.0;  // pixels
  const auto reach = [](float middle, int size, float focal) {
    return (std::max(std::abs(double(middle)), std::abs(size - double(middle))) + kBeyond) /
           double(focal);
  };
  return {reach(view.cx, view.width, view.fx), reach(view.cy, view.height, view.fy)};
}

/// Half of a box along a row of the view's rotation.
double half_along(const DepthView& view, int row, int side, double cell_m) {
  return 0.5 * (side - 1) * cell_m * double(view.rotation.row(row).cwiseAbs().sum());
}

double radius_of(int side, double cell_m) { return 0.5 * std::sqrt(3.0) * side * cell_m; }

}  // namespace

void BrickView::set_lens(const DepthView& view) {
  bricks::View& f = view_;
  f.pixels = view.pixels.data();
  f.width = view.width, f.height = view.height;
  f.lens = view.parallel    ? bricks::Lens::kParallel
           : view.distorted ? bricks::Lens::kDistorted
                            : bricks::Lens::kPinhole;
  const bool pinhole = f.lens == bricks::Lens::kPinhole;
  const float scale[3] = {pinhole ? view.fx : 1.0f, pinhole ? view.fy : 1.0f, 1.0f};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      f.rows[3 * row + column] = scale[row] * view.rotation(row, column);
    f.shift[row] = scale[row] * view.translation[row];
  }
  f.focal_x = 1.0f / scale[0], f.focal_y = 1.0f / scale[1];
  f.fx = view.fx, f.fy = view.fy, f.cx = view.cx, f.cy = view.cy;
  f.k1 = view.distortion[0], f.k2 = view.distortion[1], f.p1 = view.distortion[2];
  f.p2 = view.distortion[3], f.k3 = view.distortion[4];
  f.unit = view.unit_m, f.bias = view.bias_m;
}

void BrickView::set_steps(const DepthView& view, double cell_m) {
  bricks::View& f = view_;
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
    for (int l = 0; l < int(bricks::kPartCells); ++l)
      samples[row][l] = step(row, l & 3, l >> 2 & 3, l >> 4);
    for (int l = 0; l < int(bricks::kParts); ++l)
      parts[row][l] = step(row, kPart * (l & 1), kPart * (l >> 1 & 1), kPart * (l >> 2));
    const double part = 0.5 * (kPart - 1), brick = 0.5 * (kBrick - 1);
    f.middle_of_part[row] = step(row, part, part, part);
    f.middle_of_brick[row] = step(row, brick, brick, brick);
  }
}

/// Of boxes nearer than nearest_m nothing is bounded.
void BrickView::set_level(const DepthView& view, int side, double cell_m, double nearest_m,
                          bricks::Level& level) const {
  const double half_z = half_along(view, 2, side, cell_m);
  const double rounding = 2e-6 * (65535.0 * double(view.unit_m) + std::abs(double(view.bias_m)));
  level.half_z = float(half_z + rounding);
  level.least_z = level.nearest = -1e30f;
  double half[2] = {half_along(view, 0, side, cell_m), half_along(view, 1, side, cell_m)};
  if (!view.parallel) {
    const double nearest = std::max(nearest_m, 4.0 * radius_of(side, cell_m));
    level.nearest = float(nearest);
    const std::array<double, 2> out = widest(view);
    const double wider = stretch(view, std::hypot(out[0], out[1]));
    for (std::size_t a = 0; a < 2; ++a)
      half[a] = wider * (half[a] + out[a] * half_z) / (nearest - half_z);
  }
  level.half_u = float(1.001 * half[0] * double(view.fx) + 0.01);
  level.half_v = float(1.001 * half[1] * double(view.fy) + 0.01);
  const auto size = [](float reach, int most) {
    return int(std::min(2.0f * reach, float(most))) + 2;
  };
  level.size_u = size(level.half_u, view.width);
  level.size_v = size(level.half_v, view.height);
  const int least = std::min(level.size_u, level.size_v);
  level.shift = least < 6 ? 0 : least < 12 ? 1 : 2;
  level.size_u += (1 << level.shift) - 1;
  level.size_v += (1 << level.shift) - 1;
  level.width = (view.width + (1 << level.shift) - 1) >> level.shift;
}

void BrickView::place(const DepthView& view, const VolumeScale& scale) {
  set_lens(view);
  set_steps(view, scale.cell_m);
  bricks::View& f = view_;
  f.truncation = float(scale.truncation_m);
  f.inverse_fall = 1.0f / float(std::max(scale.truncation_m - scale.behind_m, 1e-9));
  f.edge_weight = scale.edge_weight;
  f.clear_share = 1.0f;
  if (!view.parallel) {
    const std::array<double, 2> out = widest(view);
    f.clear_share = float(1.0 / (stretch(view, std::hypot(out[0], out[1])) *
                                 std::sqrt(1.0 + out[0] * out[0] + out[1] * out[1])));
  }
  const double nearest = double(view.nearest) * double(view.unit_m) + double(view.bias_m);
  const double brick = radius_of(kBrick, scale.cell_m);
  // Of what stands nearer than the object only bricks that are large in the image are asked for.
  set_level(view, kBrick, scale.cell_m, 0.75 * nearest, f.bricks);
  set_level(view, kPart, scale.cell_m, nearest - scale.truncation_m - 2.5 * brick, f.parts);
  if (!view.parallel) f.bricks.least_z = float(2.0 * brick);
}

void BrickView::bound() {
  const std::size_t pixels = std::size_t(view_.width) * std::size_t(view_.height);
  const std::unique_ptr<std::uint16_t[]> planes(new std::uint16_t[4 * pixels]);
  const auto fill = [&](bricks::Level& level, std::vector<std::uint32_t>& bounds) {
    const int rows = (view_.height + (1 << level.shift) - 1) >> level.shift;
    bounds.resize(2 * std::size_t(level.width) * std::size_t(rows));
    bricks::kernel().bound(view_, level, planes.get(), bounds.data());
    level.bounds = bounds.data();
  };
  fill(view_.bricks, bounds_of_bricks_);
  fill(view_.parts, bounds_of_parts_);
}

/// The kernel's arithmetic, step by step: both must come to the same verdict.
BrickView::Sight BrickView::look_at(const float first[3], std::size_t brick) const {
  const bricks::View& f = view_;
  const bricks::Level& level = f.bricks;
  const auto along = [&](int row, const float* steps) {
    const float* r = f.rows + 3 * row;
    const float place = r[0] * first[0] + r[1] * first[1] + r[2] * first[2] + f.shift[row];
    return place + f.middle_of_brick[row] + 8.0f * steps[brick];
  };
  const float x = along(0, f.x), y = along(1, f.y), z = along(2, f.z);
  if (!(z > level.least_z)) return Sight::kNothing;
  if (z < level.nearest) return Sight::kSurface;
  const Window window = window_at(x, y, z);
  const auto metres = [&](std::uint32_t raw) { return float(raw) * f.unit + f.bias; };
  const float back = z + (level.half_z + f.truncation), front = z - (level.half_z + f.truncation);
  const float seen = z - (level.half_z - f.clear_share * f.truncation);
  if (window.farthest > 0 && metres(window.nearest) < back && metres(window.farthest) > front)
    return Sight::kSurface;
  if (window.least > 0 && metres(window.least) > back) return Sight::kClear;
  return window.most > 0 && metres(window.most) > seen ? Sight::kPartly : Sight::kNothing;
}

/// Of the pixels around the image of a brick's middle, as the bounds have them.
BrickView::Window BrickView::window_at(float x, float y, float z) const {
  const bricks::View& f = view_;
  const bricks::Level& level = f.bricks;
  const float inverse = f.lens == bricks::Lens::kParallel ? 1.0f : 1.0f / std::max(z, 1e-6f);
  float a = x * inverse, b = y * inverse;
  if (f.lens == bricks::Lens::kDistorted) {
    const float r2 = a * a + b * b, ab = a * b;
    const float radial = 1.0f + r2 * (f.k1 + r2 * (f.k2 + r2 * f.k3));
    const float da = a * radial + 2.0f * f.p1 * ab + f.p2 * (r2 + 2.0f * a * a);
    b = b * radial + f.p1 * (r2 + 2.0f * b * b) + 2.0f * f.p2 * ab;
    a = da;
  }
  if (f.lens != bricks::Lens::kPinhole) a *= f.fx, b *= f.fy;
  const float u = a + (f.cx + (0.5f - level.half_u)), v = b + (f.cy + (0.5f - level.half_v));
  const auto begin = [&](float at, int size) {
    const int pixel = int(std::min(std::max(at, 0.0f), float(size - 1)));
    return pixel >> level.shift << level.shift;
  };
  const int u0 = begin(u, f.width), v0 = begin(v, f.height);
  const int u1 = std::min(f.width, u0 + level.size_u), v1 = std::min(f.height, v0 + level.size_v);
  Window out;
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

}  // namespace turnscan
