#include "bench/free_registration/free_motion.hpp"
#include <turnscan/core/frame_samples.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/turntable/crop/crop.hpp>

namespace turnscan::motion {

namespace {

constexpr std::size_t kFramePoints = 1500, kAllPoints = 30000;
constexpr double kReach_m = 0.01;
constexpr int kIterations = 30;

std::vector<Vec3f> transformed(const std::vector<Vec3f>& points, const Pose& pose) {
  std::vector<Vec3f> out;
  for (const Vec3f& p : points) out.push_back((pose * p.cast<double>()).cast<float>());
  return out;
}

/// What stands on the platter, table frame, one cloud per frame.
Result<std::vector<std::vector<Vec3f>>> read_clouds(const FrameSequence& sequence,
                                                    const std::vector<Pose>& start,
                                                    const RunContext& context) {
  const auto& header = sequence.header();
  std::vector<RayTable> rays;
  for (const SensorInfo& sensor : header.sensors) rays.emplace_back(sensor.intrinsics);
  Cylinder cylinder;
  cylinder.margin_m = 0.006;
  if (header.turntable && header.turntable->radius_m)
    cylinder.radius_m = *header.turntable->radius_m;
  std::vector<std::vector<Vec3f>> clouds(start.size());
  const auto positions = usable_frames(sequence);
  TURNSCAN_TRY(
      read_frames(sequence, positions, context, [&](std::size_t k, const Frame& frame) -> Result<> {
        const std::size_t i = positions[k], s = frame.info.sensor;
        TURNSCAN_ASSIGN(const FramePoints points,
                        points_of(frame, header.sensors.at(s), rays.at(s)));
        const FramePoints kept = crop(points, SensorCrop(cylinder, start[i]));
        clouds[i] = transformed(evenly_spread(kept.cloud.points, kFramePoints), start[i]);
        context.advance();
        return {};
      }));
  return clouds;
}

Result<std::vector<Pose>> consecutive(const std::vector<std::vector<Vec3f>>& clouds,
                                      FreeMethod method, const RunContext& context) {
  std::vector<Pose> correction(clouds.size(), Pose::Identity());
  for (std::size_t i = 1; i < clouds.size(); ++i) {
    TURNSCAN_TRY(context.check());
    correction[i] = correction[i - 1];
    const auto target = transformed(clouds[i - 1], correction[i - 1]);
    const auto found =
        pairwise_icp(clouds[i], target, correction[i - 1], method, kReach_m, kIterations);
    if (found) correction[i] = *found;
    context.advance();
  }
  return correction;
}

Result<std::vector<Pose>> global(const std::vector<std::vector<Vec3f>>& clouds, FreeMethod method,
                                 const RunContext& context) {
  const std::size_t share = std::max<std::size_t>(20, kAllPoints / clouds.size());
  std::vector<Pose> correction(clouds.size(), Pose::Identity());
  parallel_for(clouds.size(), 1, [&](std::size_t i) {
    if (context.cancelled()) return;
    std::vector<Vec3f> others;
    for (std::size_t k = 0; k < clouds.size(); ++k) {
      if (k == i) continue;
      const auto part = evenly_spread(clouds[k], share);
      others.insert(others.end(), part.begin(), part.end());
    }
    const auto found =
        pairwise_icp(clouds[i], others, Pose::Identity(), method, kReach_m, kIterations);
    if (found) correction[i] = *found;
    context.advance();
  });
  TURNSCAN_TRY(context.check());
  return correction;
}

}  // namespace

}  // namespace turnscan::motion

namespace turnscan {

Result<std::vector<Pose>> register_frames_freely(const FrameSequence& sequence,
                                                 const std::vector<Pose>& start, FreeMethod method,
                                                 FreeScheme scheme, const RunContext& context) {
  if (start.size() != sequence.frames().size())
    return fail(ErrorCode::kInvalidOption, "free registration: {} poses for {} frames",
                start.size(), sequence.frames().size());
  context.begin_phase("read frames", start.size());
  TURNSCAN_ASSIGN(const auto clouds, motion::read_clouds(sequence, start, context));
  context.begin_phase("register frames", start.size());
  TURNSCAN_ASSIGN(std::vector<Pose> poses, scheme == FreeScheme::kConsecutive
                                               ? motion::consecutive(clouds, method, context)
                                               : motion::global(clouds, method, context));
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i] = poses[i] * start[i];
  return poses;
}

}  // namespace turnscan
