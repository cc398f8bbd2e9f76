#include <algorithm>
#include <turnscan/core/spread.hpp>
#include <turnscan/turntable/placement/event_time.hpp>

namespace turnscan::placement {

namespace {

constexpr std::size_t kNeighbours = 3, kMaxBetween = 40;

bool is_step(ModelKind kind) {
  return kind == ModelKind::kSlip || kind == ModelKind::kObject || kind == ModelKind::kSensor;
}

struct Window {
  std::vector<std::size_t> between;    ///< positions of frames, increasing
  std::vector<std::size_t> positions;  ///< those and some keyframes on either side
};

Window window_of(const FrameSequence& sequence, const Keyframes& keyframes,
                 const DisturbanceModel& model) {
  Window out;
  const auto& infos = sequence.frames();
  for (std::size_t i = model.last + 1; i < model.first; ++i)
    if (infos[i].status == FrameStatus::kOk && infos[i].sensor == 0) out.between.push_back(i);
  out.between = evenly_spread_to_last(std::move(out.between), kMaxBetween);
  const auto& keys = keyframes.positions;
  const auto after = std::lower_bound(keys.begin(), keys.end(), model.first);
  const auto low = after - std::min<std::ptrdiff_t>(kNeighbours, after - keys.begin());
  const auto high = after + std::min<std::ptrdiff_t>(kNeighbours, keys.end() - after);
  out.positions.assign(low, high);
  out.positions.insert(out.positions.end(), out.between.begin(), out.between.end());
  std::sort(out.positions.begin(), out.positions.end());
  return out;
}

/// Misfit between a frame and the keyframes of the window if it is the last one before the step, or
/// the first one after it.
class StepCost {
 public:
  StepCost(const Keyframes& window, const ModelFrames& frames,
           const std::vector<DisturbanceModel>& models, std::size_t step)
      : window_(window), frames_(frames), models_(models), step_(step) {
    for (const std::size_t position : window.positions) poses_.push_back(pose(position, models));
  }

  double operator()(std::size_t position, bool moved,
                    const std::vector<std::size_t>& between) const {
    const auto at = std::find(window_.positions.begin(), window_.positions.end(), position);
    if (at == window_.positions.end()) return 0.0;
    auto models = models_;
    models[step_].first = moved ? position : position + 1;
    auto poses = poses_;
    const auto i = std::uint32_t(at - window_.positions.begin());
    poses[i] = pose(position, models);
    double sum = 0.0;
    for (std::uint32_t k = 0; k < window_.size(); ++k) {
      if (std::binary_search(between.begin(), between.end(), window_.positions[k])) continue;
      sum += pair_mismatch(window_, poses, {i, k}) + pair_mismatch(window_, poses, {k, i});
    }
    return sum;
  }

 private:
  Pose pose(std::size_t position, const std::vector<DisturbanceModel>& models) const {
    return placed(frames_.all[position], models, frames_.scene);
  }

  const Keyframes& window_;
  const ModelFrames& frames_;
  const std::vector<DisturbanceModel>& models_;
  std::size_t step_;
  std::vector<Pose> poses_;
};

/// The first of the frames that are after the step; `if_none` if there is none.
std::size_t first_after(const std::vector<std::size_t>& between, const StepCost& cost,
                        std::size_t if_none) {
  std::vector<double> before, after;
  for (const std::size_t position : between) {
    before.push_back(cost(position, false, between));
    after.push_back(cost(position, true, between));
  }
  double sum = 0.0;
  for (const double value : after) sum += value;
  double least = sum;
  std::size_t best = 0;
  for (std::size_t k = 0; k < between.size(); ++k) {
    sum += before[k] - after[k];
    if (sum < least) least = sum, best = k + 1;
  }
  return best < between.size() ? between[best] : if_none;
}

}  // namespace

Result<> find_moments(const FrameSequence& sequence, const std::vector<Pose>& believed,
                      const Keyframes& keyframes, const ModelFrames& frames,
                      std::vector<DisturbanceModel>& models, const RunContext& context) {
  PlatterMemory memory{true, keyframes.data.platter};
  for (std::size_t step = 0; step < models.size(); ++step) {
    if (!is_step(models[step].kind)) continue;
    const Window window = window_of(sequence, keyframes, models[step]);
    if (window.between.empty()) continue;
    TURNSCAN_ASSIGN(const auto loaded,
                    load_keyframes(sequence, believed, window.positions, &memory, context));
    if (!loaded) continue;
    models[step].first =
        first_after(window.between, StepCost(*loaded, frames, models, step), models[step].first);
  }
  return {};
}

}  // namespace turnscan::placement
