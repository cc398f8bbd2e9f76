#include <algorithm>
#include <cmath>
#include <map>
#include <turnscan/core/frame_samples.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/geometry/estimation/normal_equations.hpp>
#include <turnscan/geometry/estimation/robust.hpp>
#include <turnscan/geometry/mesh/mesh_measure.hpp>
#include <turnscan/geometry/search/closest_point.hpp>
#include <turnscan/geometry/search/pseudo_normals.hpp>
#include <turnscan/reconstruction/frame_batch.hpp>
#include <turnscan/turntable/rotation.hpp>
#include <turnscan/workflow/verdict/frame_residuals.hpp>

namespace turnscan {

namespace {

constexpr std::size_t kMaxFrames = 128, kMaxPoints = 800, kMinPoints = 50;
constexpr double kFarthest_m = 0.010, kFarthestNoises = 10.0;
/// Height above the table at which the platter's own points end.
constexpr double kAbove_m = 0.004, kAboveNoises = 3.0;
constexpr int kRounds = 6;
/// Weight of the regularisation of what the normals do not determine, as if 2 % of the points
/// indicated no motion.
constexpr double kHold = 0.02;

/// Translation in x, y and z, and rotation about +y times the mesh's rms distance from the axis.
using Motion = Eigen::Vector4d;

struct Sample {
  Motion answer;  ///< derivative of its distance with respect to the motion
  double distance_m;
};

double spread_of(const std::vector<Sample>& samples, const Motion& moved) {
  std::vector<double> sizes;
  for (const Sample& s : samples) sizes.push_back(std::abs(s.distance_m - s.answer.dot(moved)));
  return estimation::mad_sigma(sizes);
}

/// Iteratively reweighted least squares.
Motion motion_of(const std::vector<Sample>& samples) {
  Motion moved = Motion::Zero();
  for (int round = 0; round < kRounds; ++round) {
    const double limit = std::max(estimation::kHuber95 * spread_of(samples, moved), 1e-9);
    estimation::NormalEquations<4> equations;
    equations.normal.diagonal().setConstant(kHold * double(samples.size()));
    for (const Sample& s : samples) {
      const double off = std::abs(s.distance_m - s.answer.dot(moved));
      equations.add(s.answer, s.distance_m, estimation::huber_weight(off, limit));
    }
    moved = equations.solve();
  }
  return moved;
}

/// The mesh, prepared for many queries.
class Surface {
 public:
  Surface(const ObjectResult& object, double farthest_m)
      : evidence_(object.evidence),
        distance_(object.mesh),
        normals_(object.mesh),
        box_(bounds(object.mesh.vertices)),
        middle_(box_.center()),
        farthest_m_(farthest_m) {
    double squares = 0.0, area = 0.0;
    for (std::size_t t = 0; t < object.mesh.triangles.size(); ++t) {
      const double own = triangle_area(object.mesh, t);
      const Vec3d p = object.mesh.vertices[object.mesh.triangles[t][0]].cast<double>() - middle_;
      squares += own * (p.x() * p.x() + p.z() * p.z());
      area += own;
    }
    reach_m_ = std::max(std::sqrt(squares / std::max(area, 1e-12)), 1e-4);
  }

  /// Whether a point may belong to the mesh.
  bool is_near(const Vec3d& p) const {
    return ((p - box_.min).array() > -farthest_m_).all() &&
           ((box_.max - p).array() > -farthest_m_).all();
  }

  /// nullopt if the nearest surface is too far away, or was not measured.
  std::optional<Sample> sample_at(const Vec3d& p) const {
    const auto hit = distance_.closest(p, farthest_m_);
    if (hit.triangle == MeshDistance::kNone) return std::nullopt;
    if (!evidence_.empty() && evidence_[hit.triangle] != Evidence::kMeasured) return std::nullopt;
    const Vec3d n = normals_.at(hit.point, hit.triangle), arm = hit.point - middle_;
    if (n.isZero()) return std::nullopt;
    Sample out;
    out.answer << n, (arm.z() * n.x() - arm.x() * n.z()) / reach_m_;
    out.distance_m = (p - hit.point).dot(n);
    return out;
  }

 private:
  const std::vector<Evidence>& evidence_;
  MeshDistance distance_;
  PseudoNormals normals_;
  Box box_;
  Vec3d middle_;
  double farthest_m_, reach_m_ = 1.0;
};

/// A frame of a source that is evaluated.
struct ChosenFrame {
  const MeshFrames* source;
  std::size_t position;
  Pose T_table_sensor;

  Pose T_mesh_sensor() const { return source->T_mesh_table * T_table_sensor; }
};

Result<std::vector<ChosenFrame>> choose_frames(const std::vector<MeshFrames>& sources) {
  std::vector<ChosenFrame> all;
  for (const MeshFrames& source : sources) {
    const FrameSequence& frames = *source.frames;
    TURNSCAN_ASSIGN(const FramePoses poses,
                    frame_poses(frames.header(), frames.frames(), source.speed_rad_s));
    for (const std::size_t i : usable_frames(frames, {.pass = source.pass}))
      all.push_back({&source, i, poses.T_table_sensor[i]});
  }
  return evenly_spread(all, kMaxFrames);
}

std::vector<Sample> samples_of(const Surface& surface, const FramePoints& points,
                               const ChosenFrame& chosen, double above_m) {
  std::vector<Vec3d> near;
  for (const Vec3f& p : points.cloud.points) {
    const Vec3d p_table = chosen.T_table_sensor * p.cast<double>();
    const Vec3d at = chosen.source->T_mesh_table * p_table;
    if (p_table.y() > above_m && surface.is_near(at)) near.push_back(at);
  }
  std::vector<Sample> out;
  const std::size_t stride = std::max<std::size_t>(1, near.size() / kMaxPoints);
  for (std::size_t i = stride / 2; i < near.size(); i += stride)
    if (const auto sample = surface.sample_at(near[i])) out.push_back(*sample);
  return out;
}

std::optional<FrameResidual> residual_of(const Surface& surface, const FramePoints& points,
                                         const ChosenFrame& chosen, double above_m) {
  const std::vector<Sample> samples = samples_of(surface, points, chosen, above_m);
  if (samples.size() < kMinPoints) return std::nullopt;
  const FrameInfo& info = chosen.source->frames->frames()[chosen.position];
  FrameResidual out;
  out.frame = info.index, out.sensor = info.sensor, out.time_s = info.time_s;
  out.pass = chosen.source->pass ? chosen.source->number : info.pass;
  const Motion moved = motion_of(samples);
  out.shift_m = moved.head<3>();
  out.turn_m = moved[3];
  out.spread_m = spread_of(samples, moved);
  std::vector<double> distances;
  for (const Sample& s : samples) distances.push_back(s.distance_m);
  out.outward_m = median(distances);
  out.seen_from = points.viewpoint.transformed(chosen.T_mesh_sensor()).value;
  out.points = samples.size();
  return out;
}

}  // namespace

Result<std::vector<FrameResidual>> frame_residuals(const ObjectResult& object,
                                                   const std::vector<MeshFrames>& sources,
                                                   double noise_m, const RunContext& context) {
  if (object.mesh.triangles.empty()) return std::vector<FrameResidual>();
  const Surface surface(object, std::max(kFarthest_m, kFarthestNoises * noise_m));
  const double above_m = std::max(kAbove_m, kAboveNoises * noise_m);
  TURNSCAN_ASSIGN(const auto chosen, choose_frames(sources));
  std::map<const MeshFrames*, std::vector<RayTable>> rays;
  for (const MeshFrames& source : sources) rays[&source] = ray_tables(source.frames->header());
  std::vector<std::optional<FrameResidual>> found(chosen.size());
  TURNSCAN_TRY(parallel_for(chosen.size(), 1, context, [&](std::size_t i) -> Result<> {
    const FrameSequence& frames = *chosen[i].source->frames;
    TURNSCAN_ASSIGN(const Frame frame, frames.read(chosen[i].position));
    const std::size_t s = frame.info.sensor;
    TURNSCAN_ASSIGN(const FramePoints points, points_of(frame, frames.header().sensors.at(s),
                                                        rays.at(chosen[i].source).at(s)));
    found[i] = residual_of(surface, points, chosen[i], above_m);
    return {};
  }));
  std::vector<FrameResidual> out;
  for (const auto& one : found)
    if (one) out.push_back(*one);
  return out;
}

}  // namespace turnscan
