#include <algorithm>
#include <cmath>
#include <limits>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/simulator/planning/turn_view.hpp>

namespace turnscan::planning {

namespace {

constexpr float kLifted_m = 20e-6f;  // rays start at this distance outside the surface

/// A point of a spot in the table's frame.
struct TriedPoint {
  Vec3f p, normal;
  std::uint32_t spot;
  float cell_m2;  ///< area that it represents
};

std::vector<TriedPoint> middles(const PlanSurface& surface, const Pose& T) {
  const Eigen::Matrix3f R = T.linear().cast<float>();
  std::vector<TriedPoint> out(surface.spots.size());
  for (std::uint32_t i = 0; i < out.size(); ++i) {
    const Spot& spot = surface.spots[i];
    out[i] = {(T * spot.middle.p.cast<double>()).cast<float>(), R * spot.middle.normal, i,
              spot.cell_m2};
  }
  return out;
}

std::vector<TriedPoint> further_points(const PlanSurface& surface, const Pose& T,
                                       const std::vector<SpotSight>& sights) {
  const Eigen::Matrix3f R = T.linear().cast<float>();
  std::vector<TriedPoint> out;
  for (std::uint32_t i = 0; i < sights.size(); ++i) {
    if (sights[i].seen()) continue;
    const Spot& spot = surface.spots[i];
    for (std::uint32_t k = 0; k < spot.others; ++k) {
      const SpotPoint& at = surface.others[spot.first_other + k];
      out.push_back({(T * at.p.cast<double>()).cast<float>(), R * at.normal, i,
                     spot.cell_m2 / float(spot.others + 1)});
    }
  }
  return out;
}

/// Evaluates one direction of a turn after the other.
class TurnLook {
 public:
  TurnLook(const PlanSurface& surface, const TurnView& view, std::vector<SpotSight>& sights)
      : surface_(surface),
        view_(view),
        model_(*view.model),
        least_cosine_(std::cos(model_.max_incidence_rad)),
        sights_(sights) {}

  void look(std::span<const TriedPoint> points) {
    for (const Pose& T_table_sensor : view_.T_table_sensor) look_from(points, T_table_sensor);
  }

 private:
  struct Candidate {
    std::uint32_t point;
    float z, cosine, sigma;
  };

  void look_from(std::span<const TriedPoint> points, const Pose& T_table_sensor) {
    const Pose T_sensor_table = T_table_sensor.inverse();
    const Vec3f eye = T_table_sensor.translation().cast<float>();
    const Vec3f other = (T_table_sensor * model_.other_eye_m()).cast<float>();
    seen_.clear();
    rays_.clear();
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      const TriedPoint& at = points[i];
      const Vec3f way = eye - at.p;
      const float cosine = at.normal.dot(way) / way.norm();
      if (cosine < float(least_cosine_)) continue;
      const Vec3d q = T_sensor_table * at.p.cast<double>();
      if (q.z() < model_.near_m || q.z() > model_.far_m || !in_image(q)) continue;
      const float sigma =
          view_.sigma->at(float(q.z()), cosine, surface_.spots[at.spot].albedo_step);
      if (!(sigma >= 0.0f)) continue;
      if (model_.two_eyed() && !(at.normal.dot(other - at.p) > 0.0f)) continue;
      seen_.push_back({i, float(q.z()), cosine, sigma});
      rays_.push_back(ray_to(at, eye));
    }
    keep_free();
    if (model_.two_eyed()) {
      rays_.clear();
      for (const Candidate& one : seen_) rays_.push_back(ray_to(points[one.point], other));
      keep_free();
    }
    for (const Candidate& one : seen_) add(points[one.point], one);
  }

  static Ray ray_to(const TriedPoint& at, const Vec3f& eye) {
    Ray ray;
    ray.origin = at.p + kLifted_m * at.normal;
    ray.direction = eye - ray.origin;
    ray.t_max = 1.0f;
    return ray;
  }

  bool in_image(const Vec3d& q) const {
    const CameraIntrinsics& camera = model_.camera;
    const Eigen::Vector2d uv = camera.project(q);
    return uv.x() >= -0.5 && uv.y() >= -0.5 && uv.x() < camera.width - 0.5 &&
           uv.y() < camera.height - 0.5;
  }

  void keep_free() {
    blocked_.resize(rays_.size());
    view_.scene->occluded(rays_, blocked_, RayOrder::kCoherent);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < seen_.size(); ++i)
      if (!blocked_[i]) seen_[kept++] = seen_[i];
    seen_.resize(kept);
  }

  void add(const TriedPoint& at, const Candidate& one) {
    const CameraIntrinsics& camera = model_.camera;
    const auto frames = float(view_.frames_per_direction);
    // Number of pixels that a square of the surface covers at its distance.
    const float per_m2 = float(camera.fx * camera.fy) / (one.z * one.z);
    SpotSight& sight = sights_[at.spot];
    const float none = std::max(0.0f, 1.0f - at.cell_m2 * one.cosine * per_m2);
    sight.missed *= frames == 1.0f ? none : std::pow(none, frames);
    sight.cosines += frames * one.cosine;
    sight.weights += frames * one.cosine / std::max(one.sigma * one.sigma, 1e-12f);
    sight.steps_m2 += frames * one.cosine / per_m2;
  }

  const PlanSurface& surface_;
  const TurnView& view_;
  const ScannerModel& model_;
  double least_cosine_;
  std::vector<SpotSight>& sights_;
  std::vector<Candidate> seen_;
  std::vector<Ray> rays_;
  std::vector<std::uint8_t> blocked_;
};

}  // namespace

Result<SigmaSteps> SigmaSteps::create(const ScannerModel& model, const NoiseOptions& noise) {
  TURNSCAN_ASSIGN(const SensorNoise sensor, SensorNoise::create(model, noise, 1, 0));
  SigmaSteps out;
  out.near_ = float(model.near_m);
  out.scale_ = float(kDistances / (model.far_m - model.near_m));
  out.values_.reserve(std::size_t(kAlbedoLevels) * kAngles * kDistances);
  for (int albedo = 0; albedo < kAlbedoLevels; ++albedo)
    for (int angle = 0; angle < kAngles; ++angle)
      for (int distance = 0; distance < kDistances; ++distance)
        out.values_.push_back(static_cast<float>(sensor.predicted_sigma_m(
            double(out.near_) + (distance + 0.5) / double(out.scale_),
            std::acos((angle + 0.5) / kAngles), double(albedo) / (kAlbedoLevels - 1))));
  return out;
}

float SigmaSteps::at(float z_m, float cosine, std::uint8_t albedo_step) const {
  const int distance = std::clamp(int((z_m - near_) * scale_), 0, kDistances - 1);
  const int angle = std::clamp(int(cosine * kAngles), 0, kAngles - 1);
  return values_[(std::size_t(albedo_step) * kAngles + std::size_t(angle)) * kDistances +
                 std::size_t(distance)];
}

SpotSight& SpotSight::operator+=(const SpotSight& o) {
  missed *= o.missed;
  cosines += o.cosines;
  weights += o.weights;
  steps_m2 += o.steps_m2;
  return *this;
}

std::vector<SpotSight> turn_sights(const PlanSurface& surface, const TurnView& view) {
  std::vector<SpotSight> sights(surface.spots.size());
  TurnLook look(surface, view, sights);
  look.look(middles(surface, view.T_table_surface));
  look.look(further_points(surface, view.T_table_surface, sights));
  return sights;
}

std::vector<Pose> turn_directions(std::span<const double> angles_rad, const Pose& T_world_table,
                                  const Pose& T_world_sensor, std::size_t most) {
  std::vector<Pose> out;
  const Pose T_table_sensor = T_world_table.inverse() * T_world_sensor;
  for (const double angle_rad : evenly_spread(angles_rad, most))
    out.push_back(rotation_about_y(-angle_rad) * T_table_sensor);
  return out;
}

}  // namespace turnscan::planning
