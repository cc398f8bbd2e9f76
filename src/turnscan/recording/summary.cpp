#include <algorithm>
#include <cmath>
#include <set>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/frame_samples.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/recording/summary.hpp>
#include <turnscan/recording/temporal_filter.hpp>

namespace turnscan {

namespace {

constexpr std::size_t kSamples = 16;  ///< frames decoded per sensor

void extend(std::optional<ValueSpan>& span, double value) {
  if (!span) span = ValueSpan{value, value};
  span->min = std::min(span->min, value);
  span->max = std::max(span->max, value);
}

/// Contribution of one decoded frame.
struct FrameFigures {
  std::size_t returns = 0;
  std::size_t cells = 0;
  bool colored = false;
  std::optional<ValueSpan> depth_m;
  std::string defect;
};

FrameFigures figures_of(const Frame& frame, const SensorInfo& sensor) {
  FrameFigures out;
  out.colored = !frame.color.empty() || !frame.points.colors.empty();
  if (sensor.kind == SensorKind::kPointScanner) {
    out.returns = frame.points.size();
    out.cells = frame.grid.empty() ? out.returns : frame.grid.size();
    for (const Vec3f& p : frame.points.points) extend(out.depth_m, p.z());
    return out;
  }
  out.cells = frame.depth.pixels.size();
  for (const std::uint16_t raw : frame.depth.pixels) {
    if (raw == kNoReturn || raw == kOutsideCrop) continue;
    ++out.returns;
    extend(out.depth_m, raw * sensor.depth_unit_m + sensor.depth_bias_m);
  }
  return out;
}

Result<> sample_sensor(const FrameSequence& sequence, std::uint32_t sensor_index,
                       const RunContext& context, SequenceSummary& summary) {
  SensorSummary sensor;
  sensor.info = sequence.header().sensors[sensor_index];
  std::vector<std::size_t> positions = usable_frames(sequence, {.sensor = sensor_index});
  sensor.frames = positions.size();
  positions = evenly_spread_to_last(std::move(positions), kSamples);
  std::vector<FrameFigures> figures(positions.size());
  const auto look_at = [&](std::size_t i, const Result<Frame>& frame) -> Result<> {
    if (frame) figures[i] = figures_of(*frame, sensor.info);
    if (!frame) figures[i].defect = frame.error().text();
    context.advance();
    return {};
  };
  TURNSCAN_TRY(read_frames(sequence, positions, context, look_at));
  std::size_t returns = 0, cells = 0;
  for (const FrameFigures& f : figures) {
    if (!f.defect.empty()) {
      summary.notes.push_back(f.defect);
      continue;
    }
    ++sensor.sampled;
    sensor.colored += f.colored ? 1 : 0;
    returns += f.returns;
    cells += f.cells;
    if (f.depth_m) extend(sensor.depth_m, f.depth_m->min);
    if (f.depth_m) extend(sensor.depth_m, f.depth_m->max);
  }
  if (cells > 0) sensor.valid_share = static_cast<double>(returns) / static_cast<double>(cells);
  if (sensor.sampled > 0) sensor.points_per_frame = returns / sensor.sampled;
  summary.sensors.push_back(std::move(sensor));
  return {};
}

void count_frames(const FrameSequence& sequence, SequenceSummary& summary) {
  std::set<std::uint32_t> passes;
  for (const FrameInfo& info : sequence.frames()) {
    ++summary.frames;
    if (info.status == FrameStatus::kDropped) {
      ++summary.dropped;
      continue;
    }
    passes.insert(info.pass);
    if (info.T_table_sensor) ++summary.with_pose;
    if (!std::isnan(info.time_s)) {
      ++summary.with_time;
      extend(summary.time_s, info.time_s);
    }
    if (info.angle_rad) {
      ++summary.with_angle;
      extend(summary.angle_rad, *info.angle_rad);
    }
  }
  summary.passes = passes.size();
}

void find_turns(SequenceSummary& summary) {
  const auto turns_of = [](double angle) { return std::abs(angle) / kTurn; };
  if (summary.angle_rad) {
    summary.turns = turns_of(summary.angle_rad->max - summary.angle_rad->min);
  } else if (summary.time_s && summary.turntable && summary.turntable->speed_rad_s) {
    const double seconds = summary.time_s->max - summary.time_s->min;
    summary.turns = turns_of(seconds * *summary.turntable->speed_rad_s);
  }
}

/// Lists what would determine frames' poses in the table frame: a pose, or an angle and the table.
void find_not_known(const FrameSequence& sequence, SequenceSummary& summary) {
  const SequenceHeader& header = sequence.header();
  const bool speed = header.turntable && header.turntable->speed_rad_s;
  std::size_t no_angle = 0, no_speed = 0, no_table = 0;
  for (const FrameInfo& info : sequence.frames()) {
    if (info.status == FrameStatus::kDropped || info.T_table_sensor) continue;
    const bool timed = !std::isnan(info.time_s);
    if (!info.angle_rad && !timed) ++no_angle;
    if (!info.angle_rad && timed && !speed) ++no_speed;
    if (!header.turntable && !header.sensors[info.sensor].T_table_sensor) ++no_table;
  }
  const auto say = [&](std::size_t count, const char* what) {
    if (count > 0)
      summary.not_known.push_back(
          fmt::format("{} {} of {} frames; reconstruct finds it from the object's motion", what,
                      count, summary.frames - summary.dropped));
  };
  say(no_angle, "how far the table had turned in");
  say(no_speed, "the speed of the table, in spite of the times of");
  say(no_table, "where the table's axis and centre are, for");
  if (summary.frames == summary.dropped) summary.missing.emplace_back("there is no frame to use");
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

}  // namespace

Result<SequenceSummary> summarize(const FrameSequence& sequence, const RunContext& context) {
  SequenceSummary summary;
  const SequenceHeader& header = sequence.header();
  const std::vector<std::string> source = lines_of(header.source);
  summary.software = header.software;
  summary.source = source.front();
  summary.notes.assign(source.begin() + 1, source.end());
  summary.turntable = header.turntable;
  count_frames(sequence, summary);
  find_turns(summary);
  find_not_known(sequence, summary);
  context.begin_phase("look at frames", header.sensors.size() * kSamples);
  for (std::uint32_t i = 0; i < header.sensors.size(); ++i)
    TURNSCAN_TRY(sample_sensor(sequence, i, context, summary));
  TURNSCAN_ASSIGN(std::optional<std::string> smoothed, temporal_filter_note(sequence, context));
  if (smoothed) summary.notes.push_back(std::move(*smoothed));
  TURNSCAN_ASSIGN(summary.findings, find_implausible(sequence, context));
  return summary;
}

Result<SequenceSummary> summarize(const Recording& recording, const RunContext& context) {
  TURNSCAN_ASSIGN(SequenceSummary summary,
                  summarize(static_cast<const FrameSequence&>(recording), context));
  summary.notes.insert(summary.notes.end(), recording.notes().begin(), recording.notes().end());
  return summary;
}

}  // namespace turnscan
