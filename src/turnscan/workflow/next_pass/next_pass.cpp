#include <algorithm>
#include <cmath>
#include <numbers>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/frame_samples.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/geometry/hull/resting_poses.hpp>
#include <turnscan/geometry/mesh/mesh_measure.hpp>
#include <turnscan/geometry/search/sample.hpp>
#include <turnscan/turntable/rotation.hpp>
#include <turnscan/workflow/next_pass/next_pass.hpp>

namespace turnscan {

namespace {

constexpr double kWorthShare = 0.02;   // unseen share of the surface below which there is no advice
constexpr double kUsefulShare = 0.2;   // share of the unseen surface that a pose must show
constexpr double kOverlapShare = 0.2;  // share of the smaller surface, more than registration needs
constexpr double kSteepSine = 0.5;     // of 30 degrees
constexpr double kMinTip_rad = 10.0 * kRadiansPerDegree;
constexpr double kLikeness = 0.97;  // poses within this ratio of what they show count as equal: the
                                    // most stable one comes first
constexpr std::size_t kSamples = 10000, kOverlapStride = 8;
constexpr std::size_t kMaxPoses = 3;

bool is_unseen(Evidence evidence) {
  return evidence == Evidence::kInvented || evidence == Evidence::kBase;
}

/// Points on the surface, each representing the same area.
struct AreaSamples {
  std::vector<Vec3f> points, normals;
  double each_m2 = 0.0;

  double area_m2() const { return each_m2 * double(points.size()); }
};

struct SampledObject {
  AreaSamples unseen, measured;
};

Result<SampledObject> sample_object(const ObjectResult& object) {
  TURNSCAN_ASSIGN(const SurfaceSamples samples, sample_surface(object.mesh, kSamples, 1));
  SampledObject out;
  out.unseen.each_m2 = samples.area_m2 / double(samples.size());
  out.measured.each_m2 = out.unseen.each_m2 * double(kOverlapStride);
  std::size_t measured = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bool unseen = is_unseen(object.evidence[samples.triangles[i]]);
    if (!unseen && measured++ % kOverlapStride != 0) continue;
    AreaSamples& part = unseen ? out.unseen : out.measured;
    part.points.push_back(samples.points[i]);
    part.normals.push_back(samples.normals[i]);
  }
  return out;
}

/// Directions on the table at the first frame of the pass; unit vectors.
struct Directions {
  Vec3d sensor, right;

  explicit Directions(const PassViews& pass) {
    const CoverageView& first = pass.views.front();
    const Viewpoint viewpoint = first.viewpoint.transformed(first.T_table_sensor);
    sensor = viewpoint.value;
    sensor.y() = 0.0;
    sensor = sensor.norm() > 1e-6 ? Vec3d(sensor.normalized()) : Vec3d(-Vec3d::UnitZ());
    right = Vec3d::UnitY().cross(sensor);
  }

  double angle_of(const Vec3d& direction) const {
    const double angle = std::atan2(direction.dot(right), direction.dot(sensor));
    return angle < 0.0 ? angle + kTurn : angle;
  }
  Vec3d at(double angle_rad) const {
    return std::cos(angle_rad) * sensor + std::sin(angle_rad) * right;
  }
};

Eigen::Matrix3d tip_rotation(const NextPose& pose, const Directions& directions) {
  const Vec3d axis = Vec3d::UnitY().cross(directions.at(pose.towards_rad)).normalized();
  return Eigen::AngleAxisd(pose.tip_rad, axis).toRotationMatrix();
}

/// down: in the table's frame, with the object's current pose.
NextPose pose_with(const Vec3d& down, const Directions& directions) {
  NextPose pose;
  pose.tip_rad = std::acos(std::clamp(-down.y(), -1.0, 1.0));
  const Vec3d level(down.x(), 0.0, down.z());
  // Turning it upside down over either side gives the same pose.
  pose.towards_rad = level.norm() > 1e-3 ? directions.angle_of(level) : 0.25 * kTurn;
  return pose;
}

class PoseSearch {
 public:
  PoseSearch(const ObjectResult& object, const PassViews& pass, const SampledObject& samples,
             const Scene& scene)
      : mesh_(object.mesh),
        pass_(pass),
        samples_(samples),
        scene_(scene),
        directions_(pass),
        turn_table_mesh_(pass.T_mesh_table.linear().transpose()) {}

  Result<std::vector<NextPose>> run(const RunContext& context) {
    TURNSCAN_ASSIGN(std::vector<NextPose> poses, judged(standing(), context));
    const double useful = kUsefulShare * samples_.unseen.area_m2();
    const bool any = std::any_of(poses.begin(), poses.end(),
                                 [&](const NextPose& pose) { return pose.shows_m2 >= useful; });
    if (any) return poses;
    return judged(propped(), context);
  }

 private:
  std::vector<NextPose> standing() const {
    std::vector<NextPose> out;
    for (const RestingPose& rest : resting_poses(mesh_)) {
      NextPose pose = pose_with(turn_table_mesh_ * rest.down, directions_);
      pose.lift_m = rest.lift_m;
      if (pose.tip_rad >= kMinTip_rad) out.push_back(pose);
    }
    return out;
  }

  std::vector<NextPose> propped() const {
    std::vector<NextPose> out;
    for (int eighth = 0; eighth < 8; ++eighth)
      out.push_back({.tip_rad = 0.25 * kTurn, .towards_rad = kTurn * eighth / 8.0});
    out.push_back({.tip_rad = 0.5 * kTurn, .towards_rad = 0.25 * kTurn});
    for (NextPose& pose : out) pose.stands = false;
    return out;
  }

  /// Places the centre above the axis and the lowest point on the platter.
  void set_down(NextPose& pose) const {
    pose.T_table_mesh.linear() = tip_rotation(pose, directions_) * turn_table_mesh_;
    Box box;
    for (const Vec3f& p : mesh_.vertices) box.add(pose.T_table_mesh.linear() * p.cast<double>());
    pose.T_table_mesh.translation() = -Vec3d(box.center().x(), box.min.y(), box.center().z());
  }

  Result<double> seen_m2(const AreaSamples& samples, const std::vector<CoverageView>& views) const {
    TURNSCAN_ASSIGN(const auto sums, view_information(scene_, views, samples.points,
                                                      samples.normals, {}, RunContext()));
    const auto seen = std::count_if(sums.begin(), sums.end(),
                                    [](float sum) { return double(sum) >= kSeenInformation; });
    return double(seen) * samples.each_m2;
  }

  Result<> judge(NextPose& pose) const {
    set_down(pose);
    std::vector<CoverageView> views = pass_.views;
    const Pose T_mesh_table = pose.T_table_mesh.inverse();
    for (CoverageView& view : views) view.T_table_sensor = T_mesh_table * view.T_table_sensor;
    TURNSCAN_ASSIGN(pose.shows_m2, seen_m2(samples_.unseen, views));
    TURNSCAN_ASSIGN(pose.overlap_m2, seen_m2(samples_.measured, views));
    return {};
  }

  /// The poses that show something new and can be registered, best first.
  Result<std::vector<NextPose>> judged(std::vector<NextPose> poses,
                                       const RunContext& context) const {
    std::vector<NextPose> out;
    for (NextPose& pose : poses) {
      TURNSCAN_TRY(context.check());
      TURNSCAN_TRY(judge(pose));
      const double smaller = std::min(samples_.measured.area_m2(), pose.overlap_m2 + pose.shows_m2);
      if (pose.shows_m2 >= 0.5 * kUsefulShare * samples_.unseen.area_m2() &&
          pose.overlap_m2 >= kOverlapShare * smaller)
        out.push_back(pose);
    }
    std::stable_sort(out.begin(), out.end(), [](const NextPose& one, const NextPose& other) {
      return one.shows_m2 > other.shows_m2;
    });
    // Among those that show equally much, the most stable one.
    const auto alike = std::find_if(out.begin(), out.end(), [&](const NextPose& pose) {
      return pose.shows_m2 < kLikeness * out.front().shows_m2;
    });
    std::stable_sort(out.begin(), alike, [](const NextPose& one, const NextPose& other) {
      return one.lift_m > other.lift_m;
    });
    if (out.size() > kMaxPoses) out.resize(kMaxPoses);
    return out;
  }

  const TriangleMesh& mesh_;
  const PassViews& pass_;
  const SampledObject& samples_;
  const Scene& scene_;
  Directions directions_;
  Eigen::Matrix3d turn_table_mesh_;
};

}  // namespace

Result<PassViews> pass_views(const FrameSequence& sequence, std::optional<std::uint32_t> pass,
                             std::optional<double> speed_rad_s) {
  const auto& frames = sequence.frames();
  const SequenceHeader& header = sequence.header();
  const std::vector<std::size_t> those = usable_frames(sequence, {.pass = pass});
  if (those.empty()) return fail(ErrorCode::kMissingData, "the pass has no frames");
  TURNSCAN_ASSIGN(const FramePoses poses, frame_poses(header, frames, speed_rad_s));
  PassViews out;
  out.first_time_s = frames[those.front()].time_s;
  for (const std::size_t i : evenly_spread(those, PassViews::kMaxViews))
    out.views.push_back(view_of(header.sensors.at(frames[i].sensor), poses.T_table_sensor[i]));
  return out;
}

UnseenSurface unseen_surface(const ObjectResult& object, const Vec3d& up) {
  const TriangleMesh& mesh = object.mesh;
  UnseenSurface out;
  if (object.evidence.size() != mesh.triangles.size()) return out;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const Vec3d twice = (mesh.vertices[b] - mesh.vertices[a])
                            .cast<double>()
                            .cross((mesh.vertices[c] - mesh.vertices[a]).cast<double>());
    const double area = 0.5 * twice.norm();
    out.surface_m2 += area;
    if (!is_unseen(object.evidence[i])) continue;
    const double slope = twice.dot(up);
    if (object.evidence[i] == Evidence::kBase) {
      out.base_m2 += area;
    } else if (slope < -2.0 * kSteepSine * area) {
      out.underside_m2 += area;
    } else {
      (slope > 2.0 * kSteepSine * area ? out.top_m2 : out.sides_m2) += area;
    }
  }
  return out;
}

Result<std::optional<NextPassAdvice>> advise_next_pass(const ObjectResult& object,
                                                       const PassViews& pass,
                                                       const RunContext& context) {
  if (!object.check.watertight() || object.evidence.size() != object.mesh.triangles.size() ||
      pass.views.empty())
    return std::nullopt;
  NextPassAdvice out;
  out.pass = pass.name;
  out.unseen = unseen_surface(object, pass.T_mesh_table.linear() * Vec3d::UnitY());
  if (!(out.unseen.unseen_m2() > kWorthShare * out.unseen.surface_m2)) return std::nullopt;
  context.begin_phase("advise", 0);
  TURNSCAN_ASSIGN(const SampledObject samples, sample_object(object));
  TURNSCAN_ASSIGN(const Scene scene,
                  Scene::create(std::span(&object.mesh, 1), std::nullopt, context));
  TURNSCAN_ASSIGN(out.poses, PoseSearch(object, pass, samples, scene).run(context));
  return std::optional(std::move(out));
}

Eigen::Matrix3d turn_seen_by_sensor(const NextPose& pose, const PassViews& pass) {
  const Eigen::Matrix3d turn_table_sensor = pass.views.front().T_table_sensor.linear();
  return turn_table_sensor.transpose() * tip_rotation(pose, Directions(pass)) * turn_table_sensor;
}

}  // namespace turnscan
