#include <algorithm>
#include <chrono>
#include <limits>
#include <numeric>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/closest_point.hpp>
#include <turnscan/geometry/even_out.hpp>
#include <turnscan/geometry/isosurface.hpp>
#include <turnscan/geometry/mesh_measure.hpp>
#include <turnscan/geometry/mesh_repair.hpp>
#include <turnscan/geometry/simplify.hpp>
#include <turnscan/reconstruction/floating.hpp>
#include <turnscan/reconstruction/mesh_color.hpp>
#include <turnscan/reconstruction/mesh_sharpen.hpp>
#include <turnscan/reconstruction/volumetric.hpp>

namespace turnscan {

namespace {

using Clock = std::chrono::steady_clock;

/// Calls take(p_table) for what a view measured, edges left out.
template <class Take>
void for_each_point_inside(const VolumetricInput& input, const DepthView& view, const Take& take) {
  for_each_point(view, [&](const Vec3f& p) {
    if (!input.cylinder || input.cylinder->contains(p.cast<double>())) take(p);
  });
}

/// For about most_views of the views.
template <class Take>
void for_each_point_inside(const VolumetricInput& input, std::size_t most_views, const Take& take) {
  const std::size_t step = std::max<std::size_t>(1, input.views.size() / most_views);
  for (std::size_t v = 0; v < input.views.size(); v += step)
    for_each_point_inside(input, input.views[v], take);
}

/// Such pieces are no objects: holes within others, which few frames leave and nobody sees or
/// prints, and crumbs of a voxel or two, which are folded already or fold where they are fitted.
bool encloses_nothing(const TriangleMesh& piece) { return signed_volume(piece) <= 0.0; }

constexpr std::size_t kNotKept = std::numeric_limits<std::size_t>::max();
constexpr float kInvented = 0.02f;  // less confidence than this means that nobody saw it

class Run {
 public:
  Run(const VolumetricInput& input, const VolumetricScale& scale, const FieldSums& sums,
      const VolumetricOptions& options, double min_share, const RunContext& context)
      : input_(input),
        scale_(scale.volume),
        fit_reach_(scale.fit_reach_m),
        sums_(sums),
        options_(options),
        min_share_(min_share),
        context_(context) {}

  template <class Stage>
  auto timed(const char* name, const Stage& stage) {
    const auto start = Clock::now();
    auto result = stage();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    const auto same = std::find_if(out_.seconds.begin(), out_.seconds.end(),
                                   [&](const auto& done) { return done.first == name; });
    if (same == out_.seconds.end())
      out_.seconds.emplace_back(name, seconds);
    else
      same->second += seconds;
    return result;
  }

  Result<VolumetricResult> operator()() {
    Box box = measured_box(input_);
    if (box.empty())
      return fail(ErrorCode::kTooFewPoints, "volumetric: no frame has a point on the object");
    TURNSCAN_ASSIGN(TriangleMesh mesh, surface(box));
    TURNSCAN_ASSIGN(auto pieces, split_components(mesh));
    keep_pieces(std::move(pieces));
    for (std::vector<TriangleMesh>& object : objects_) TURNSCAN_TRY(fit(object));
    if (out_.pieces.empty()) return no_surface();
    for (VolumetricPiece& piece : out_.pieces) TURNSCAN_TRY(finish(piece));
    return std::move(out_);
  }

 private:
  static tl::unexpected<Error> no_surface() {
    return fail(ErrorCode::kTooFewPoints,
                "volumetric: the frames show no surface: where one sees something, others see past "
                "it; check the turntable's place and the angles");
  }

  Result<TriangleMesh> surface(Box box) {
    const double rim = scale_.truncation_m + 4.0 * scale_.cell_m;
    box.min.array() -= rim;
    box.max.array() += rim;
    if (scale_.floor_m) box.min.y() = -0.25 * scale_.cell_m;  // the lowest layer is at -0.5
    Volume volume = timed("distances", [&] { return sums_.settle(box); });
    grid_.origin_m = volume.origin_m;
    grid_.cell_m = volume.cell_m;
    if (scale_.floor_m) grid_.flat_m = 0.0f;
    const bool closed = timed("closing", [&] {
      smooth(volume, 1);
      close_volume(volume, scale_, context_);
      return true;
    });
    if (closed) TURNSCAN_TRY(context_.check());
    return timed("extraction", [&]() -> Result<TriangleMesh> {
      TURNSCAN_ASSIGN(const BrickGrid grid, to_grid(volume, std::size_t(2) << 30));
      return isosurface(grid, IsosurfaceOptions(), context_);
    });
  }

  /// Evens out and fits what stands and what hangs in the air beside it, and makes one piece of it.
  Result<> fit(std::vector<TriangleMesh>& parts) {
    VolumetricPiece piece;
    std::vector<TriangleMesh> fitted_parts;
    for (const TriangleMesh& part : parts) {
      TURNSCAN_ASSIGN(const TriangleMesh even,
                      timed("even out", [&] { return even_out(part, grid_, context_); }));
      TURNSCAN_ASSIGN(MeshFit fitted, timed("fit", [&] {
                        return fit_mesh(even, input_.views, fit_scale(), context_);
                      }));
      if (options_.sharpen && input_.filter_share > 0.0)
        TURNSCAN_TRY(timed("sharpen", [&] {
          return sharpen_mesh(fitted.mesh, input_.views, input_.filter_share, fit_scale(),
                              context_);
        }));
      if (encloses_nothing(fitted.mesh)) continue;
      piece.support.insert(piece.support.end(), fitted.support.begin(), fitted.support.end());
      fitted_parts.push_back(std::move(fitted.mesh));
    }
    if (fitted_parts.empty()) return {};
    piece.hanging = fitted_parts.size() - 1;
    piece.mesh = fitted_parts.size() == 1 ? std::move(fitted_parts[0]) : join_meshes(fitted_parts);
    out_.pieces.push_back(std::move(piece));
    return {};
  }

  /// Fewer triangles if asked for; colour; what no frame measured; how many points there are.
  Result<> finish(VolumetricPiece& piece) {
    TURNSCAN_TRY(reduce(piece));
    if (input_.colored) {
      const double tolerance = 3.0 * input_.noise_m + 2.0 * scale_.cell_m;
      TURNSCAN_TRY(timed("colour", [&] {
        return color_from_views(piece.mesh, input_.views, tolerance, context_);
      }));
    }
    std::vector<float> sorted = piece.support;
    const auto typical = float(median(sorted));
    for (const float s : piece.support)
      piece.confidence.push_back(typical > 0.0f ? std::min(1.0f, s / typical) : 0.0f);
    const std::vector<std::uint8_t> invented = measure_invented(piece);
    if (options_.mark_invented) paint_triangles(piece.mesh, invented);
    Box box = bounds(piece.mesh.vertices);
    box.min.array() -= scale_.truncation_m;
    box.max.array() += scale_.truncation_m;
    piece.points = points_in(box);
    return {};
  }

  std::size_t points_in(const Box& box) const {
    std::vector<std::size_t> counts(input_.views.size(), 0);
    parallel_for(counts.size(), 4, [&](std::size_t v) {
      for_each_point_inside(input_, input_.views[v], [&](const Vec3f& p) {
        const auto q = p.cast<double>().array();
        if ((q >= box.min.array()).all() && (q <= box.max.array()).all()) ++counts[v];
      });
    });
    return std::accumulate(counts.begin(), counts.end(), std::size_t(0));
  }

  /// Quadrics only estimate how far a surface strays: it is measured, and tried again with less,
  /// then with what lies between what is too much and what is not.
  Result<TriangleMesh> within_error(const TriangleMesh& full, std::size_t triangles) const {
    constexpr int kTries = 6;
    const double bound = *options_.max_error_m;
    TriangleMesh best = full;
    double goal = bound, enough = 0.0, too_much = 0.0;
    for (int attempt = 0; attempt < kTries; ++attempt) {
      TURNSCAN_ASSIGN(TriangleMesh fewer, simplify(full, {triangles, goal, false}));
      TURNSCAN_TRY(context_.check());
      const double farthest = stray(full, fewer);
      (farthest <= bound ? enough : too_much) = goal;
      if (farthest <= bound && fewer.triangles.size() < best.triangles.size())
        best = std::move(fewer);
      if (too_much == 0.0) break;
      goal = enough > 0.0 ? 0.5 * (enough + too_much) : goal * 0.9 * bound / farthest;
    }
    return best;
  }

  /// Distance of the vertex of one mesh that lies farthest from another mesh.
  static double stray(const TriangleMesh& from, const TriangleMesh& to) {
    const MeshDistance distance(to);
    std::vector<double> distances(from.vertices.size());
    parallel_for(distances.size(), 256, [&](std::size_t v) {
      distances[v] = distance.closest(from.vertices[v].cast<double>()).distance;
    });
    return distances.empty() ? 0.0 : *std::max_element(distances.begin(), distances.end());
  }

  Result<> reduce(VolumetricPiece& piece) {
    const std::size_t all = piece.mesh.triangles.size();
    const std::size_t most = options_.triangles ? std::size_t(*options_.triangles) : all;
    if (most >= all && !options_.max_error_m) return {};
    TURNSCAN_ASSIGN(piece.mesh, timed("simplify", [&]() -> Result<TriangleMesh> {
                      if (!options_.max_error_m) return simplify(piece.mesh, {most, 1e30, false});
                      return within_error(piece.mesh, options_.triangles ? most : 0);
                    }));
    MeshFitScale measure = fit_scale();
    measure.iterations = 0;
    TURNSCAN_ASSIGN(MeshFit measured, fit_mesh(piece.mesh, input_.views, measure, context_));
    piece.support = std::move(measured.support);
    return {};
  }

  /// Adds up the areas that no frame measured. 1 for the triangles of the invented one.
  std::vector<std::uint8_t> measure_invented(VolumetricPiece& piece) const {
    const auto& p = piece.mesh.vertices;
    const float base = scale_.floor_m ? float(*scale_.floor_m) : -1e30f;
    std::vector<std::uint8_t> invented(piece.mesh.triangles.size(), 0);
    for (std::size_t i = 0; i < invented.size(); ++i) {
      const auto& t = piece.mesh.triangles[i];
      const double area = triangle_area(piece.mesh, i);
      const float low = std::min({p[t[0]].y(), p[t[1]].y(), p[t[2]].y()});
      const float high = std::max({p[t[0]].y(), p[t[1]].y(), p[t[2]].y()});
      if (high < base && high - low < 0.1f * float(scale_.cell_m)) {
        piece.base_area_m2 += area;
      } else if (std::any_of(t.begin(), t.end(),
                             [&](std::uint32_t v) { return piece.confidence[v] < kInvented; })) {
        invented[i] = 1;
        piece.invented_area_m2 += area;
      }
    }
    return invented;
  }

  /// Sorts out what is an object, what hangs beside one, and what is nothing.
  void keep_pieces(std::vector<TriangleMesh> pieces) {
    std::vector<double> areas;
    for (const TriangleMesh& piece : pieces) areas.push_back(surface_area(piece));
    std::vector<std::size_t> order(pieces.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
    std::erase_if(order, [&](std::size_t i) {
      return areas[i] < min_share_ * areas[order[0]] || encloses_nothing(pieces[i]);
    });
    const std::vector<std::size_t> holder = holders(pieces, order);
    std::vector<std::size_t> object(order.size(), kNotKept);  // where what stands is kept
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (holder[i] != i || (input_.keep != 0 && objects_.size() >= std::size_t(input_.keep)))
        continue;
      object[i] = objects_.size();
      objects_.emplace_back().push_back(std::move(pieces[order[i]]));
    }
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (holder[i] == i || object[holder[i]] == kNotKept) continue;
      objects_[object[holder[i]]].push_back(std::move(pieces[order[i]]));
    }
  }

  /// The largest piece stands, whatever lies below it.
  std::vector<std::size_t> holders(const std::vector<TriangleMesh>& pieces,
                                   const std::vector<std::size_t>& order) const {
    std::vector<PlacedPiece> places(order.size());
    bool any = false;
    for (std::size_t i = 0; i < order.size(); ++i) {
      places[i].stands = i == 0 || !floats(pieces[order[i]]);
      any |= !places[i].stands;
    }
    for (std::size_t i = 0; any && i < order.size(); ++i)
      places[i].points = pieces[order[i]].vertices;
    return find_holders(places, std::numeric_limits<double>::infinity());
  }

  bool floats(const TriangleMesh& piece) const {
    return scale_.floor_m &&
           bounds(piece.vertices).min.y() > *scale_.floor_m + scale_.truncation_m + scale_.cell_m;
  }

  MeshFitScale fit_scale() const {
    MeshFitScale scale;
    scale.noise_m = input_.noise_m;
    scale.reach_m = fit_reach_;
    scale.floor_m = 0.1 * input_.noise_m + 0.1 * scale_.cell_m;
    scale.limit_m = 2.0 * scale_.cell_m;
    scale.fair_m = 4.0 * scale_.cell_m;
    scale.iterations = options_.fit ? options_.fit_iterations : 0;
    if (scale_.floor_m) scale.floor_height_m = *scale_.floor_m;
    return scale;
  }

  const VolumetricInput& input_;
  VolumeScale scale_;
  double fit_reach_;
  const FieldSums& sums_;
  const VolumetricOptions& options_;
  double min_share_;
  const RunContext& context_;
  EvenOutScale grid_;
  std::vector<std::vector<TriangleMesh>> objects_;  ///< what stands, and what hangs beside it
  VolumetricResult out_;
};

}  // namespace

std::vector<Vec3f> sample_points(const VolumetricInput& input) {
  std::vector<Vec3f> points;
  for_each_point_inside(input, 64, [&](const Vec3f& p) { points.push_back(p); });
  return points;
}

Box measured_box(const VolumetricInput& input) {
  RobustBox points;
  for_each_point_inside(input, 64, [&](const Vec3f& p) { points.add(p); });
  return points.box();
}

Result<VolumetricResult> reconstruct_volume(const VolumetricInput& input,
                                            const VolumetricScale& scale, const FieldSums& sums,
                                            const VolumetricOptions& options, double min_share,
                                            const RunContext& context) {
  return Run(input, scale, sums, options, min_share, context)();
}

}  // namespace turnscan
