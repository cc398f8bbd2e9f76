#include <turnscan/workflow/page/page_plots.hpp>

#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/geometry/mesh/mesh_measure.hpp>

namespace turnscan::page {

namespace {

constexpr std::size_t kHistogramBins = 40;
constexpr std::size_t kHeightBins = 24;
constexpr std::size_t kAngleBins = 36;
constexpr std::size_t kMaxSpeeds = 240;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A vertex of any object: its position, the surface area that it represents, a value.
struct Sample {
  Vec3d position;
  double area_m2;
  double value;
};

std::vector<Sample> samples_of(const std::vector<PageObject>& objects, const Field& field) {
  std::vector<Sample> samples;
  for (const PageObject& object : objects) {
    const TriangleMesh& mesh = object.mesh;
    const std::vector<float> values = field.values(object);
    if (values.empty()) continue;
    std::vector<double> area(mesh.vertices.size(), 0.0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (const std::uint32_t v : mesh.triangles[t]) area[v] += triangle_area(mesh, t) / 3.0;
    for (std::size_t v = 0; v < values.size(); ++v) {
      if (std::isfinite(values[v]) && area[v] > 0.0 && counts(field, object, v))
        samples.push_back({mesh.vertices[v].cast<double>(), area[v], double(values[v])});
    }
  }
  return samples;
}

const char* surface_of(const Field& field) {
  return field.of_measured ? "what was measured" : "the surface";
}

std::vector<double> middles(double low, double high, std::size_t bins) {
  std::vector<double> x;
  for (std::size_t b = 0; b < bins; ++b)
    x.push_back(low + (high - low) * (double(b) + 0.5) / double(bins));
  return x;
}

std::size_t bin_of(double value, double low, double high, std::size_t bins) {
  const double share = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return std::min(bins - 1, static_cast<std::size_t>(share * double(bins)));
}

Plot histogram(const std::vector<Sample>& samples, const Field& field) {
  Plot plot;
  plot.kind = Plot::Kind::kBars;
  plot.title = field.label + ": share of the surface";
  plot.description =
      fmt::format("Share of {} by {}; what is beyond the ends is counted at the ends.",
                  surface_of(field), field.noun);
  plot.x_label = fmt::format("{} in {}", field.label, field.unit);
  plot.y_label = "Share of the surface in %";
  plot.x = middles(field.from, field.to, kHistogramBins);
  std::vector<double> share(kHistogramBins, 0.0);
  double total = 0.0;
  for (const Sample& s : samples) {
    share[bin_of(s.value, field.from, field.to, kHistogramBins)] += s.area_m2;
    total += s.area_m2;
  }
  for (double& s : share) s *= 100.0 / total;
  plot.series.push_back({"", std::move(share)});
  return plot;
}

/// Quantile weighted by area; NaN if empty. Sorts its argument.
double weighted_quantile(std::vector<std::pair<double, double>>& value_area, double share) {
  if (value_area.empty()) return kNone;
  std::sort(value_area.begin(), value_area.end());
  double total = 0.0, sum = 0.0;
  for (const auto& [value, area] : value_area) total += area;
  for (const auto& [value, area] : value_area) {
    sum += area;
    if (sum >= share * total) return value;
  }
  return value_area.back().first;
}

/// Median and 95th percentile of |value| in bins of `where`.
Plot along(const std::vector<Sample>& samples, const Field& field, double low, double high,
           std::size_t bins, const std::function<double(const Sample&)>& where) {
  std::vector<std::vector<std::pair<double, double>>> parts(bins);
  for (const Sample& s : samples)
    parts[bin_of(where(s), low, high, bins)].emplace_back(std::abs(s.value), s.area_m2);
  Plot plot;
  plot.x = middles(low, high, bins);
  plot.y_label = fmt::format("{} in {}", field.label, field.unit);
  plot.series = {{"median", {}}, {"95th percentile", {}}};
  for (auto& part : parts) {
    plot.series[0].y.push_back(weighted_quantile(part, 0.5));
    plot.series[1].y.push_back(weighted_quantile(part, 0.95));
  }
  return plot;
}

Plot over_height(const std::vector<Sample>& samples, const Field& field) {
  double low = samples[0].position.y(), high = low;
  for (const Sample& s : samples) {
    low = std::min(low, s.position.y());
    high = std::max(high, s.position.y());
  }
  const double top = std::max(high, low + 1e-6);
  Plot plot = along(samples, field, low * 1e3, top * 1e3, kHeightBins,
                    [](const Sample& s) { return s.position.y() * 1e3; });
  plot.title = field.label + " over the height";
  plot.description = fmt::format("Size of the {} at each height of {}.", field.noun,
                                 field.of_measured ? surface_of(field) : "the object");
  plot.x_label = "Height in mm";
  return plot;
}

Plot over_direction(const std::vector<Sample>& samples, const Field& field) {
  Plot plot = along(samples, field, -180.0, 180.0, kAngleBins, [](const Sample& s) {
    return std::atan2(s.position.x(), s.position.z()) * kDegreesPerRadian;
  });
  plot.title = field.label + " around the axis";
  plot.description = fmt::format(
      "Size of the {}{} in each direction from the turntable's axis, 0 being the front.",
      field.noun, field.of_measured ? " of what was measured" : "");
  plot.x_label = "Direction in degrees";
  return plot;
}

/// Speed between frames that are far enough apart that there are at most kMaxSpeeds values.
Plot speed_plot(const std::vector<TurnPoint>& turn) {
  Plot plot;
  plot.title = "Speed over the turn";
  plot.description = "How fast the table turned, from the angles of the frames.";
  plot.x_label = "Turned in degrees";
  plot.y_label = "Speed in deg/s";
  Series speed;
  const std::size_t step = std::max<std::size_t>(1, turn.size() / kMaxSpeeds);
  for (std::size_t i = step; i < turn.size(); i += step) {
    const TurnPoint &a = turn[i - step], &b = turn[i];
    if (!(b.time_s > a.time_s)) continue;
    plot.x.push_back(0.5 * (a.angle_rad + b.angle_rad) * kDegreesPerRadian);
    speed.y.push_back((b.angle_rad - a.angle_rad) / (b.time_s - a.time_s) * kDegreesPerRadian);
  }
  plot.series.push_back(std::move(speed));
  return plot;
}

/// Frames in order; those of several recordings or passes are renumbered.
Plot frames_plot(const FrameColumns& frames, const std::string& of_object) {
  Plot plot;
  plot.title = "How well the frames agree" + of_object;
  plot.description =
      "How far each frame lies off what all of them show, by shift and turn, and how far its "
      "measurements are spread about that.";
  plot.y_label = "Distance in mm";
  const auto& x = frames.frame;
  const bool ascending = std::adjacent_find(x.begin(), x.end(),
                                            [](double a, double b) { return !(a < b); }) == x.end();
  plot.x_label = ascending ? "Frame" : "Number of the frame, pass after pass";
  for (std::size_t i = 0; i < x.size(); ++i) plot.x.push_back(ascending ? x[i] : double(i + 1));
  plot.series = {{"lies off", frames.off_mm}, {"spread", frames.spread_mm}};
  return plot;
}

}  // namespace

std::vector<Plot> plots_of(const PageInput& input, const std::vector<Field>& fields,
                           const ReportFacts& facts) {
  std::vector<Plot> plots;
  for (const Field& field : fields) {
    if (!field.classes.empty()) continue;
    const std::vector<Sample> samples = samples_of(input.objects, field);
    if (samples.empty()) continue;
    plots.push_back(histogram(samples, field));
    if (field.unit != "mm") continue;
    plots.push_back(over_height(samples, field));
    plots.push_back(over_direction(samples, field));
  }
  if (input.turn.size() > 2) plots.push_back(speed_plot(input.turn));
  for (std::size_t i = 0; i < facts.objects.size(); ++i)
    if (facts.objects[i].frames)
      plots.push_back(frames_plot(*facts.objects[i].frames, facts.objects.size() > 1
                                                                ? fmt::format(", object {}", i + 1)
                                                                : ""));
  return plots;
}

}  // namespace turnscan::page
