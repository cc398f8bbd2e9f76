#include <algorithm>
#include <turnscan/core/figure_text.hpp>
#include <turnscan/reconstruction/points/base.hpp>
#include <turnscan/reconstruction/points/components.hpp>
#include <turnscan/reconstruction/points/normals.hpp>
#include <turnscan/reconstruction/points/point_stages.hpp>
#include <turnscan/reconstruction/points/refine.hpp>
#include <turnscan/reconstruction/poisson/poisson.hpp>
#include <turnscan/reconstruction/stage_timer.hpp>
#include <turnscan/reconstruction/surface/concave_hull.hpp>
#include <turnscan/reconstruction/surface/surface_repair.hpp>

namespace turnscan::points {

namespace {

/// The stages in their order, with shared members.
class PointStages {
 public:
  PointStages(const voxels::MeasuredCells& measurements, double spacing_m,
              const std::optional<Cylinder>& cylinder, const ReconstructOptions& options,
              const StageSink& sink, const RunContext& context, Reconstruction& out)
      : measurements_(measurements),
        spacing_m_(spacing_m),
        cylinder_(cylinder),
        options_(options),
        sink_(sink),
        context_(context),
        out_(out),
        grid_(measurements.grid) {}

  Result<> operator()() {
    TURNSCAN_TRY(timed("voxels", [&] { return choose_voxels(); }));
    TURNSCAN_TRY(timed("candidates", [&] { return choose_candidates(); }));
    TURNSCAN_TRY(timed("normals", [&] { return orient(); }));
    TURNSCAN_TRY(timed("refine", [&] { return refine(); }));
    TURNSCAN_TRY(timed("base", [&] { return split_objects(); }));
    return timed("surface", [&] { return build_surfaces(); });
  }

 private:
  template <class Stage>
  Result<> timed(const char* name, const Stage& stage) {
    const StageTimer timer(out_.stages, name);
    TURNSCAN_TRY(stage());
    return context_.check();
  }

  void choose(const std::string& option, const std::string& value, const std::string& reason) {
    out_.choices.push_back({option, value, reason, -1});
  }
  template <class T>
  double length_or(const std::optional<T>& given, const char* option, double automatic,
                   const std::string& reason) {
    const double value = given.value_or(automatic);
    choose(option, length_text(value), given ? "given" : reason);
    return value;
  }
  Result<> save(const std::string& stage, const PointCloud& cloud) {
    return sink_ ? sink_(stage, cloud) : Result<>();
  }

  Result<> choose_voxels();
  Result<> choose_candidates();
  Result<> orient();
  Result<> refine();
  Result<> split_objects();
  Result<> build_surfaces();
  Result<ObjectResult> build_surface(const PointCloud& object, std::size_t measured);

  const voxels::MeasuredCells& measurements_;
  double spacing_m_;
  std::optional<Cylinder> cylinder_;
  const ReconstructOptions& options_;
  const StageSink& sink_;
  const RunContext& context_;
  Reconstruction& out_;
  voxels::VoxelGrid grid_;  ///< the remaining voxels of the measurements
  Components components_;
  Candidates candidates_;
  std::vector<PointCloud> objects_;    ///< oriented points, with base
  std::vector<std::size_t> measured_;  ///< number of points in these that are measured, which
                                       ///< precede those of the base
};

Result<> PointStages::choose_voxels() {
  const double size = grid_.size_m();
  out_.voxel_size_m = size;
  context_.begin_phase("voxels", 2);
  const voxels::ThresholdChoice threshold = choose_min_points(grid_);
  const int m = options_.voxels.min_points.value_or(threshold.min_points);
  choose("voxel-min-points", std::to_string(m),
         options_.voxels.min_points
             ? "given"
             : fmt::format("a tenth of the typical count {:.0f}", threshold.typical_count));
  grid_.filter(voxels::count_filter(grid_, m));
  context_.advance();
  if (grid_.voxels().empty())
    return fail(ErrorCode::kTooFewPoints,
                "no voxel has {} points (typical are {:.0f}); lower --voxel-min-points", m,
                threshold.typical_count);
  const double gap =
      length_or(options_.components.gap_m, "object-gap", std::max(3.0 * size, 4.0 * spacing_m_),
                "the larger of 3 voxels and 4 times the cloud's spacing");
  // Without a gap only neighbouring voxels are one object: nothing that floats is joined either.
  std::optional<double> floor;
  if (cylinder_ && gap > 0.0) floor = cylinder_->margin_m + std::max(3.0 * size, gap);
  TURNSCAN_ASSIGN(components_, find_components(grid_, options_.components,
                                               static_cast<int>(std::lround(gap / size)), floor));
  context_.advance();
  std::vector<std::uint8_t> in_object;
  for (std::int32_t label : components_.label) in_object.push_back(label >= 0 ? 1 : 0);
  grid_.filter(in_object);
  std::erase(components_.label, -1);
  if (components_.crumbs > 0)
    out_.notes.push_back(fmt::format("{} small pieces were dropped", components_.crumbs));
  if (components_.joined > 0)
    out_.notes.push_back(fmt::format(
        "pieces above the platter were joined to what stands below them: {}", components_.joined));
  PointCloud centers;
  for (const voxels::VoxelGrid::Voxel& voxel : grid_.voxels()) {
    centers.points.push_back(grid_.center(voxel).cast<float>());
    centers.weights.push_back(static_cast<float>(voxel.count()));
  }
  return save("voxels", centers);
}

Result<> PointStages::choose_candidates() {
  TURNSCAN_ASSIGN(candidates_, find_candidates(measurements_, grid_, context_));
  out_.objects.resize(components_.voxel_count.size());
  for (std::uint32_t voxel : candidates_.voxel)
    ++out_.objects[std::size_t(components_.label[voxel])].candidates;
  for (std::size_t v = 0; v < grid_.voxels().size(); ++v)
    out_.objects[std::size_t(components_.label[v])].points += grid_.voxels()[v].count();
  return save("candidates", candidates_.cloud);
}

Result<> PointStages::orient() {
  const double radius = length_or(options_.normals.radius_m, "normal-radius",
                                  std::max(2.5 * grid_.size_m(), 3.0 * out_.merged_noise_m),
                                  "the larger of 2.5 voxels and 3 times the cloud's thickness");
  return estimate_normals(candidates_, radius, context_);
}

Result<> PointStages::refine() {
  if (!options_.refine.enabled) return save("refined", candidates_.cloud);
  // Enough measurements under the weight for the fitted height to be accurate to a tenth of the
  // noise (a height field of degree 2 has about twice the mean's standard deviation).
  const double size = grid_.size_m(), noise = out_.merged_noise_m;
  const double target = std::max(0.1 * noise, 0.05 * size);
  const double wanted = spacing_m_ * (2.0 * noise / target) / std::sqrt(4.0 * EIGEN_PI);
  const double radius = length_or(
      options_.refine.radius_m, "refine-radius", std::clamp(wanted, 0.75 * size, 3.0 * size),
      fmt::format("so that a fitted height is good to {}", length_text(target)));
  TURNSCAN_ASSIGN(candidates_, refine_candidates(measurements_, grid_, candidates_, {radius, noise},
                                                 options_.refine.iterations, context_));
  return save("refined", candidates_.cloud);
}

Result<> PointStages::split_objects() {
  objects_.resize(components_.voxel_count.size());
  const bool colored = options_.color && !candidates_.cloud.colors.empty();
  for (std::size_t i = 0; i < candidates_.cloud.size(); ++i) {
    PointCloud& object = objects_[std::size_t(components_.label[candidates_.voxel[i]])];
    object.points.push_back(candidates_.cloud.points[i]);
    object.normals.push_back(candidates_.cloud.normals[i]);
    object.weights.push_back(candidates_.cloud.weights[i]);
    if (colored) object.colors.push_back(candidates_.cloud.colors[i]);
  }
  PointCloud all;
  for (std::size_t o = 0; o < objects_.size(); ++o) {
    PointCloud& object = objects_[o];
    measured_.push_back(object.size());
    if (options_.base.enabled && cylinder_) {
      const double reach = cylinder_->margin_m + 3.0 * grid_.size_m();
      const BaseResult base = close_base(object, grid_.size_m(), reach);
      object.points.insert(object.points.end(), base.added.points.begin(), base.added.points.end());
      object.normals.insert(object.normals.end(), base.added.normals.begin(),
                            base.added.normals.end());
      object.weights.insert(object.weights.end(), base.added.weights.begin(),
                            base.added.weights.end());
      if (colored)
        object.colors.insert(object.colors.end(), base.added.colors.begin(),
                             base.added.colors.end());
      if (!base.added.empty())
        out_.objects[o].notes.push_back(
            fmt::format("its base was closed on the platter over {:.1f} cm^2", base.area_m2 * 1e4));
    }
    all.points.insert(all.points.end(), object.points.begin(), object.points.end());
    all.normals.insert(all.normals.end(), object.normals.begin(), object.normals.end());
    if (colored) all.colors.insert(all.colors.end(), object.colors.begin(), object.colors.end());
    out_.objects[o].surface_points = object.size();
  }
  return save("oriented", all);
}

Result<ObjectResult> PointStages::build_surface(const PointCloud& object, std::size_t measured) {
  ObjectResult result;
  surface::RepairedMesh repaired;
  const double reach = std::max(3.0 * grid_.size_m(), 1.5 * out_.frame_spacing_m);
  // A requested gap may join parts that no surface connects.
  const auto parts = options_.components.gap_m ? surface::Parts::kAll : surface::Parts::kMain;
  if (options_.surface.method == SurfaceMethod::kPoisson) {
    TURNSCAN_ASSIGN(TriangleMesh raw, poisson::poisson_surface(object, options_.surface, context_));
    if (options_.surface.repair) {
      TURNSCAN_ASSIGN(repaired, surface::repair_poisson(raw, object, reach, parts, context_));
    } else {
      repaired.mesh = std::move(raw);
    }
  } else {
    const double alpha = options_.surface.alpha_m.value_or(2.5 * grid_.size_m());
    choose("alpha", length_text(alpha), options_.surface.alpha_m ? "given" : "2.5 voxels");
    TURNSCAN_ASSIGN(TriangleMesh raw, surface::concave_hull(object, alpha, context_));
    if (options_.surface.repair) {
      TURNSCAN_ASSIGN(repaired, surface::repair_concave_hull(raw, object, 0.8 * grid_.size_m(),
                                                             reach, parts, context_));
    } else {
      repaired.mesh = std::move(raw);
      repaired.notes.push_back("a concave hull is not 2-manifold by nature; repair is off");
    }
  }
  if (!options_.surface.repair) repaired.check = check_mesh(repaired.mesh);
  surface::mark_base(repaired, object, measured);
  if (options_.color) surface::color_vertices(repaired.mesh, object);
  result.mesh = std::move(repaired.mesh);
  result.check = repaired.check;
  result.evidence = std::move(repaired.evidence);
  result.invented_area_m2 = repaired.invented_area_m2;
  result.notes = std::move(repaired.notes);
  return result;
}

Result<> PointStages::build_surfaces() {
  context_.begin_phase("surface", objects_.size());
  for (std::size_t o = 0; o < objects_.size(); ++o) {
    auto built = build_surface(objects_[o], measured_[o]);
    if (!built && built.error().code == ErrorCode::kCancelled)
      return tl::unexpected<Error>(built.error());
    if (!built) return fail(built.error().code, "object {}: {}", o + 1, built.error().message);
    ObjectResult& result = out_.objects[o];
    built->points = result.points;
    built->candidates = result.candidates;
    built->surface_points = result.surface_points;
    built->notes.insert(built->notes.begin(), result.notes.begin(), result.notes.end());
    result = std::move(*built);
    result.mesh.name = fmt::format("object {}", o + 1);
    context_.advance();
  }
  return {};
}

}  // namespace

Result<> reconstruct_points(const voxels::MeasuredCells& measurements, double spacing_m,
                            const std::optional<Cylinder>& cylinder,
                            const ReconstructOptions& options, const StageSink& sink,
                            const RunContext& context, Reconstruction& out) {
  return PointStages(measurements, spacing_m, cylinder, options, sink, context, out)();
}

}  // namespace turnscan::points
