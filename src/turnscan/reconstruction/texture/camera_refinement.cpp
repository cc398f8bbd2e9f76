#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/reconstruction/texture/camera_refinement.hpp>
#include <turnscan/reconstruction/texture/motion_evidence.hpp>
#include <turnscan/reconstruction/texture/texel_samples.hpp>

namespace turnscan::texture {

namespace {

constexpr std::size_t kViewsForPlace = 16;
constexpr std::size_t kPoints = 12000;
constexpr int kMargin_px = 40;
constexpr int kShiftReach = 32,
              kShiftStep = 2;  // step in pixels of the search for a shift of the images
constexpr double kTurnSigma_rad = 0.02, kShiftSigma_m = 0.01;
/// Weight of an outline point relative to independent evidence, since the errors of neighbours are
/// correlated.
constexpr double kOutlineShare = 0.02;
constexpr double kOutlineSigma_px = 0.7;
/// Edges that the reconstruction has rounded, or a foot on the platter, are misplaced equally all
/// around the object: outlines of one height share an error that does not average out over views.
constexpr double kShapeSigma_px = 1.0;

/// Rounds of averaging over neighbours, for the normals.
constexpr int kNormalRounds = 30;

/// About the camera's own centre.
Pose pose_of(const Motion& motion) { return estimation::exp_about(Vec3d::Zero(), motion); }
Motion motion_of(const Pose& T) { return estimation::log_about(Vec3d::Zero(), T); }

/// The part of an image that is kept.
GreyWindow grey_window(const ColorImage& image, const DrawnMesh& drawn) {
  GreyWindow out;
  out.left = std::max(0, drawn.left() - kMargin_px);
  out.top = std::max(0, drawn.top() - kMargin_px);
  const int right = std::min(image.width, drawn.left() + drawn.width() + kMargin_px);
  const int bottom = std::min(image.height, drawn.top() + drawn.height() + kMargin_px);
  out.light = Image<float>(std::max(0, right - out.left), std::max(0, bottom - out.top));
  for (int y = 0; y < out.light.height; ++y)
    for (int x = 0; x < out.light.width; ++x) {
      const Rgb c = image.at(out.left + x, out.top + y);
      out.light.at(x, y) = 0.3f * float(c.r) + 0.59f * float(c.g) + 0.11f * float(c.b);
    }
  return out;
}

/// Normalises the windows to one mean over the mesh, since exposure drifts.
void level(std::vector<GreyWindow>& windows, const std::vector<DrawnMesh>& drawn) {
  std::vector<double> means(windows.size(), 0.0);
  double all = 0.0, used = 0.0;
  for (std::size_t k = 0; k < windows.size(); ++k) {
    double sum = 0.0, count = 0.0;
    for (int y = 0; y < drawn[k].height(); ++y)
      for (int x = 0; x < drawn[k].width(); ++x) {
        if (!drawn[k].covered(x, y)) continue;
        sum += double(windows[k].light.at(drawn[k].left() + x - windows[k].left,
                                          drawn[k].top() + y - windows[k].top));
        count += 1.0;
      }
    if (!(count > 0.0 && sum > 0.0)) continue;
    means[k] = sum / count;
    all += means[k], used += 1.0;
  }
  for (std::size_t k = 0; k < windows.size(); ++k) {
    if (!(means[k] > 0.0)) continue;
    const auto gain = float(all / used / means[k]);
    for (float& value : windows[k].light.pixels) value *= gain;
  }
}

/// Vertex normals without the noise of the surface: a wall with noisy normals would bias the
/// camera's height.
std::vector<Vec3f> smooth_normals(const TriangleMesh& mesh) {
  std::vector<Vec3f> normals = vertex_normals(mesh);
  for (int round = 0; round < kNormalRounds; ++round) {
    std::vector<Vec3f> sums(normals.size(), Vec3f::Zero());
    for (const auto& t : mesh.triangles) {
      const Vec3f sum = normals[t[0]] + normals[t[1]] + normals[t[2]];
      for (const auto v : t) sums[v] += sum;
    }
    for (std::size_t v = 0; v < normals.size(); ++v)
      if (sums[v].squaredNorm() > 0.0f) normals[v] = sums[v].normalized();
  }
  return normals;
}

class Refiner {
 public:
  Refiner(const TriangleMesh& mesh, std::vector<ColorView> views, const Pose& start,
          const RunContext& context)
      : mesh_(mesh), views_(std::move(views)), start_(start), T_(start), context_(context) {
    const std::vector<Vec3f> normals = smooth_normals(mesh);
    const auto box = bounds(mesh.vertices);
    bands_ = {box.min.y(), box.size().y()};
    const std::size_t step = std::max<std::size_t>(1, mesh.vertices.size() / kPoints);
    for (std::size_t v = 0; v < mesh.vertices.size(); v += step) {
      points_.push_back(mesh.vertices[v]);
      normals_.push_back(normals[v]);
    }
  }

  Result<> read(const FrameSequence& sequence) {
    place();
    draw();
    windows_.resize(views_.size());
    return parallel_for(views_.size(), 1, context_, [&](std::size_t k) -> Result<> {
      TURNSCAN_ASSIGN(const ColorImage image, image_of(sequence, views_[k]));
      if (!image.empty() && !drawn_[k].empty()) windows_[k] = grey_window(image, drawn_[k]);
      return {};
    });
  }

  Result<> run() {
    if (points_.empty()) return {};
    level(windows_, drawn_);
    const std::vector<GreyWindow> soft = all_blurred(1.5);
    shift_roughly(soft);
    draw();
    for (const double reach : {9.0, 7.0, 5.0}) TURNSCAN_TRY(step(outlines(soft, reach), nullptr));
    for (const double sigma : {3.0, 1.5, 0.8}) {
      draw();
      const std::vector<GreyWindow> grey = all_blurred(sigma);
      for (int round = 0; round < 3; ++round) {
        const OutlineEquations outline = outlines(soft, 3.0);
        const MotionEquations pattern = pattern_equations(views_, drawn_, grey, points_, normals_);
        TURNSCAN_TRY(step(outline, &pattern));
      }
    }
    return {};
  }

  /// Misfit of the images with the camera at T: smaller is better.
  double misfit(const Pose& T) {
    T_ = T;
    place();
    draw();
    const std::vector<GreyWindow> soft = all_blurred(1.5);
    double strength = 0.0, count = 0.0;
    for (std::size_t k = 0; k < views_.size(); ++k) {
      strength += edge_strength(views_[k], outlines_[k], soft[k], Eigen::Vector2f::Zero());
      count += double(outlines_[k].size());
    }
    const MotionEquations pattern = pattern_equations(views_, drawn_, soft, points_, normals_);
    const double a = count > 0.0 ? strength / count : 0.0;
    const double b = pattern.weight > 0.0 ? pattern.error / pattern.weight : 0.0;
    return std::sqrt(b) - a;
  }

  /// Reverts what the evidence does not determine. Returns the standard deviation, pixels.
  double keep_what_is_determined() {
    if (points_.empty()) return 0.0;
    evidence_.image = image_movement();
    const DeterminedMotion part = determined_part(evidence_, motion_of(T_ * start_.inverse()));
    T_ = part.directions == 0 ? start_ : pose_of(-part.open) * T_;
    place();
    return part.deviation_px;
  }

  const Pose& pose() const { return T_; }

  double moved_px(const Pose& from, const Pose& to) const {
    double sum = 0.0, count = 0.0;
    for (ColorView view : views_) {
      ColorView other = view;
      view.set_pose(from);
      other.set_pose(to);
      for (std::size_t i = 0; i < points_.size(); i += 16) {
        const Projection a = view.project(points_[i]), b = other.project(points_[i]);
        if (!(a.z > 0.0f && b.z > 0.0f)) continue;
        sum += double((a.u - b.u) * (a.u - b.u) + (a.v - b.v) * (a.v - b.v));
        count += 1.0;
      }
    }
    return count > 0.0 ? std::sqrt(sum / count) : 0.0;
  }

 private:
  void place() {
    for (ColorView& view : views_) view.set_pose(T_);
  }

  void draw() {
    std::vector<std::optional<DrawnMesh>> drawn(views_.size());
    outlines_.resize(views_.size());
    parallel_for(views_.size(), 1, [&](std::size_t k) {
      drawn[k].emplace(views_[k], mesh_);
      outlines_[k] = outline_of(views_[k], *drawn[k]);
    });
    drawn_.clear();
    for (auto& d : drawn) drawn_.push_back(std::move(*d));
  }

  /// A rotation of the camera shifts all its images equally: searches for the shift at which
  /// outlines are on edges in all of them.
  void shift_roughly(const std::vector<GreyWindow>& soft) {
    const double start = strength_at(soft, Eigen::Vector2f::Zero());
    constexpr int kSide = 2 * kShiftReach / kShiftStep + 1;
    const auto shift_of = [](std::size_t i) {
      return Eigen::Vector2f(float(int(i) % kSide * kShiftStep - kShiftReach),
                             float(int(i) / kSide * kShiftStep - kShiftReach));
    };
    std::vector<double> strength(std::size_t(kSide * kSide));
    parallel_for(strength.size(), 1,
                 [&](std::size_t i) { strength[i] = strength_at(soft, shift_of(i)); });
    const auto best =
        std::size_t(std::max_element(strength.begin(), strength.end()) - strength.begin());
    if (!(strength[best] > 1.05 * start)) return;
    const Eigen::Vector2f shift = shift_of(best);
    const CameraIntrinsics& camera = views_.front().camera;
    Motion motion = Motion::Zero();
    motion[0] = -double(shift.y()) / camera.fy;
    motion[1] = double(shift.x()) / camera.fx;
    T_ = pose_of(motion) * T_;
    place();
  }

  double strength_at(const std::vector<GreyWindow>& soft, const Eigen::Vector2f& shift) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < views_.size(); ++k)
      sum += edge_strength(views_[k], outlines_[k], soft[k], shift);
    return sum;
  }

  std::vector<GreyWindow> all_blurred(double sigma) const {
    std::vector<GreyWindow> out(windows_.size());
    parallel_for(out.size(), 1, [&](std::size_t k) {
      if (!windows_[k].light.empty()) out[k] = blurred(windows_[k], sigma);
    });
    return out;
  }

  OutlineEquations outlines(const std::vector<GreyWindow>& soft, double reach) const {
    std::vector<OutlineEquations> parts(views_.size());
    parallel_for(views_.size(), 1, [&](std::size_t k) {
      if (!soft[k].light.empty())
        parts[k] = outline_equations(views_[k], outlines_[k], soft[k], bands_, reach);
    });
    OutlineEquations all;
    for (const OutlineEquations& part : parts) all.add(part);
    return all;
  }

  /// One Gauss-Newton step. Undetermined directions stay at their start: the prior deviations are a
  /// degree and a centimetre.
  Result<> step(const OutlineEquations& outline, const MotionEquations* pattern) {
    TURNSCAN_TRY(context_.check());
    const double per_outline = kOutlineShare / (kOutlineSigma_px * kOutlineSigma_px);
    evidence_.information = per_outline * outline.normal;
    Motion right = per_outline * outline.right;
    const Eigen::Matrix<double, 6, HeightBands::kCount> per_band =
        kShapeSigma_px * per_outline * outline.per_band;
    evidence_.shared = per_band * per_band.transpose();
    if (pattern != nullptr && pattern->weight > 0.0) {
      const double variance = std::max(1.0, pattern->error / pattern->weight);
      evidence_.information += kOutlineShare / variance * pattern->normal;
      right += kOutlineShare / variance * pattern->right;
    }
    const Motion from_start = motion_of(T_ * start_.inverse());
    for (int i = 0; i < 6; ++i) {
      const double sigma = i < 3 ? kTurnSigma_rad : kShiftSigma_m;
      evidence_.information(i, i) += 1.0 / (sigma * sigma);
      right[i] -= from_start[i] / (sigma * sigma);
    }
    const Motion motion = estimation::solve_ldlt(evidence_.information, right);
    if (!motion.allFinite()) return {};
    T_ = pose_of(motion) * T_;
    place();
    return {};
  }

  /// Mean square of image_motion() over the surface.
  MotionMatrix image_movement() const {
    MotionMatrix sum = MotionMatrix::Zero();
    double count = 0.0;
    for (const ColorView& view : views_)
      for (std::size_t i = 0; i < points_.size(); i += 16) {
        const Vec3f p = view.rotation * points_[i] + view.translation;
        if (!(p.z() > 0.0f)) continue;
        const auto moved = image_motion(p, view.camera);
        sum += moved.transpose() * moved;
        count += 1.0;
      }
    return sum / std::max(1.0, count);
  }

  const TriangleMesh& mesh_;
  std::vector<ColorView> views_;
  const Pose start_;
  Pose T_;
  const RunContext& context_;
  HeightBands bands_;
  MotionEvidence evidence_;  // of the last step
  std::vector<Vec3f> points_, normals_;
  std::vector<DrawnMesh> drawn_;
  std::vector<std::vector<OutlinePoint>> outlines_;  // as drawn
  std::vector<GreyWindow> windows_;
};

}  // namespace

Result<RefinedCamera> refine_camera(const FrameSequence& sequence, const TriangleMesh& mesh,
                                    const std::vector<ColorView>& views, const Pose& T_color_sensor,
                                    const RunContext& context) {
  RefinedCamera out;
  out.T_color_sensor = T_color_sensor;
  std::vector<ColorView> some = evenly_spread(views, kViewsForPlace);
  if (some.size() < 3) return out;
  Refiner refiner(mesh, std::move(some), T_color_sensor, context);
  TURNSCAN_TRY(refiner.read(sequence));
  TURNSCAN_TRY(refiner.run());
  out.deviation_px = refiner.keep_what_is_determined();
  const Pose found = refiner.pose();
  const double after = refiner.misfit(found), before = refiner.misfit(T_color_sensor);
  if (!(after < before)) return out;
  out.misplaced_px = refiner.moved_px(T_color_sensor, found);
  out.T_color_sensor = found;
  out.refined = true;
  return out;
}

}  // namespace turnscan::texture
