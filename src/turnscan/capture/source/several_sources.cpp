// Several sensors in front of one turntable, as one source.

#include <algorithm>
#include <cmath>
#include <deque>
#include <turnscan/capture/source/clock_offset.hpp>
#include <turnscan/capture/source/grabber.hpp>
#include <turnscan/turntable/table_frame.hpp>

namespace turnscan::source {

namespace {

constexpr std::size_t kClockFrames = 20;  // per source, to determine its clock offset
constexpr double kClockPatience_s = 3.0;  // maximum wait for these
constexpr double kOrderPatience_s = 0.3;  // maximum wait for the next frame of a late source
constexpr double kMemberSlice_s = 0.01;

struct Member {
  std::unique_ptr<FrameSource> source;
  std::uint32_t first_sensor = 0;
  ClockOffset clock;
  double shift_s = 0.0;  ///< added to convert to the clock of the first source
  std::deque<Delivery> waiting;
  bool ended = false;
  double last_came_s = 0.0;
};

class SeveralSources : public FrameSource {
 public:
  SeveralSources(std::vector<Member> members, SourceInfo info)
      : members_(std::move(members)), info_(std::move(info)) {}

  const SourceInfo& info() const override { return info_; }

  Result<> start() override {
    for (Member& member : members_) {
      if (auto started = member.source->start(); !started) {
        stop();
        return started;
      }
      member.ended = false;
      member.last_came_s = steady_seconds();
    }
    return {};
  }

  void stop() override {
    for (Member& member : members_) member.source->stop();
  }

  Result<Delivery> next(double timeout_s, const RunContext& context) override {
    const double end_s = steady_seconds() + std::max(timeout_s, 0.0);
    for (;;) {
      TURNSCAN_TRY(context.check());
      TURNSCAN_TRY(fill(context));
      if (Member* first = earliest()) return take(*first);
      if (std::all_of(members_.begin(), members_.end(), [](const Member& m) { return m.ended; })) {
        Delivery end;
        end.kind = Delivery::Kind::kEnd;
        return end;
      }
      if (steady_seconds() >= end_s) return Delivery{};
    }
  }

  SourceStatistics statistics() const override {
    SourceStatistics sum;
    for (const Member& member : members_) {
      const SourceStatistics one = member.source->statistics();
      sum.delivered += one.delivered;
      sum.dropped_by_sensor += one.dropped_by_sensor;
      sum.dropped_by_queue += one.dropped_by_queue;
      sum.refused += one.refused;
      sum.most_waiting = std::max(sum.most_waiting, one.most_waiting);
    }
    return sum;
  }

 private:
  /// Gets a frame from each source that has none waiting, or as many as needed for its clock
  /// offset.
  Result<> fill(const RunContext& context) {
    for (Member& member : members_) {
      const std::size_t want = clocks_set_ ? 1 : kClockFrames;
      while (!member.ended && member.waiting.size() < want) {
        TURNSCAN_ASSIGN(Delivery delivery, member.source->next(kMemberSlice_s, context));
        if (delivery.kind == Delivery::Kind::kNothing) break;
        if (delivery.kind == Delivery::Kind::kEnd) {
          member.ended = true;
          break;
        }
        member.last_came_s = steady_seconds();
        if (delivery.frame.info.status == FrameStatus::kOk)
          member.clock.add(delivery.frame.info.time_s, delivery.host_time_s);
        member.waiting.push_back(std::move(delivery));
      }
    }
    if (!clocks_set_) set_clocks();
    return {};
  }

  void set_clocks() {
    const double now_s = steady_seconds();
    for (const Member& member : members_)
      if (!member.ended && member.waiting.size() < kClockFrames &&
          now_s - member.last_came_s < kClockPatience_s)
        return;
    for (Member& member : members_)
      member.shift_s = member.clock.to_host_s() - members_.front().clock.to_host_s();
    clocks_set_ = true;
  }

  static double time_of(const Member& member) {
    return member.waiting.front().frame.info.time_s + member.shift_s;
  }

  /// The source whose frame is next; nullptr if a frame that may be earlier has to be waited for. A
  /// source that stays silent does not hold up the others.
  Member* earliest() {
    if (!clocks_set_) return nullptr;
    Member* first = nullptr;
    for (Member& member : members_) {
      if (member.waiting.empty()) {
        const bool silent = steady_seconds() - member.last_came_s > kOrderPatience_s;
        if (!member.ended && !(info_.live && silent)) return nullptr;
        continue;
      }
      if (first == nullptr || time_of(member) < time_of(*first)) first = &member;
    }
    return first;
  }

  Delivery take(Member& member) {
    Delivery out = std::move(member.waiting.front());
    member.waiting.pop_front();
    FrameInfo& frame = out.frame.info;
    frame.index = next_index_++;
    frame.sensor += member.first_sensor;
    frame.time_s += member.shift_s;
    return out;
  }

  std::vector<Member> members_;
  SourceInfo info_;
  bool clocks_set_ = false;
  std::uint32_t next_index_ = 0;
};

/// The sensors' poses relative to the turntable of the first source: the azimuth of each source's
/// own table frame is arbitrary, so that the poses are known only if both sources have more in
/// common.
std::vector<SensorInfo> sensors_before(const SourceInfo& first, const SourceInfo& one) {
  std::vector<SensorInfo> sensors = one.header.sensors;
  for (std::size_t k = 0; k < sensors.size(); ++k) {
    const auto place = sensor_pose(one.header, k);
    const bool known = place && first.T_table_common && one.T_table_common;
    sensors[k].T_table_sensor.reset();
    if (known)
      sensors[k].T_table_sensor = *first.T_table_common * one.T_table_common->inverse() * *place;
  }
  return sensors;
}

Result<> add_to(SourceInfo& sum, const SourceInfo& one) {
  if (one.live != sum.live)
    return fail(ErrorCode::kInvalidOption,
                "devices '{}' and '{}': one keeps its own time and the other does not; add "
                "realtime=1 or leave it out at both",
                sum.uri, one.uri);
  for (std::size_t k = 0; k < one.identities.size(); ++k) {
    if (std::find(sum.identities.begin(), sum.identities.end(), one.identities[k]) !=
        sum.identities.end())
      return fail(ErrorCode::kInvalidOption,
                  "device '{}' is given twice ({}); of virtual ones give each a serial=", one.uri,
                  one.identities[k]);
    sum.identities.push_back(one.identities[k]);
  }
  for (SensorInfo& sensor : sensors_before(sum, one))
    sum.header.sensors.push_back(std::move(sensor));
  for (const auto& [name, value] : one.settings)
    sum.settings[fmt::format("{} {}", one.identities.front(), name)] = value;
  sum.uri += " " + one.uri;
  sum.fps = std::max(sum.fps, one.fps);
  sum.frame_count = sum.frame_count && one.frame_count
                        ? std::optional(*sum.frame_count + *one.frame_count)
                        : std::nullopt;
  sum.lays_object = false;  // each would reposition a separate object
  return {};
}

}  // namespace

}  // namespace turnscan::source

namespace turnscan {

using namespace source;

Result<std::unique_ptr<FrameSource>> open_sources(const std::vector<std::string>& uris,
                                                  const RunContext& context) {
  if (uris.empty())
    return fail(ErrorCode::kInvalidOption, "there is no device; give one, e.g. virtual:doll");
  if (uris.size() == 1) return open_source(uris.front(), context);
  std::vector<Member> members;
  SourceInfo info;
  for (const std::string& uri : uris) {
    Member member;
    TURNSCAN_ASSIGN(member.source, open_source(uri, context));
    const SourceInfo& one = member.source->info();
    member.first_sensor = static_cast<std::uint32_t>(info.header.sensors.size());
    if (members.empty())
      info = one;
    else
      TURNSCAN_TRY(add_to(info, one));
    members.push_back(std::move(member));
  }
  return std::unique_ptr<FrameSource>(
      std::make_unique<SeveralSources>(std::move(members), std::move(info)));
}

}  // namespace turnscan
