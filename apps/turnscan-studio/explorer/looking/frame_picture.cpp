#include "explorer/looking/frame_picture.hpp"

#include <algorithm>
#include <cmath>
#include <turnscan/evaluation/colormap.hpp>

namespace turnscan::studio {

namespace {

constexpr float kNone = 0.0f;

/// Metres along z, row by row; kNone where nothing was measured, or only outside the crop.
Image<float> depths_of(const Frame& frame, const SensorInfo& sensor) {
  if (!frame.depth.empty()) {
    Image<float> out(frame.depth.width, frame.depth.height, kNone);
    for (std::size_t i = 0; i < out.pixels.size(); ++i) {
      const std::uint16_t raw = frame.depth.pixels[i];
      if (raw != kNoReturn && raw != kOutsideCrop)
        out.pixels[i] = float(raw * sensor.depth_unit_m + sensor.depth_bias_m);
    }
    return out;
  }
  if (frame.grid.empty()) return {};
  Image<float> out(frame.grid_width, frame.grid_height, kNone);
  for (std::size_t i = 0; i < std::min(out.pixels.size(), frame.grid.size()); ++i)
    if (frame.grid[i] >= 0) out.pixels[i] = frame.points.points[std::size_t(frame.grid[i])].z();
  return out;
}

/// The range of the colours: without the hundredth at each end, which stray pixels would decide.
std::pair<float, float> range_of(const Image<float>& depths) {
  std::vector<float> measured;
  for (const float z : depths.pixels)
    if (std::isfinite(z) && z != kNone) measured.push_back(z);
  if (measured.empty()) return {0.0f, 0.0f};
  const auto quantile = [&](double share) {
    const auto at = measured.begin() + std::ptrdiff_t(share * double(measured.size() - 1));
    std::nth_element(measured.begin(), at, measured.end());
    return *at;
  };
  const float low = quantile(0.01), high = quantile(0.99);
  return {low, high};
}

QImage colored(const Image<float>& depths, float low, float high) {
  if (depths.empty()) return {};
  QImage out(depths.width, depths.height, QImage::Format_ARGB32);
  const double range = std::max(1e-9f, high - low);
  for (int y = 0; y < depths.height; ++y) {
    auto* line = reinterpret_cast<QRgb*>(out.scanLine(y));
    for (int x = 0; x < depths.width; ++x) {
      const float z = depths.at(x, y);
      const Rgb c = viridis((high - z) / range);
      line[x] = std::isfinite(z) && z != kNone ? qRgb(c.r, c.g, c.b) : qRgba(0, 0, 0, 0);
    }
  }
  return out;
}

QImage fitted(const QImage& image, int width_px) {
  return image.width() > width_px ? image.scaledToWidth(width_px, Qt::SmoothTransformation) : image;
}

}  // namespace

Result<FramePicture> frame_picture(const FrameSequence& sequence, std::size_t position,
                                   int width_px) {
  TURNSCAN_ASSIGN(const Frame frame, sequence.read(position));
  const Image<float> depths = depths_of(frame, sequence.header().sensors[frame.info.sensor]);
  const auto [low, high] = range_of(depths);
  FramePicture out{fitted(colored(depths, low, high), width_px), {}, low, high};
  const ColorImage& color = frame.color;
  if (!color.empty())
    out.color = fitted(QImage(reinterpret_cast<const uchar*>(color.pixels.data()), color.width,
                              color.height, 3 * color.width, QImage::Format_RGB888)
                           .copy(),
                       width_px);
  return out;
}

std::optional<double> angle_of_frame(const FrameSequence& sequence, std::size_t position) {
  const FrameInfo& info = sequence.frames()[position];
  if (info.angle_rad) return info.angle_rad;
  const auto& table = sequence.header().turntable;
  const double passed_s = info.time_s - sequence.frames().front().time_s;
  // How far it turned between two stretches is not known.
  if (!table || !table->speed_rad_s || info.stretch != 0 || std::isnan(passed_s))
    return std::nullopt;
  return *table->speed_rad_s * passed_s;
}

}  // namespace turnscan::studio
