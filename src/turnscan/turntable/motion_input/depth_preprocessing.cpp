#include <algorithm>
#include <array>
#include <turnscan/turntable/motion_input/depth_preprocessing.hpp>

namespace turnscan::motion {

namespace {

/// Weighted sum of z over 5 x 5 pixels around pixel i, row by row; nullopt if the window is
/// incomplete: at the image's border, or if a pixel is on another surface.
std::optional<double> window_sum(const FrameSurface& surface, const std::vector<float>& z,
                                 std::int32_t i, const std::array<int, 25>& weights, double fx,
                                 double noise_m) {
  const int w = surface.width;
  const int x = int(i) % w, y = int(i) / w;
  if (x < 2 || y < 2 || x + 2 >= w || y + 2 >= surface.height) return std::nullopt;
  const float here = z[std::size_t(i)];
  const auto limit = float(4.0 * here / fx + 4.0 * noise_m);
  double sum = 0.0;
  for (int k = 0; k < 25; ++k) {
    const float there = z[std::size_t(i + (k / 5 - 2) * w + k % 5 - 2)];
    if (!(there > 0.0f && std::abs(there - here) < limit)) return std::nullopt;
    sum += weights[std::size_t(k)] * double(there);
  }
  return sum;
}

/// Subtracts a share of the second differences along rows and columns, summed, if the window is
/// complete: beside outlines they are not the surface's (random_rigs: half the improvement if they
/// are included).
void subtract_bending(DepthForeground& depth, double share, double fx, double noise_m) {
  static constexpr std::array<int, 5> kSecond{2, -1, -2, -1, 2};
  std::array<int, 25> weights{};
  for (std::size_t k = 0; k < 25; ++k) weights[k] = kSecond[k % 5] + kSecond[k / 5];
  FrameSurface& surface = depth.surface;
  const std::vector<float> z = surface.z;
  for (const std::int32_t i : depth.pixels)
    if (const auto sum = window_sum(surface, z, i, weights, fx, noise_m))
      surface.z[std::size_t(i)] -= float(share * *sum / 35.0);
}

/// A second row along the outline is excluded if this share of the pixels remains.
constexpr double kMinShareWithin = 0.5;

/// The pixels of `in` whose eight neighbours are all in it and on the same surface.
std::vector<std::uint8_t> without_outline(const FrameSurface& surface,
                                          const std::vector<std::uint8_t>& in, double fx,
                                          double noise_m) {
  const int w = surface.width, h = surface.height;
  std::vector<std::uint8_t> out(in.size(), 0);
  for (int y = 1; y + 1 < h; ++y) {
    for (int x = 1; x + 1 < w; ++x) {
      const auto i = std::size_t(y) * std::size_t(w) + std::size_t(x);
      const float here = surface.z[i];
      const auto limit = float(3.0 * here / fx + 4.5 * noise_m);
      bool inner = in[i] != 0;
      for (int k = 0; k < 9 && inner; ++k) {
        const auto there = std::size_t(int(i) + (k / 3 - 1) * w + k % 3 - 1);
        inner = in[there] != 0 && std::abs(surface.z[there] - here) <= limit;
      }
      out[i] = inner ? 1 : 0;
    }
  }
  return out;
}

}  // namespace

DepthForeground extract_foreground(const DepthImage& depth, const SensorInfo& sensor,
                                   const CameraIntrinsics& camera, const RayTable& rays,
                                   const Foreground& foreground) {
  DepthForeground out;
  FrameSurface& surface = out.surface;
  surface.left = foreground.left, surface.top = foreground.top;
  surface.width = foreground.right - foreground.left;
  surface.height = foreground.bottom - foreground.top;
  surface.z.assign(std::size_t(surface.width) * std::size_t(surface.height), 0.0f);
  if (foreground.plane) out.covered.assign(surface.z.size(), 0);
  if (depth.width != camera.width || depth.height != camera.height) return out;
  for (int y = 0; y < surface.height; ++y) {
    for (int x = 0; x < surface.width; ++x) {
      const auto pixel =
          std::size_t(y + surface.top) * std::size_t(camera.width) + std::size_t(x + surface.left);
      const std::uint16_t value = depth.pixels[pixel];
      if (value == kNoReturn || value == kOutsideCrop) continue;
      const auto z = float(value * sensor.depth_unit_m + sensor.depth_bias_m);
      const Vec3f p(rays.x()[pixel] * z, rays.y()[pixel] * z, z);
      if (!(z > 0.0f)) continue;
      const auto i = std::size_t(y) * std::size_t(surface.width) + std::size_t(x);
      if (!foreground.contains(pixel, p)) {
        if (foreground.plane && double(z) < foreground.center.z() && foreground.beside(p))
          out.covered[i] = 1;
        continue;
      }
      surface.z[i] = z;
      out.pixels.push_back(std::int32_t(i));
    }
  }
  return out;
}

void drop_mixed_pixels(DepthForeground& depth, double fx, double noise_m) {
  FrameSurface& surface = depth.surface;
  const std::vector<float> z = surface.z;
  const int w = surface.width;
  std::erase_if(depth.pixels, [&](std::int32_t i) {
    const float here = z[std::size_t(i)];
    const auto limit = float(2.0 * here / fx + 3.5 * noise_m);
    const int x = int(i) % w, y = int(i) / w;
    bool mixed = x == 0 || y == 0 || x + 1 == w || y + 1 == surface.height;
    for (const int there : {i - w, i - 1, i + 1, i + w}) {
      if (mixed) break;
      const float other = z[std::size_t(there)];
      mixed = other > 0.0f && here - other > limit;
    }
    if (mixed) surface.z[std::size_t(i)] = 0.0f;
    return mixed;
  });
}

void drop_outline(DepthForeground& depth, double fx, double noise_m) {
  FrameSurface& surface = depth.surface;
  mark_inner(surface, fx, noise_m);
  std::erase_if(depth.pixels, [&](std::int32_t i) { return surface.inner[std::size_t(i)] == 0; });
  for (std::size_t i = 0; i < surface.z.size(); ++i)
    if (surface.inner[i] == 0) surface.z[i] = 0.0f;
}

void smooth_depth(DepthForeground& depth, double fx, double noise_m) {
  static constexpr std::array<int, 25> kWeights{-13, 2, 7, 2,  -13, 2,  17, 22,  17, 2, 7, 22, 27,
                                                22,  7, 2, 17, 22,  17, 2,  -13, 2,  7, 2, -13};
  FrameSurface& surface = depth.surface;
  const std::vector<float> z = surface.z;
  for (const std::int32_t i : depth.pixels)
    if (const auto sum = window_sum(surface, z, i, kWeights, fx, noise_m))
      surface.z[std::size_t(i)] = float(*sum / 175.0);
}

void correct_chord_sag(DepthForeground& depth, double fx, double noise_m) {
  subtract_bending(depth, 1.0 / 12.0, fx, noise_m);
}

void correct_filter_sag(DepthForeground& depth, double fx, double noise_m) {
  subtract_bending(depth, 1.0 / 3.0, fx, noise_m);
}

FrameSurface trimmed(const DepthForeground& depth, const std::vector<std::uint8_t>& covered) {
  const FrameSurface& surface = depth.surface;
  int left = surface.width, top = surface.height, right = 0, bottom = 0;
  const auto take_in = [&](int i) {
    const int x = i % surface.width, y = i / surface.width;
    left = std::min(left, x), right = std::max(right, x + 1);
    top = std::min(top, y), bottom = std::max(bottom, y + 1);
  };
  FrameSurface out;
  if (depth.pixels.empty()) return out;
  for (const std::int32_t i : depth.pixels) take_in(int(i));
  for (std::size_t i = 0; i < covered.size(); ++i)
    if (covered[i] != 0) take_in(int(i));
  out.left = surface.left + left, out.top = surface.top + top;
  out.width = right - left, out.height = bottom - top;
  const auto trim = [&](const auto& all, auto& into) {
    if (all.empty()) return;
    for (int y = top; y < bottom; ++y) {
      const auto row = all.begin() + std::ptrdiff_t(y) * surface.width;
      into.insert(into.end(), row + left, row + right);
    }
  };
  trim(surface.z, out.z);
  trim(covered, out.covered);
  return out;
}

void mark_inner(FrameSurface& surface, double fx, double noise_m) {
  std::vector<std::uint8_t> all(surface.z.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = surface.z[i] > 0.0f ? 1 : 0;
  const auto inner = without_outline(surface, all, fx, noise_m);
  auto innermost = without_outline(surface, inner, fx, noise_m);
  const auto count = [](const auto& in) { return double(std::count(in.begin(), in.end(), 1)); };
  surface.inner = count(innermost) < kMinShareWithin * count(inner) ? inner : std::move(innermost);
}

}  // namespace turnscan::motion
