#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/simulator/coverage/coverage_count.hpp>

namespace turnscan::coverage {

namespace {

constexpr std::size_t kTestedPoses = 64;  // of a matrix scanner
constexpr int kDirections = 48;           // around the table
constexpr double kHeightStep_m = 0.05;
constexpr int kMaxHeights = 9;
constexpr double kLift_m = 20e-6;  // rays start at this distance outside the surface
constexpr std::size_t kCellsPerTask = 64;

/// A point to be tested, with its normal. Frame: the table of the first pass.
struct CellPoint {
  std::uint32_t cell;
  Vec3d p, normal;
};

/// How far a sample of a cell came in the best frame; the farthest counts.
struct Outcome {
  enum Stage { kUntried, kInView, kInRange, kFlat, kFirstEye, kSecondEye, kSeen };
  Stage stage = kUntried;
  Miss miss = Miss::kNothing;

  void raise(Stage to, Miss why) {
    if (to > stage) stage = to, miss = why;
  }
  void raise(Miss in_view) {
    raise(in_view == Miss::kOutOfView ? kInView
          : in_view == Miss::kGrazing ? kFlat
                                      : kInRange,
          in_view);
  }
};

/// A frame from which cells are tested, with the table of the first pass. For a line scanner also
/// the previous frame: its line has passed over the space between the two.
struct TestedView {
  const ScannerModel* model;
  Pose T_sensor_table, T_sensor_table_before;
  bool line = false;
  Vec3d origin, other;  ///< table frame
  std::uint32_t pass;
  Pose T_room_pass;  ///< from the table of its own pass

  Miss in_view(const CellPoint& spot) const {
    const Vec3d q = T_sensor_table * spot.p;
    if (!(q.z() > 0.0)) return Miss::kOutOfView;
    if (line && q.x() * (T_sensor_table_before * spot.p).x() > 0.0) return Miss::kOutOfView;
    const CameraIntrinsics& camera = model->camera;
    const Eigen::Vector2d uv = camera.project(q);
    const bool inside = (line || (uv.x() >= -0.5 && uv.x() < camera.width - 0.5)) &&
                        uv.y() >= -0.5 && uv.y() < camera.height - 0.5;
    if (!inside) return Miss::kOutOfView;
    if (q.z() < model->near_m) return Miss::kTooNear;
    if (q.z() > model->far_m) return Miss::kTooFar;
    const double cosine = spot.normal.dot((origin - spot.p).normalized());
    return cosine < std::cos(model->max_incidence_rad) ? Miss::kGrazing : Miss::kNone;
  }
};

Pose in_first(const CoverageJob& job, const CoveragePose& pose) {
  return pose.pass == 0 ? pose.T_table_sensor
                        : job.passes[pose.pass].T_first_pass * pose.T_table_sensor;
}

std::vector<TestedView> tested_views(const CoverageJob& job) {
  std::vector<std::vector<const CoveragePose*>> of_scanner(job.scanners.size());
  for (const CoveragePose& pose : job.poses) of_scanner[pose.scanner].push_back(&pose);
  std::vector<TestedView> views;
  for (std::size_t s = 0; s < of_scanner.size(); ++s) {
    const auto& poses = of_scanner[s];
    const bool line = job.scanners[s].kind == ScannerKind::kLine;
    const std::size_t tested = kTestedPoses * job.passes.size();
    const std::size_t step = line ? 1 : std::max<std::size_t>(1, poses.size() / tested);
    for (std::size_t i = 0; i < poses.size(); i += step) {
      const std::uint32_t pass = poses[i]->pass;
      const bool follows = i > 0 && poses[i - 1]->pass == pass;
      const Pose T = in_first(job, *poses[i]);
      const Pose before = in_first(job, *poses[follows ? i - 1 : i]);
      views.push_back({&job.scanners[s], T.inverse(), before.inverse(), line, T.translation(),
                       T * job.scanners[s].other_eye_m(), pass, poses[i]->T_table_room.inverse()});
    }
  }
  return views;
}

Ray ray_to(const CellPoint& spot, const Vec3d& eye) {
  Ray ray;
  const Vec3d start = spot.p + kLift_m * spot.normal;
  ray.origin = start.cast<float>();
  ray.direction = (eye - start).cast<float>();
  ray.t_max = 1.0f;
  return ray;
}

/// Points to be tested, and whether anything of a pass is between each and another point.
class Blocked {
 public:
  explicit Blocked(const CoverageJob& job) : job_(job) {}
  void clear() { rays_.clear(), who.clear(); }
  void ask(std::size_t spot, const Ray& ray) { rays_.push_back(ray), who.push_back(spot); }
  void answer(std::uint32_t pass) {
    if (pass > 0) move(job_.passes[pass].T_first_pass.inverse());
    blocked.resize(rays_.size());
    job_.passes[pass].scene->occluded(rays_, blocked, RayOrder::kCoherent);
  }
  /// The room occludes, too.
  void answer(std::uint32_t pass, const Pose& T_room_pass) {
    answer(pass);
    if (job_.room == nullptr) return;
    move(T_room_pass);
    by_room_.resize(rays_.size());
    job_.room->occluded(rays_, by_room_, RayOrder::kCoherent);
    for (std::size_t k = 0; k < blocked.size(); ++k) blocked[k] |= by_room_[k];
  }
  std::vector<std::size_t> who;
  std::vector<std::uint8_t> blocked;

 private:
  void move(const Pose& T) {
    for (Ray& ray : rays_) {
      ray.origin = (T * ray.origin.cast<double>()).cast<float>();
      ray.direction = (T.linear() * ray.direction.cast<double>()).cast<float>();
    }
  }

  const CoverageJob& job_;
  std::vector<Ray> rays_;
  std::vector<std::uint8_t> by_room_;
};

/// Raises the outcomes to the result of this test.
void test_from(const TestedView& view, std::span<const CellPoint> spots, Blocked& first,
               Blocked& second, std::span<Outcome> outcomes) {
  // The eye from which the rays start is tested first.
  const bool line = view.model->kind == ScannerKind::kLine;
  const Miss own = line ? Miss::kEmitterBlocked : Miss::kReceiverBlocked;
  const Miss others = line ? Miss::kReceiverBlocked : Miss::kEmitterBlocked;
  first.clear(), second.clear();
  for (std::size_t i = 0; i < spots.size(); ++i) {
    if (outcomes[i].stage == Outcome::kSeen) continue;
    if (!(spots[i].normal.dot(view.origin - spots[i].p) > 0.0)) continue;
    const Miss miss = view.in_view(spots[i]);
    if (miss != Miss::kNone)
      outcomes[i].raise(miss);
    else
      first.ask(i, ray_to(spots[i], view.origin));
  }
  first.answer(view.pass, view.T_room_pass);
  for (std::size_t k = 0; k < first.who.size(); ++k) {
    const std::size_t i = first.who[k];
    if (first.blocked[k])
      outcomes[i].raise(Outcome::kFirstEye, own);
    else if (!view.model->two_eyed())
      outcomes[i].raise(Outcome::kSeen, Miss::kNone);
    else if (!(spots[i].normal.dot(view.other - spots[i].p) > 0.0))
      outcomes[i].raise(Outcome::kSecondEye, others);
    else
      second.ask(i, ray_to(spots[i], view.other));
  }
  second.answer(view.pass, view.T_room_pass);
  for (std::size_t k = 0; k < second.who.size(); ++k)
    if (second.blocked[k])
      outcomes[second.who[k]].raise(Outcome::kSecondEye, others);
    else
      outcomes[second.who[k]].raise(Outcome::kSeen, Miss::kNone);
}

/// Points around the table of a pass at the scanners' heights, in the frame of the first; none
/// without a pose.
std::vector<Vec3d> places_around(const CoverageJob& job, std::uint32_t pass) {
  double low = 1e300, high = -1e300, radius = 0.0;
  for (const CoveragePose& pose : job.poses) {
    if (pose.pass != pass) continue;
    const Vec3d p = pose.T_table_sensor.translation();
    low = std::min(low, p.y());
    high = std::max(high, p.y());
    radius = std::max(radius, std::hypot(p.x(), p.z()));
  }
  if (low > high) return {};
  const int heights = static_cast<int>(
      std::clamp(1.0 + std::ceil((high - low) / kHeightStep_m), 1.0, double(kMaxHeights)));
  std::vector<Vec3d> places;
  for (int h = 0; h < heights; ++h) {
    for (int d = 0; d < kDirections; ++d) {
      const double angle = kTurn * d / kDirections;
      const double y = heights > 1 ? low + (high - low) * h / (heights - 1) : low;
      const Vec3d p(radius * std::sin(angle), y, radius * std::cos(angle));
      places.push_back(pass == 0 ? p : job.passes[pass].T_first_pass * p);
    }
  }
  return places;
}

/// Marks in `reached` the spots that are visible from any of the points.
void reach(const CoverageJob& job, std::uint32_t pass, std::span<const Vec3d> places,
           double least_cosine, std::span<const CellPoint> spots, std::span<std::uint8_t> reached) {
  Blocked rays(job);
  for (const Vec3d& place : places) {
    rays.clear();
    for (std::size_t i = 0; i < spots.size(); ++i) {
      if (reached[i]) continue;
      if (spots[i].normal.dot((place - spots[i].p).normalized()) > least_cosine)
        rays.ask(i, ray_to(spots[i], place));
    }
    rays.answer(pass);
    for (std::size_t k = 0; k < rays.who.size(); ++k)
      if (!rays.blocked[k]) reached[rays.who[k]] = 1;
  }
}

std::vector<CellPoint> empty_cells(const CoveragePatches& surface) {
  std::vector<CellPoint> spots;
  for (std::uint32_t c = 0; c < surface.cells.size(); ++c) {
    if (surface.cells[c].samples > 0) continue;
    const CoveragePatch& patch = surface.patches[surface.largest[c]];
    const Vec3f middle = (patch.corners[0] + patch.corners[1] + patch.corners[2]) / 3.0f;
    spots.push_back(
        {c, middle.cast<double>(), surface.normal(patch.object, patch.face).cast<double>()});
  }
  return spots;
}

void judge(CoverageCell& cell, Miss reason, bool reached, bool noise) {
  cell.reason = reason == Miss::kNone && noise ? Miss::kTooDark : reason;
  if (cell.reason == Miss::kNone)
    cell.state = CoverageState::kThin;
  else
    cell.state = reached ? CoverageState::kMissed : CoverageState::kUnreachable;
  // If none of the frames on its side sees it, or none at all, the object itself is in the way.
  if (cell.reason == Miss::kNothing) cell.reason = Miss::kReceiverBlocked;
}

}  // namespace

Result<> explain_cells(const CoverageJob& job, CoveragePatches& surface,
                       const RunContext& context) {
  for (CoverageCell& cell : surface.cells)
    cell.state = cell.density_per_mm2() < job.options.thin_per_mm2 ? CoverageState::kThin
                                                                   : CoverageState::kCovered;
  const std::vector<CellPoint> spots = empty_cells(surface);
  const std::vector<TestedView> views = tested_views(job);
  std::vector<std::vector<Vec3d>> places;
  for (std::uint32_t pass = 0; pass < job.passes.size(); ++pass)
    places.push_back(places_around(job, pass));
  double flattest = 0.0;
  for (const ScannerModel& model : job.scanners)
    flattest = std::max(flattest, model.max_incidence_rad);
  context.begin_phase("reasons", spots.size());
  parallel_for((spots.size() + kCellsPerTask - 1) / kCellsPerTask, 1, [&](std::size_t chunk) {
    const std::size_t begin = chunk * kCellsPerTask,
                      n = std::min(kCellsPerTask, spots.size() - begin);
    const auto mine = std::span(spots).subspan(begin, n);
    std::vector<Outcome> outcomes(n);
    std::vector<std::uint8_t> reached(n, 0);
    Blocked first(job), second(job);
    for (const TestedView& view : views) {
      if (context.cancelled()) return;
      test_from(view, mine, first, second, outcomes);
    }
    for (std::uint32_t pass = 0; pass < job.passes.size(); ++pass)
      reach(job, pass, places[pass], std::cos(flattest), mine, reached);
    for (std::size_t i = 0; i < n; ++i)
      judge(surface.cells[mine[i].cell], outcomes[i].miss, reached[i] != 0, job.options.noise);
    context.advance(n);
  });
  return context.check();
}

}  // namespace turnscan::coverage
