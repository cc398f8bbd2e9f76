#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/core/frame_samples.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/recording/temporal_filter.hpp>

namespace turnscan {

namespace {

constexpr std::size_t kMinFrames = 240;
constexpr std::size_t kInARow = 24;
constexpr std::size_t kApart = 8;  ///< frames over the whole sequence
constexpr std::size_t kMaxPixels = 40000;
constexpr std::size_t kMinPixels = 500;
constexpr std::array<std::size_t, 3> kLags{1, 2, 4};
constexpr double kStillRange = 5.0;   ///< standard deviations; eight normal values have a range of
                                      ///< 2.8
constexpr double kMinVariance = 0.5;  ///< squared depth steps: below it is mostly rounding
constexpr double kMaxMiss = 0.12;     ///< of the ratios
constexpr double kTold = 0.3;         ///< minimum correlation for a note

/// The same pixels of all examined frames, frame by frame; empty if one is missing.
using Samples = std::vector<std::vector<std::uint16_t>>;

/// Existing frames of the sensor without a pose of their own.
std::vector<std::size_t> usable(const FrameSequence& sequence, std::uint32_t sensor) {
  std::vector<std::size_t> out = usable_frames(sequence, {.sensor = sensor});
  std::erase_if(out,
                [&](std::size_t i) { return sequence.frames()[i].T_table_sensor.has_value(); });
  return out;
}

/// kInARow consecutive positions after the first third, then kApart over the whole sequence.
std::vector<std::size_t> chosen(const std::vector<std::size_t>& frames) {
  const auto first = frames.begin() + std::ptrdiff_t(frames.size() / 3);
  std::vector<std::size_t> out(first, first + kInARow);
  for (const std::size_t i : evenly_spread_to_last(frames, kApart)) out.push_back(i);
  return out;
}

Result<Samples> read_samples(const FrameSequence& sequence,
                             const std::vector<std::size_t>& positions, const RunContext& context) {
  Samples samples(positions.size());
  const auto sample = [&](std::size_t i, const Result<Frame>& frame) -> Result<> {
    if (!frame) return {};
    const auto& pixels = frame->depth.pixels;
    // An odd step does not stay in the same columns.
    const std::size_t step = pixels.size() / kMaxPixels | 1U;
    for (std::size_t p = 0; p < pixels.size(); p += step) samples[i].push_back(pixels[p]);
    return {};
  };
  TURNSCAN_TRY(read_frames(sequence, positions, context, sample));
  return samples;
}

bool all_there(const Samples& samples) {
  return std::all_of(samples.begin(), samples.end(), [&](const auto& one) {
    return !one.empty() && one.size() == samples[0].size();
  });
}

/// Depths of one pixel, consecutive and spread; nullopt if one has no return.
std::optional<std::array<double, kInARow + kApart>> depths_of(const Samples& samples,
                                                              std::size_t pixel) {
  std::array<double, kInARow + kApart> out{};
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::uint16_t raw = samples[i][pixel];
    if (raw == kNoReturn || raw == kOutsideCrop) return std::nullopt;
    out[i] = raw;
  }
  return out;
}

bool is_still(const std::array<double, kInARow + kApart>& x) {
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < kInARow; ++i) sum += x[i];
  const double mean = sum / double(kInARow);
  for (std::size_t i = 0; i < kInARow; ++i) squares += (x[i] - mean) * (x[i] - mean);
  const double variance = squares / double(kInARow - 1);
  const auto [low, high] = std::minmax_element(x.begin() + kInARow, x.end());
  return variance >= kMinVariance && *high - *low <= kStillRange * std::sqrt(variance);
}

/// Mean square of the second differences over `lag` frames.
double second_differences(const std::array<double, kInARow + kApart>& x, std::size_t lag) {
  double sum = 0.0;
  for (std::size_t t = lag; t + lag < kInARow; ++t)
    sum += std::pow(x[t - lag] - 2.0 * x[t] + x[t + lag], 2);
  return sum / double(kInARow - 2 * lag);
}

/// The expected value for noise of variance 1 and correlation r.
double expected_square(double r, std::size_t lag) {
  const double rk = std::pow(r, double(lag));
  return 6.0 - 8.0 * rk + 2.0 * rk * rk;
}

double middle(std::vector<double>& values) {
  const auto at = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The correlation whose ratios of lag 1 to 2 and 1 to 4 are closest.
std::optional<double> fit(double one_to_two, double one_to_four) {
  double best = 0.0, least = 1e30;
  for (int step = 0; step < 98; ++step) {
    const double r = step / 100.0;
    const double one = expected_square(r, 1);
    const double miss = std::hypot(one / expected_square(r, 2) - one_to_two,
                                   one / expected_square(r, 4) - one_to_four);
    if (miss < least) least = miss, best = r;
  }
  return least <= kMaxMiss ? std::optional(best) : std::nullopt;
}

}  // namespace

Result<std::optional<double>> temporal_correlation(const FrameSequence& sequence,
                                                   std::uint32_t sensor,
                                                   const RunContext& context) {
  const std::vector<std::size_t> frames = usable(sequence, sensor);
  if (frames.size() < kMinFrames ||
      sequence.header().sensors[sensor].kind != SensorKind::kDepthCamera)
    return std::optional<double>();
  TURNSCAN_ASSIGN(const Samples samples, read_samples(sequence, chosen(frames), context));
  if (!all_there(samples)) return std::optional<double>();
  std::vector<double> one_to_two, one_to_four;
  for (std::size_t pixel = 0; pixel < samples[0].size(); ++pixel) {
    const auto x = depths_of(samples, pixel);
    if (!x || !is_still(*x)) continue;
    const double one = second_differences(*x, kLags[0]), two = second_differences(*x, kLags[1]),
                 four = second_differences(*x, kLags[2]);
    if (two > 0.0 && four > 0.0) {
      one_to_two.push_back(one / two);
      one_to_four.push_back(one / four);
    }
  }
  if (one_to_two.size() < kMinPixels) return std::optional<double>();
  return fit(middle(one_to_two), middle(one_to_four));
}

Result<std::optional<std::string>> temporal_filter_note(const FrameSequence& sequence,
                                                        const RunContext& context) {
  for (std::uint32_t sensor = 0; sensor < sequence.header().sensors.size(); ++sensor) {
    TURNSCAN_ASSIGN(const std::optional<double> correlation,
                    temporal_correlation(sequence, sensor, context));
    if (!correlation || *correlation < kTold) continue;
    return std::optional(fmt::format(
        "sensor {} smooths depth over time: {:.0f} % of a frame's noise is that of the frame "
        "before; "
        "what turns is smeared, so switch temporal filtering off in the program that records, or "
        "turn more slowly",
        sensor, 100.0 * *correlation));
  }
  return std::optional<std::string>();
}

}  // namespace turnscan
