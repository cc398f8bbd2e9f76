#include <cmath>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/turntable/placement/keyframes.hpp>

namespace turnscan::placement {

namespace {

/// The turntable according to the first frame's pose: if no platter is seen, the object is what
/// stands above it.
TurntableInfo table_at(const Pose& T_table_sensor, const SequenceHeader& header) {
  TurntableInfo out;
  const Pose T_sensor_table = T_table_sensor.inverse();
  out.axis = T_sensor_table.linear().col(1);
  out.center_m = T_sensor_table.translation();
  if (header.turntable) out.radius_m = header.turntable->radius_m;
  return out;
}

void measure_object(Keyframes& frames) {
  double count = 0.0, squares = 0.0;
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto& samples = frames.data.frames[i].samples;
    for (std::size_t s = 0; s < samples.size(); s += 16)
      points.push_back(frames.T_table_sensor[i] * samples[s].p.cast<double>());
  }
  for (const Vec3d& p : points) frames.middle += p, count += 1.0;
  frames.middle /= std::max(count, 1.0);
  for (const Vec3d& p : points) squares += (p - frames.middle).squaredNorm();
  frames.lever_m = std::max(0.005, std::sqrt(squares / std::max(count, 1.0)));
}

}  // namespace

Result<std::optional<Keyframes>> load_keyframes(const FrameSequence& sequence,
                                                const std::vector<Pose>& T_table_sensor,
                                                std::vector<std::size_t> positions,
                                                PlatterMemory* memory, const RunContext& context) {
  if (positions.size() < 3) return std::nullopt;
  motion::MotionDataOptions loading;
  loading.hint = table_at(T_table_sensor[positions.front()], sequence.header());
  loading.memory = memory;
  loading.sights = true;
  auto data = motion::load_motion(SequenceView(sequence, positions), loading, context);
  if (!data) {
    if (data.error().code == ErrorCode::kTooFewPoints) return std::nullopt;
    return tl::unexpected<Error>(data.error());
  }
  Keyframes out;
  out.data = std::move(*data);
  for (const motion::MotionFrame& frame : out.data.frames) {
    out.positions.push_back(positions[frame.position]);
    out.T_table_sensor.push_back(T_table_sensor[out.positions.back()]);
  }
  measure_object(out);
  return out;
}

double turn_between(const Pose& a, const Pose& b) {
  const Eigen::Matrix3d R = b.linear() * a.linear().transpose();
  return std::atan2(R(0, 2) - R(2, 0), R(0, 0) + R(2, 2));
}

}  // namespace turnscan::placement
