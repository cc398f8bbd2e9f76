#include <algorithm>
#include <numeric>
#include <turnscan/geometry/mesh/cut_handles.hpp>
#include <turnscan/geometry/mesh/merge_clustered_vertices.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/reconstruction/estimation/sensor_filter.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_color.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_creases.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_sharpen.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_untangle.hpp>
#include <turnscan/reconstruction/mesh_refinement/plate_closing.hpp>
#include <turnscan/reconstruction/quality/hollow.hpp>
#include <turnscan/reconstruction/stage_timer.hpp>
#include <turnscan/reconstruction/tsdf/measured_points.hpp>
#include <turnscan/reconstruction/tsdf/object_grouping.hpp>
#include <turnscan/reconstruction/tsdf/piece_measures.hpp>
#include <turnscan/reconstruction/tsdf/surface_extraction.hpp>
#include <turnscan/reconstruction/tsdf/volumetric.hpp>

namespace turnscan::tsdf {

namespace {

constexpr std::size_t kSampledViews = 64;
constexpr double kPlatterCells = 0.5;  ///< vertices below this height above a platter's plane are
                                       ///< on it
/// Relative to the best measured piece, per vertex: static clutter has 0.02 to 0.04.
constexpr double kMinSupport = 0.08;
constexpr double kLongestLoopCells = 16.0;  ///< around an unmeasured handle
/// A hollow whose floor no ray reaches ends about this many pixel spacings too early: free space
/// ends two pixels beside its rim.
constexpr double kFloorSpacings = 3.0;
constexpr double kMinSection_m = 0.0005;  ///< between the sections in the search for a neck

using mesh_refinement::MeshFit;
using mesh_refinement::MeshFitScale;

/// Converts the surface's components to refined, measured pieces.
class VolumetricReconstruction {
 public:
  VolumetricReconstruction(const VolumetricInput& input, const VolumetricScale& scale,
                           const VolumetricOptions& options, const RunContext& context)
      : input_(input),
        scale_(scale),
        options_(options),
        context_(context),
        filter_share_(input.filter_share) {}

  Result<VolumetricResult> run(const Integrator& integrator, double min_share) {
    const Box box = measured_box(input_);
    if (box.empty())
      return fail(ErrorCode::kTooFewPoints, "volumetric: no frame has a point on the object");
    TURNSCAN_ASSIGN(
        ExtractedSurface surface,
        extract_surface(integrator, scale_.volume, input_.views, box, out_.stages, context_));
    TURNSCAN_ASSIGN(std::vector<TriangleMesh> components, split_components(surface.mesh));
    surface.mesh = {};  // frees memory: it is as large as everything else
    for (auto& object : group_objects(std::move(components), grouping_rules(min_share)))
      TURNSCAN_TRY(refine(std::move(object), surface));
    for (VolumetricPiece& piece : out_.pieces) {
      TURNSCAN_TRY(color(piece));
      TURNSCAN_TRY(measure(piece, surface.foot.floors));
    }
    leave_out_unmeasured();
    if (out_.pieces.empty())
      return fail(ErrorCode::kTooFewPoints,
                  "volumetric: the frames show no surface: where one sees something, others see "
                  "past it; check the turntable's pose and the angles");
    out_.filter_share = filter_share_.value_or(0.0);
    return std::move(out_);
  }

 private:
  template <class Stage>
  auto timed(const char* name, const Stage& stage) {
    return turnscan::timed(out_.stages, name, stage);
  }

  GroupingRules grouping_rules(double min_share) const {
    const VolumeScale& volume = scale_.volume;
    GroupingRules rules;
    rules.min_share = min_share;
    rules.keep = std::size_t(input_.keep);
    rules.gap_m = input_.gap_m;
    if (volume.floor_m)
      rules.detached_above_m = *volume.floor_m + volume.truncation_m + volume.cell_m;
    else if (!volume.platters.empty() && volume.platters[0].up == Vec3d::UnitY())
      rules.detached_above_m = volume.platters[0].offset_m + volume.truncation_m + volume.cell_m;
    return rules;
  }

  /// Regularises and fits the components of an object, and combines them into a piece.
  Result<> refine(ObjectComponents object, const ExtractedSurface& surface) {
    VolumetricPiece piece;
    std::vector<TriangleMesh> refined;
    for (TriangleMesh& component : object.components) {
      TURNSCAN_ASSIGN(const TriangleMesh even, timed("even out", [&] {
                        return merge_clustered_vertices(std::move(component), surface.grid,
                                                        context_);
                      }));
      const double share = filter_share(even);
      TURNSCAN_ASSIGN(MeshFit fitted, timed("fit", [&] {
                        return fit_mesh(even, input_.views, fit_scale(surface), context_);
                      }));
      if (options_.sharpen && share > 0.0)
        TURNSCAN_TRY(timed("sharpen", [&] {
          return sharpen_mesh(fitted.mesh, input_.views, share, fit_scale(surface), context_);
        }));
      if (options_.fit)
        TURNSCAN_TRY(timed("creases", [&] {
          return mesh_refinement::straighten_creases(fitted.mesh, fitted.support, context_);
        }));
      // Behind thin parts a filtering sensor mixes the depths of both sides.
      TURNSCAN_TRY(timed("untangle", [&] {
        return mesh_refinement::untangle(fitted.mesh, even.vertices, {}, context_);
      }));
      if (options_.fit && !input_.measured_only) {
        TURNSCAN_TRY(timed("handles", [&] { return cut_unseen_handles(fitted); }));
        TURNSCAN_TRY(timed("unseen", [&] { return close_unseen(fitted, surface); }));
      }
      if (!encloses_volume(fitted.mesh)) continue;
      if (!piece.noise_share) piece.noise_share = fitted.noise_share;
      piece.support.insert(piece.support.end(), fitted.support.begin(), fitted.support.end());
      refined.push_back(std::move(fitted.mesh));
    }
    if (refined.empty()) return {};
    piece.detached = std::min(object.detached, refined.size() - 1);
    piece.mesh = refined.size() == 1 ? std::move(refined[0]) : join_meshes(refined);
    out_.pieces.push_back(std::move(piece));
    return {};
  }

  /// Removes pieces that views hardly measured: objects around the table, which do not turn with
  /// it, are at each position only once.
  void leave_out_unmeasured() {
    double best = 0.0;
    for (const VolumetricPiece& piece : out_.pieces) best = std::max(best, mean_support(piece));
    const std::size_t all = out_.pieces.size();
    std::erase_if(out_.pieces, [&](const VolumetricPiece& piece) {
      return piece.points == 0 || mean_support(piece) < kMinSupport * best;
    });
    out_.left_out = all - out_.pieces.size();
  }

  static double mean_support(const VolumetricPiece& piece) {
    return std::accumulate(piece.support.begin(), piece.support.end(), 0.0) /
           double(piece.support.size());
  }

  /// mesh: the first one, used if the views alone do not determine the share.
  double filter_share(const TriangleMesh& mesh) {
    if (!filter_share_)
      timed("sensor filter", [&] {
        filter_share_ = estimation::share_of_neighbours(input_.views, mesh, input_.noise_m);
      });
    return *filter_share_;
  }

  /// Removes handles and tunnels that no measurement supports.
  Result<> cut_unseen_handles(MeshFit& fitted) const {
    TURNSCAN_TRY(cut_handles(fitted.mesh, mesh_refinement::unseen_vertices(fitted.support),
                             kLongestLoopCells * scale_.volume.cell_m, context_));
    fitted.support.resize(fitted.mesh.vertices.size(), 0.0f);
    return {};
  }

  Result<> close_unseen(MeshFit& fitted, const ExtractedSurface& surface) const {
    mesh_refinement::PlateClosing closing;
    closing.unseen = [&](const Vec3f& p) { return surface.unseen.contains(p); };
    closing.cell_m = scale_.volume.cell_m;
    if (scale_.volume.floor_m)
      closing.rests_below_m = *scale_.volume.floor_m + scale_.volume.truncation_m;
    closing.stands = [&](const Vec3f& p) {
      const VolumeScale& volume = scale_.volume;
      if (volume.floor_m)
        return double(p.y()) < *volume.floor_m && (p.y() < 0.0f || !surface.foot.round.contains(p));
      return below_platters(volume.platters, p.cast<double>()) > -kPlatterCells * volume.cell_m;
    };
    return mesh_refinement::close_as_plate(fitted.mesh, fitted.support, closing, context_);
  }

  Result<> color(VolumetricPiece& piece) {
    if (!input_.colored) return {};
    const double tolerance = 3.0 * input_.noise_m + 2.0 * scale_.volume.cell_m;
    TURNSCAN_TRY(timed("colour", [&] {
      return mesh_refinement::color_from_views(piece.mesh, input_.views, tolerance, context_);
    }));
    return {};
  }

  /// Sets quality, unmeasured areas, and the number of points.
  Result<> measure(VolumetricPiece& piece, const MeasuredFloors& floors) {
    measure_confidence(piece);
    const auto quality = [&]() -> Result<> {
      measure_evidence(piece, scale_.volume, floors);
      if (input_.measured_only) return {};
      if (scale_.volume.floor_m)
        piece.neck = quality::narrowest_neck(
            piece.mesh, std::max(scale_.volume.cell_m, kMinSection_m), *scale_.volume.floor_m);
      TURNSCAN_TRY(measure_quality(piece, input_, scale_, filter_share_ > 0.0, context_));
      piece.unknown_volume_m3 = quality::unknown_volume_m3(piece.mesh, piece.evidence, input_.views,
                                                           kFloorSpacings * input_.spacing_m);
      return measure_no_return(piece, input_.views, context_);
    };
    TURNSCAN_TRY(timed("quality", quality));
    if (options_.mark_invented) mesh_refinement::paint_invented(piece.mesh, piece.evidence);
    Box box = bounds(piece.mesh.vertices);
    box.min.array() -= scale_.volume.truncation_m;
    box.max.array() += scale_.volume.truncation_m;
    piece.points = count_points(input_, box);
    return {};
  }

  MeshFitScale fit_scale(const ExtractedSurface& surface) const {
    const VolumeScale& volume = scale_.volume;
    MeshFitScale scale;
    scale.noise_m = input_.noise_m;
    scale.reach_m = scale_.fit_reach_m;
    scale.floor_m = 0.1 * input_.noise_m + 0.1 * volume.cell_m;
    scale.limit_m = 2.0 * volume.cell_m;
    scale.fair_m = 4.0 * volume.cell_m;
    // Without a filter that spreads steps, the pixels beside them measure like others.
    if (!(filter_share_ > 0.0)) scale.edge_weight = 1.0f;
    scale.iterations = options_.fit ? options_.fit_iterations : 0;
    if (volume.floor_m) scale.floor_height_m = *volume.floor_m;
    if (!surface.foot.floors.none())
      scale.measured_below = [&surface](const Vec3f& p) { return surface.foot.floors.contains(p); };
    return scale;
  }

  const VolumetricInput& input_;
  const VolumetricScale& scale_;
  const VolumetricOptions& options_;
  const RunContext& context_;
  std::optional<double> filter_share_;
  VolumetricResult out_;
};

}  // namespace

voxels::MergedCloud sample_points(const VolumetricInput& input) {
  voxels::MergedCloud out;
  const std::size_t stride =
      view_stride(input.views.size(), views::views_for_statistics(input.views, kSampledViews));
  for (std::size_t v = 0; v < input.views.size(); v += stride) {
    for_each_point(input.views[v], input.cylinder,
                   [&](const Vec3f& p) { out.cloud.points.push_back(p); });
    out.cloud.frame.resize(out.cloud.size(), std::uint32_t(out.viewpoints.size()));
    out.viewpoints.push_back(input.views[v].viewpoint());
  }
  return out;
}

Box measured_box(const VolumetricInput& input) {
  return measured_box(input.views, input.cylinder, kSampledViews);
}

Result<VolumetricResult> reconstruct_volume(const VolumetricInput& input,
                                            const VolumetricScale& scale,
                                            const Integrator& integrator,
                                            const VolumetricOptions& options, double min_share,
                                            const RunContext& context) {
  return VolumetricReconstruction(input, scale, options, context).run(integrator, min_share);
}

}  // namespace turnscan::tsdf
