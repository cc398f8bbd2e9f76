#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <turnscan/core/frame_samples.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/recording/plausibility/finders.hpp>

namespace turnscan::plausibility {

namespace {

constexpr std::size_t kMinFrames = 4, kMinPixels = 500;
/// What all but this share of the pixels do not exceed between frames in succession. Where nothing
/// turns, as many exceed it at any time, within so many deviations of the two counts.
constexpr double kChanging = 0.01, kDeviations = 4.0;
/// A change beyond noise, in median differences of frames in succession.
constexpr double kBeyondNoise = 6.0;
constexpr double kBorder = 0.1;    ///< of the image's size
constexpr double kAllMoves = 0.7;  ///< share of the border's pixels
/// Compared of each kind; each of one kind beats each of the other by chance once in 70 times.
constexpr std::size_t kPairs = 4;

/// Depth differences of the pixels that both frames have.
std::vector<int> differences(const DepthImage& a, const DepthImage& b, bool border_only) {
  std::vector<int> out;
  if (a.width != b.width || a.height != b.height) return out;
  const int across = int(kBorder * a.width), along = int(kBorder * a.height);
  for (int row = 0; row < a.height; row += 2) {
    for (int column = 0; column < a.width; column += 2) {
      const bool inner =
          column >= across && column < a.width - across && row >= along && row < a.height - along;
      const std::uint16_t p = a.at(column, row), q = b.at(column, row);
      if ((border_only && inner) || p == kNoReturn || q == kNoReturn || p == kOutsideCrop ||
          q == kOutsideCrop)
        continue;
      out.push_back(std::abs(int(p) - int(q)));
    }
  }
  return out;
}

double share_above(const std::vector<int>& values, double limit) {
  const auto above =
      std::count_if(values.begin(), values.end(), [&](int value) { return value > limit; });
  return values.empty() ? 0.0 : double(above) / double(values.size());
}

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// Of n numbers sorted as text: neighbours whose numbers are none, and successive numbers that are
/// no neighbours.
std::pair<Pairs, Pairs> text_order(std::size_t n, std::size_t first) {
  std::vector<std::size_t> number(n), place(n);
  for (std::size_t i = 0; i < n; ++i) number[i] = i;
  std::sort(number.begin(), number.end(), [&](std::size_t a, std::size_t b) {
    return std::to_string(a + first) < std::to_string(b + first);
  });
  for (std::size_t i = 0; i < n; ++i) place[number[i]] = i;
  std::pair<Pairs, Pairs> out;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    if (number[i] + 1 != number[i + 1]) out.first.push_back({i, i + 1});
    if (place[i] + 1 != place[i + 1]) out.second.push_back({place[i], place[i + 1]});
  }
  for (Pairs* pairs : {&out.first, &out.second}) *pairs = evenly_spread(*pairs, kPairs);
  return out;
}

/// Shares of the pixels that change from one frame to the other; empty if a pair has too few.
Result<std::vector<double>> changes(const FrameSequence& sequence,
                                    const std::vector<std::size_t>& usable, const Pairs& pairs,
                                    double beyond_noise, const RunContext& context) {
  std::vector<double> out;
  for (const auto& [a, b] : pairs) {
    const std::array<std::size_t, 2> positions{usable[a], usable[b]};
    std::array<DepthImage, 2> images;
    TURNSCAN_TRY(read_frames(sequence, positions, context,
                             [&](std::size_t k, Result<Frame> frame) -> Result<> {
                               if (frame) images[k] = std::move(frame->depth);
                               return {};
                             }));
    const std::vector<int> values = differences(images[0], images[1], false);
    if (values.size() < kMinPixels) return std::vector<double>();
    out.push_back(share_above(values, beyond_noise));
  }
  return out;
}

}  // namespace

Result<> look_at_succession(const FrameSequence& sequence, std::uint32_t number,
                            const std::vector<Frame>& frames, const RunContext& context,
                            Findings& out) {
  if (frames.size() < kMinFrames) return {};
  const std::vector<std::size_t> usable = usable_frames(sequence, {.sensor = number});
  std::vector<int> noise = differences(frames[0].depth, frames[1].depth, false);
  if (noise.size() < kMinPixels) return {};
  const double beyond_noise = kBeyondNoise * std::max(double(median(noise)), 1.0);
  for (const std::size_t first : {0, 1}) {
    const auto [neighbours, successive] = text_order(usable.size(), first);
    if (neighbours.size() < kPairs || successive.size() < kPairs) continue;
    TURNSCAN_ASSIGN(const auto of_neighbours,
                    changes(sequence, usable, neighbours, beyond_noise, context));
    TURNSCAN_ASSIGN(const auto of_successive,
                    changes(sequence, usable, successive, beyond_noise, context));
    if (of_neighbours.empty() || of_successive.empty() ||
        *std::max_element(of_successive.begin(), of_successive.end()) >=
            *std::min_element(of_neighbours.begin(), of_neighbours.end()))
      continue;
    out.push_back({Plausibility::kImplausible,
                   fmt::format("the images of sensor {} are in the order of numbers that were "
                               "sorted as text ({}, 10, 11, ..., 2, 20, ...): give each the angle, "
                               "time or pose of its own number",
                               number, first == 0 ? "0, 1" : "1"),
                   ""});
    break;
  }
  return {};
}

void look_at_motion(std::size_t number, const std::vector<Frame>& frames, Findings& out) {
  if (frames.size() < kMinFrames) return;
  std::vector<int> noise = differences(frames[0].depth, frames[1].depth, false);
  if (noise.size() < kMinPixels) return;
  const double usual = median(noise);
  const auto rare = noise.begin() + std::ptrdiff_t((1.0 - kChanging) * double(noise.size()));
  std::nth_element(noise.begin(), rare, noise.end());
  const double beyond_noise = kBeyondNoise * std::max(usual, 1.0);
  double most_changed = 0.0, most_moved = 0.0;
  for (std::size_t i = 2; i < frames.size(); ++i) {
    const auto all = differences(frames[0].depth, frames[i].depth, false);
    const auto border = differences(frames[0].depth, frames[i].depth, true);
    most_changed = std::max(most_changed, share_above(all, *rare));
    if (border.size() >= kMinPixels)
      most_moved = std::max(most_moved, share_above(border, beyond_noise));
  }
  const double chance = kDeviations * std::sqrt(2.0 * kChanging / double(noise.size()));
  // Where frames in succession differ by more than noise, they show that something turns.
  const bool only_noise = *rare <= beyond_noise;
  if (only_noise && most_changed < kChanging + chance)
    out.push_back({Plausibility::kDoubtful,
                   fmt::format("nothing changes in the images of sensor {}: the table stood still "
                               "while they were taken, or the object looks the same from all sides",
                               number),
                   ""});
  if (most_moved > kAllMoves)
    out.push_back(
        {Plausibility::kDoubtful,
         fmt::format("what surrounds the object moves in the images of sensor {}, too: the "
                     "sensor was moved rather than the object turned; frames then need "
                     "poses of their own",
                     number),
         ""});
}

}  // namespace turnscan::plausibility
