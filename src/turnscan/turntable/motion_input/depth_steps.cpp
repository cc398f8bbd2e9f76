#include <algorithm>
#include <cmath>
#include <map>
#include <turnscan/core/median.hpp>
#include <turnscan/turntable/motion_input/depth_steps.hpp>

namespace turnscan::motion {

namespace {

constexpr std::size_t kEveryStepPixel = 3;
/// Rarer depths may be missing by chance, so that two observed values are not adjacent.
constexpr std::size_t kMinTimes = 10;
/// Relative range of the neighbouring depths, and the number of them that determines a step.
constexpr double kAbout = 0.02;
constexpr std::ptrdiff_t kMinValues = 6;

/// For ascending values, the step about the one at `at`.
double step_about(const std::vector<float>& values, std::size_t at) {
  const double depth_m = values[at];
  const auto first = std::lower_bound(values.begin(), values.end(), (1.0 - kAbout) * depth_m);
  const auto last = std::upper_bound(first, values.end(), (1.0 + kAbout) * depth_m);
  if (last - first < kMinValues) return 0.0;
  std::vector<float> gaps;
  for (auto it = first; it + 1 != last; ++it) gaps.push_back(it[1] - it[0]);
  return median(gaps);
}

}  // namespace

DepthSteps::DepthSteps(const std::vector<std::vector<float>>& images, double unit_m) {
  std::map<long, std::size_t> times;
  for (const auto& image : images)
    for (std::size_t i = 0; i < image.size(); i += kEveryStepPixel)
      if (image[i] > 0.0f) ++times[std::lround(double(image[i]) / unit_m)];
  for (const auto& [value, count] : times)
    if (count >= kMinTimes) values_.push_back(float(double(value) * unit_m));
  for (std::size_t i = 0; i < values_.size(); ++i) steps_.push_back(float(step_about(values_, i)));
}

double DepthSteps::at(double depth_m) const {
  if (values_.empty()) return 0.0;
  const auto next = std::lower_bound(values_.begin(), values_.end(), depth_m);
  return double(steps_[std::min(std::size_t(next - values_.begin()), steps_.size() - 1)]);
}

}  // namespace turnscan::motion
