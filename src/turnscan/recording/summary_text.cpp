#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/figure_text.hpp>
#include <turnscan/io/text/json_fields.hpp>
#include <turnscan/recording/recording_json.hpp>
#include <turnscan/recording/summary.hpp>

namespace turnscan::recording_format {

namespace {

/// Value of a recording with its limited number of significant digits.
std::string value_text(double value, Quantity quantity) {
  switch (quantity) {
    case Quantity::kLength:
      return length_text(value);
    case Quantity::kAngle:
      return fmt::format("{:.1f}deg", value / kRadiansPerDegree);
    case Quantity::kTime:
      return fmt::format("{:.3f}s", value);
    default:
      return fmt::format("{:.4f}", value);
  }
}

std::string span_text(const ValueSpan& span, Quantity quantity) {
  return fmt::format("{} to {}", value_text(span.min, quantity), value_text(span.max, quantity));
}

std::string vector_text(const Vec3d& v, Quantity quantity) {
  return fmt::format("({}, {}, {})", value_text(v.x(), quantity), value_text(v.y(), quantity),
                     value_text(v.z(), quantity));
}

std::string position_text(const SequenceSummary& s) {
  const std::size_t used = s.frames - s.dropped;
  std::string text;
  const auto add = [&](std::size_t count, const char* what) {
    if (count == 0) return;
    if (!text.empty()) text += ", ";
    text += count == used ? what : fmt::format("{} ({} of {})", what, count, used);
  };
  add(s.with_pose, "pose");
  add(s.with_angle, "angle");
  add(s.with_time, "time");
  return text.empty() ? "nothing" : text;
}

/// Appends the lines for a file of another program that is not imported yet.
void put_file(const SequenceSummary& s, std::string& out) {
  if (!s.bytes) return;
  out += fmt::format("size:        {:.1f} MB\n", double(*s.bytes) * 1e-6);
  if (!s.time_s || !(s.time_s->max > s.time_s->min) || s.sensors.empty()) return;
  const double seconds = s.time_s->max - s.time_s->min;
  const std::size_t shots = (s.frames + s.sensors.size() - 1) / s.sensors.size();
  out += fmt::format("duration:    {}, {:.1f} frames a second\n",
                     format_quantity(seconds, Quantity::kTime), double(shots - 1) / seconds);
}

/// A name from a file must not start a line that resembles ours.
std::string one_line(const std::string& name) {
  std::string out;
  for (const char c : name) out += c == '\n' ? "\\u000a" : std::string(1, c);
  return out;
}

void put_sensor(std::size_t number, const SensorSummary& sensor, std::string& out) {
  const SensorInfo& info = sensor.info;
  const bool camera = info.kind == SensorKind::kDepthCamera;
  out += fmt::format("sensor {}:    {}{}, {} frames\n", number,
                     camera ? "depth camera" : "point scanner",
                     info.model.empty() ? "" : " " + one_line(info.model), sensor.frames);
  if (camera) {
    const CameraIntrinsics& c = info.intrinsics;
    out +=
        fmt::format("  image      {} x {} pixels, fx {:.6g}, fy {:.6g}, cx {:.6g}, cy {:.6g}{}\n",
                    c.width, c.height, c.fx, c.fy, c.cx, c.cy, c.distorted() ? ", distorted" : "");
    out += fmt::format("  unit       {} a step, bias {}\n",
                       format_quantity(info.depth_unit_m, Quantity::kLength),
                       format_quantity(info.depth_bias_m, Quantity::kLength));
  } else {
    out += info.viewpoint.parallel
               ? fmt::format("  seen from  direction {}\n",
                             vector_text(info.viewpoint.value, Quantity::kNone))
               : fmt::format("  seen from  {}\n",
                             vector_text(info.viewpoint.value, Quantity::kLength));
  }
  if (sensor.sampled == 0) return;
  if (sensor.depth_m)
    out += fmt::format("  {}  {}\n", camera ? "depth    " : "z        ",
                       span_text(*sensor.depth_m, Quantity::kLength));
  out += fmt::format("  returns    {} points a frame, {:.1f} % of the cells ({} frames sampled)\n",
                     sensor.points_per_frame, 100.0 * sensor.valid_share, sensor.sampled);
  out += fmt::format("  colour     {}\n", sensor.colored == 0                ? "no"
                                          : sensor.colored == sensor.sampled ? "yes"
                                                                             : "some frames");
}

void put_turntable(const SequenceSummary& s, std::string& out) {
  if (!s.turntable) {
    out += "turntable:   not known\n";
    return;
  }
  const TurntableInfo& table = *s.turntable;
  out += fmt::format("turntable:   axis {}, centre {} in the frame of sensor 0\n",
                     vector_text(table.axis, Quantity::kNone),
                     vector_text(table.center_m, Quantity::kLength));
  out += fmt::format("  radius     {}\n", table.radius_m
                                              ? format_quantity(*table.radius_m, Quantity::kLength)
                                              : "not known");
  out +=
      fmt::format("  speed      {}\n",
                  table.speed_rad_s ? format_quantity(*table.speed_rad_s, Quantity::kAngularSpeed)
                                    : "not known");
}

text::OrderedJson span_json(const ValueSpan& span) {
  return text::OrderedJson::array({span.min, span.max});
}

text::OrderedJson sensor_json(const SensorSummary& sensor) {
  const SensorInfo& info = sensor.info;
  text::OrderedJson out = sensor_kind_json(info);
  if (info.kind != SensorKind::kDepthCamera) {
    out[info.viewpoint.parallel ? "parallel_direction" : "position_m"] =
        text::json_of(info.viewpoint.value);
  }
  out["frames"] = sensor.frames;
  out["sampled_frames"] = sensor.sampled;
  out["colored_frames"] = sensor.colored;
  out["points_per_frame"] = sensor.points_per_frame;
  out["valid_share"] = sensor.valid_share;
  if (sensor.depth_m) out["depth_m"] = span_json(*sensor.depth_m);
  return out;
}

}  // namespace

}  // namespace turnscan::recording_format

namespace turnscan {

using namespace recording_format;

std::string summary_text(const SequenceSummary& s) {
  std::string out;
  if (!s.source.empty()) out += fmt::format("source:      {}\n", s.source);
  if (!s.software.empty()) out += fmt::format("written by:  {}\n", one_line(s.software));
  out += fmt::format("frames:      {}, {} dropped, {} {}\n", s.frames, s.dropped, s.passes,
                     s.passes == 1 ? "pass" : "passes");
  out += fmt::format("placed by:   {}\n", position_text(s));
  put_file(s, out);
  if (s.time_s) out += fmt::format("times:       {}\n", span_text(*s.time_s, Quantity::kTime));
  if (s.angle_rad)
    out += fmt::format("angles:      {}\n", span_text(*s.angle_rad, Quantity::kAngle));
  if (s.turns) out += fmt::format("turns:       {:.3f}\n", *s.turns);
  for (std::size_t i = 0; i < s.sensors.size(); ++i) put_sensor(i, s.sensors[i], out);
  put_turntable(s, out);
  for (const std::string& note : s.notes) out += fmt::format("note:        {}\n", note);
  for (const PlausibilityFinding& finding : s.findings)
    out += fmt::format("{:<12} {}\n", fmt::format("{}:", name_of(finding.level)), finding.text);
  for (const std::string& what : s.not_known) out += fmt::format("not known:   {}\n", what);
  for (const std::string& what : s.missing) out += fmt::format("missing:     {}\n", what);
  return out;
}

std::string summary_json(const SequenceSummary& s) {
  auto out = text::OrderedJson::object();
  out["kind"] = "recording";
  out["source"] = s.source;
  out["software"] = s.software;
  out["frames"] = s.frames;
  out["dropped_frames"] = s.dropped;
  out["passes"] = s.passes;
  out["frames_with_pose"] = s.with_pose;
  out["frames_with_angle"] = s.with_angle;
  out["frames_with_time"] = s.with_time;
  if (s.bytes) out["bytes"] = *s.bytes;
  if (s.time_s) out["time_s"] = span_json(*s.time_s);
  if (s.angle_rad) out["angle_rad"] = span_json(*s.angle_rad);
  if (s.turns) out["turns"] = *s.turns;
  out["sensors"] = text::OrderedJson::array();
  for (const SensorSummary& sensor : s.sensors) out["sensors"].push_back(sensor_json(sensor));
  if (s.turntable) out["turntable"] = turntable_json(*s.turntable);
  out["notes"] = s.notes;
  out["findings"] = text::OrderedJson::array();
  for (const PlausibilityFinding& finding : s.findings)
    out["findings"].push_back({{"level", name_of(finding.level)}, {"text", finding.text}});
  out["not_known"] = s.not_known;
  out["missing"] = s.missing;
  std::string text = text::json_text(out);
  text.pop_back();
  return text;
}

}  // namespace turnscan
