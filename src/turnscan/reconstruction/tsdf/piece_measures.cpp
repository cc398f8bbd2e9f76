#include <algorithm>
#include <numeric>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/mesh_measure.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_fit.hpp>
#include <turnscan/reconstruction/quality/expected_error.hpp>
#include <turnscan/reconstruction/quality/vertex_visibility.hpp>
#include <turnscan/reconstruction/tsdf/measured_points.hpp>
#include <turnscan/reconstruction/tsdf/piece_measures.hpp>

namespace turnscan::tsdf {

namespace {

/// Smaller invented surface without a return is not worth a note: rims have some.
constexpr double kMinNoReturn_m2 = 3e-4;
/// Whether vertices that no pass saw are in the plane of a platter.
bool on_platter(const std::vector<Vec3f>& p, const std::array<std::uint32_t, 3>& t,
                const VolumeScale& scale) {
  return std::any_of(scale.platters.begin(), scale.platters.end(), [&](const Platter& platter) {
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
      return std::abs(platter.above(p[v].cast<double>())) < 0.1 * scale.cell_m;
    });
  });
}

}  // namespace

void measure_confidence(VolumetricPiece& piece) {
  const float typical = mesh_refinement::typical_support(piece.support);
  for (const float s : piece.support) piece.confidence.push_back(std::min(1.0f, s / typical));
}

Result<> measure_quality(VolumetricPiece& piece, const VolumetricInput& input,
                         const VolumetricScale& scale, bool filtered, const RunContext& context) {
  const double tolerance_m = 3.0 * input.noise_m + scale.volume.cell_m;
  TURNSCAN_ASSIGN(const auto seen,
                  quality::vertex_visibility(piece.mesh, input.views, tolerance_m, context));
  const auto expected = quality::expected_errors(
      piece.mesh, piece.support,
      {input.noise_m, input.spacing_m, scale.volume.cell_m, filtered, piece.noise_share});
  piece.quality.resize(expected.size());
  for (std::size_t v = 0; v < expected.size(); ++v)
    piece.quality[v] = {expected[v], seen.frames[v], seen.directions[v]};
  return {};
}

void measure_evidence(VolumetricPiece& piece, const VolumeScale& scale,
                      const MeasuredFloors& floors) {
  const auto& p = piece.mesh.vertices;
  const float base = scale.floor_m ? float(*scale.floor_m) : -1e30f;
  piece.evidence.assign(piece.mesh.triangles.size(), Evidence::kMeasured);
  for (std::size_t i = 0; i < piece.evidence.size(); ++i) {
    const auto& t = piece.mesh.triangles[i];
    const double area = triangle_area(piece.mesh, i);
    const float low = std::min({p[t[0]].y(), p[t[1]].y(), p[t[2]].y()});
    const float high = std::max({p[t[0]].y(), p[t[1]].y(), p[t[2]].y()});
    const auto on_floor = [&](std::uint32_t v) { return floors.contains(p[v]); };
    if (high < base && high - low < 0.1f * float(scale.cell_m) &&
        !std::all_of(t.begin(), t.end(), on_floor)) {
      piece.evidence[i] = Evidence::kBase;
      piece.base_area_m2 += area;
    } else if (std::any_of(t.begin(), t.end(), [&](std::uint32_t v) {
                 return piece.confidence[v] < mesh_refinement::kMeasuredShare;
               })) {
      const bool flat = on_platter(p, t, scale);
      piece.evidence[i] = flat ? Evidence::kBase : Evidence::kInvented;
      (flat ? piece.base_area_m2 : piece.invented_area_m2) += area;
    }
  }
}

Result<> measure_no_return(VolumetricPiece& piece, std::span<const views::DepthView> views,
                           const RunContext& context) {
  const auto& triangles = piece.mesh.triangles;
  std::vector<std::uint8_t> asked(piece.mesh.vertices.size(), 0);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (piece.evidence[i] == Evidence::kInvented)
      for (const std::uint32_t v : triangles[i]) asked[v] = 1;
  TURNSCAN_ASSIGN(const std::vector<quality::NoReturn> no_return,
                  quality::without_return(piece.mesh, views, asked, context));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& t = triangles[i];
    if (piece.evidence[i] != Evidence::kInvented) continue;
    const auto corners = [&](const auto& counts) {
      return std::count_if(t.begin(), t.end(), counts);
    };
    const double area = triangle_area(piece.mesh, i);
    if (corners([&](auto v) { return no_return[v] != quality::NoReturn::kNone; }) > 1)
      piece.no_return_area_m2 += area;
    if (corners([&](auto v) { return no_return[v] == quality::NoReturn::kTooNear; }) > 1)
      piece.too_near_area_m2 += area;
  }
  piece.nearest_m = quality::nearest_depth_m(views);
  return {};
}

std::size_t count_points(const VolumetricInput& input, const Box& box) {
  std::vector<std::size_t> counts(input.views.size(), 0);
  parallel_for(counts.size(), 4, [&](std::size_t v) {
    for_each_point(input.views[v], input.cylinder, [&](const Vec3f& p) {
      const auto q = p.cast<double>().array();
      if ((q >= box.min.array()).all() && (q <= box.max.array()).all()) ++counts[v];
    });
  });
  return std::accumulate(counts.begin(), counts.end(), std::size_t(0));
}

ObjectResult object_of(VolumetricPiece& piece, bool color_wanted) {
  ObjectResult object;
  object.mesh = std::move(piece.mesh);
  object.check = check_mesh(object.mesh);
  object.points = piece.points;
  object.invented_area_m2 = piece.invented_area_m2;
  object.confidence = std::move(piece.confidence);
  object.quality = std::move(piece.quality);
  object.evidence = std::move(piece.evidence);
  object.unknown_volume_m3 = piece.unknown_volume_m3;
  if (color_wanted && object.mesh.colors.empty())
    object.notes.emplace_back("the recording has no colour");
  if (piece.base_area_m2 > 0.0)
    object.notes.push_back(fmt::format("its base was closed on the platter over {:.1f} cm^2",
                                       piece.base_area_m2 * 1e4));
  if (piece.no_return_area_m2 >= kMinNoReturn_m2) {
    object.no_return_area_m2 = piece.no_return_area_m2;
    object.too_near = piece.too_near_area_m2 > 0.5 * piece.no_return_area_m2;
    object.notes.push_back(fmt::format(
        "{:.1f} cm^2 of its invented surface face sensors that got no return from "
        "there: {}it may be too dark, too shiny or transparent",
        piece.no_return_area_m2 * 1e4,
        object.too_near ? fmt::format("it is nearer than {:.3g} m, nearer than anything that was "
                                      "measured: the sensor stands too near, or ",
                                      piece.nearest_m)
                        : ""));
  }
  if (piece.neck)
    object.notes.push_back(
        fmt::format("it may be two objects that touch: at x {:.0f} mm, z {:.0f} mm its section is "
                    "{:.1f} cm^2, {:.0f} % of those on either side, and each side stands by "
                    "itself; move them apart to get a mesh of each",
                    piece.neck->place.x() * 1e3, piece.neck->place.z() * 1e3,
                    piece.neck->area_m2 * 1e4, piece.neck->share * 100.0));
  if (piece.detached > 0)
    object.notes.push_back(fmt::format(
        "{} part{} of it hang{} in the air: no frame shows what "
        "connects them to the rest",
        piece.detached, piece.detached == 1 ? "" : "s", piece.detached == 1 ? "s" : ""));
  return object;
}

}  // namespace turnscan::tsdf
