#include <algorithm>
#include <turnscan/core/frame_samples.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/turntable/placement/disturbance_text.hpp>
#include <turnscan/turntable/placement/event_time.hpp>
#include <turnscan/turntable/placement/find_disturbances.hpp>
#include <turnscan/turntable/placement/hidden_frames.hpp>
#include <turnscan/turntable/placement/model_search.hpp>

namespace turnscan::placement {

namespace {

constexpr std::size_t kMaxKeyframes = 72, kMinKeyframes = 12;
constexpr PairWeighting kFirstLook{0.02, 0.01, 8};

class DisturbanceSearch {
 public:
  DisturbanceSearch(const FrameSequence& sequence, const std::vector<Pose>& believed,
                    PlatterMemory* memory, const RunContext& context)
      : sequence_(sequence), believed_(believed), memory_(memory), context_(context) {
    out_.T_table_sensor = believed;
  }

  Result<std::optional<Placement>> run() {
    const auto positions =
        evenly_spread_to_last(usable_frames(sequence_, {.sensor = 0}), kMaxKeyframes);
    if (positions.size() < kMinKeyframes) return std::nullopt;
    TURNSCAN_ASSIGN(auto keyframes,
                    load_keyframes(sequence_, believed_, positions, memory_, context_));
    if (!keyframes || keyframes->size() < kMinKeyframes) return std::nullopt;
    context_.begin_phase("compare frames", 1);
    find_shown(*keyframes,
               constrain_all(*keyframes, believed_keys(*keyframes),
                             successive_pairs(*keyframes, believed_keys(*keyframes)), kFirstLook));
    auto graph = solve_freely(*keyframes, believed_keys(*keyframes), context_);
    if (!graph) return nothing_if_unseen(graph.error());
    const auto hidden = hidden_frames(*keyframes, graph->poses);
    if (!hidden.empty()) {
      add_hidden(*keyframes, hidden);
      leave_out(*keyframes, hidden);
      if (keyframes->size() < kMinKeyframes) return std::move(out_);
      graph = solve_freely(*keyframes, believed_keys(*keyframes), context_);
      if (!graph) return nothing_if_unseen(graph.error());
    }
    TURNSCAN_TRY(find_and_place(*keyframes, *graph));
    context_.advance();
    return std::move(out_);
  }

 private:
  static const std::vector<Pose>& believed_keys(const Keyframes& keyframes) {
    return keyframes.T_table_sensor;
  }

  static Result<std::optional<Placement>> nothing_if_unseen(const Error& error) {
    if (error.code == ErrorCode::kTooFewPoints) return std::nullopt;
    return tl::unexpected<Error>(error);
  }

  /// Marks all frames between the nearest visible keyframes as hidden.
  void add_hidden(const Keyframes& keyframes, const std::vector<std::size_t>& hidden) {
    const auto& at = keyframes.positions;
    for (std::size_t k = 0; k < hidden.size();) {
      std::size_t end = k + 1;
      while (end < hidden.size() && hidden[end] == hidden[end - 1] + 1) ++end;
      const std::size_t first = hidden[k] == 0 ? 0 : at[hidden[k] - 1] + 1;
      const std::size_t after =
          hidden[end - 1] + 1 < at.size() ? at[hidden[end - 1] + 1] : sequence_.frames().size();
      for (std::size_t i = first; i < after; ++i)
        if (sequence_.frames()[i].sensor == 0) out_.left_out.push_back(i);
      out_.disturbances.push_back(tell_hidden(sequence_, first, after - 1));
      k = end;
    }
  }

  Result<> find_and_place(const Keyframes& keyframes, const PoseGraph& graph) {
    const ModelFrames frames = model_frames(believed_, keyframes);
    TURNSCAN_ASSIGN(auto models, find_models(keyframes, frames, graph, context_));
    if (models.size() < 2) return {};
    TURNSCAN_TRY(find_moments(sequence_, believed_, keyframes, frames, models, context_));
    // Events come first: a speed that was measured across one is wrong, too.
    for (const bool moment : {true, false}) {
      for (std::size_t k = 0; k < models.size(); ++k)
        if (!models[k].held && (models[k].first > 0) == moment)
          out_.disturbances.push_back(tell(sequence_, frames, models, k));
    }
    for (std::size_t i = 0; i < believed_.size(); ++i)
      out_.T_table_sensor[i] = placed(frames.all[i], models, frames.scene);
    return {};
  }

  const FrameSequence& sequence_;
  const std::vector<Pose>& believed_;
  PlatterMemory* memory_;
  const RunContext& context_;
  Placement out_;
};

}  // namespace

}  // namespace turnscan::placement

namespace turnscan {

Result<std::optional<Placement>> find_disturbances(const FrameSequence& sequence,
                                                   const std::vector<Pose>& T_table_sensor,
                                                   const RunContext& context,
                                                   PlatterMemory* memory) {
  const auto& frames = sequence.frames();
  if (T_table_sensor.size() != frames.size())
    return fail(ErrorCode::kInvalidOption, "placement: {} poses for {} frames",
                T_table_sensor.size(), frames.size());
  const auto& sensors = sequence.header().sensors;
  if (sensors.size() != 1 || sensors.front().kind != SensorKind::kDepthCamera) return std::nullopt;
  // Between passes the object is repositioned.
  if (std::any_of(frames.begin(), frames.end(),
                  [&](const FrameInfo& f) { return f.pass != frames.front().pass; }))
    return std::nullopt;
  return placement::DisturbanceSearch(sequence, T_table_sensor, memory, context).run();
}

}  // namespace turnscan
