#include <algorithm>
#include <chrono>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/isosurface.hpp>
#include <turnscan/geometry/mesh_check.hpp>
#include <turnscan/geometry/mesh_repair.hpp>
#include <turnscan/geometry/simplify.hpp>
#include <turnscan/reconstruction/volumetric.hpp>

namespace turnscan {

namespace {

using Clock = std::chrono::steady_clock;

std::string mm(double metres) { return format_quantity(metres, Quantity::kLength); }

/// Calls take(p_table) for what about most_views of the views measured, edges left out.
template <class Take>
void for_each_point(const VolumetricInput& input, std::size_t most_views, const Take& take) {
  const std::size_t step = std::max<std::size_t>(1, input.views.size() / most_views);
  for (std::size_t v = 0; v < input.views.size(); v += step) {
    const DepthView& view = input.views[v];
    const Eigen::Matrix3f back = view.rotation.transpose();
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        const std::uint32_t word = view.pixels[std::size_t(y) * std::size_t(view.width) + x];
        if ((word & 0xffffu) == 0 || (word & DepthView::kEdge) != 0) continue;
        const float z = float(word & 0xffffu) * view.unit_m + view.bias_m;
        const float s = view.parallel ? 1.0f : z;
        const Vec3f p = back * (Vec3f((float(x) - view.cx) / view.fx * s,
                                      (float(y) - view.cy) / view.fy * s, z) -
                                view.translation);
        if (!input.cylinder || input.cylinder->contains(p.cast<double>())) take(p);
      }
    }
  }
}

/// The box of what the views measured: all but the outermost points, which may be stray.
Box measured_box(const VolumetricInput& input) {
  constexpr double kStray = 2e-4;
  std::array<std::vector<float>, 3> values;
  for_each_point(input, 64, [&](const Vec3f& p) {
    for (int a = 0; a < 3; ++a) values[std::size_t(a)].push_back(p[a]);
  });
  Box box;
  if (values[0].empty()) return box;
  for (int a = 0; a < 3; ++a) {
    auto& column = values[std::size_t(a)];
    const auto cut = std::ptrdiff_t(kStray * double(column.size()));
    std::nth_element(column.begin(), column.begin() + cut, column.end());
    box.min[a] = column[std::size_t(cut)];
    std::nth_element(column.begin(), column.end() - 1 - cut, column.end());
    box.max[a] = *(column.end() - 1 - cut);
  }
  return box;
}

double area_of(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    area += 0.5 *
            (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).norm();
  }
  return area;
}

class Run {
 public:
  Run(const VolumetricInput& input, const VolumetricOptions& options, double min_share,
      const RunContext& context)
      : input_(input), options_(options), min_share_(min_share), context_(context) {}

  template <class Stage>
  auto timed(const char* name, const Stage& stage) {
    const auto start = Clock::now();
    auto result = stage();
    out_.seconds.emplace_back(name, std::chrono::duration<double>(Clock::now() - start).count());
    return result;
  }

  Result<VolumetricResult> operator()() {
    Box box = measured_box(input_);
    if (box.empty())
      return fail(ErrorCode::kTooFewPoints, "volumetric: no frame has a point on the object");
    choose_scale(box);
    TURNSCAN_ASSIGN(TriangleMesh mesh, timed("distances", [&] { return surface(box); }));
    TURNSCAN_ASSIGN(auto pieces, split_components(mesh));
    keep_pieces(std::move(pieces));
    if (out_.pieces.empty())
      return fail(ErrorCode::kTooFewPoints, "volumetric: the frames show no surface");
    for (VolumetricPiece& piece : out_.pieces) {
      TURNSCAN_ASSIGN(
          piece.mesh, timed("simplify", [&] {
            return simplify(piece.mesh, {piece.mesh.triangles.size() / 4, 0.5 * scale_.cell_m});
          }));
      TURNSCAN_ASSIGN(MeshFit fitted, timed("fit", [&] {
                        return fit_mesh(piece.mesh, input_.views, fit_scale(), context_);
                      }));
      piece.mesh = std::move(fitted.mesh);
      piece.support = std::move(fitted.support);
      TURNSCAN_TRY(finish(piece));
    }
    return std::move(out_);
  }

 private:
  double choose(const char* option, const std::optional<double>& given, double automatic,
                const std::string& reason) {
    const double value = given.value_or(automatic);
    out_.choices.push_back({option, mm(value), given ? "given" : reason});
    return value;
  }

  void choose_scale(const Box& box) {
    const double longest = box.size().maxCoeff();
    double cell = 0.5 * input_.spacing_m;
    std::string reason =
        fmt::format("half the spacing of a frame's points, {}", mm(input_.spacing_m));
    if (cell < 0.5 * input_.noise_m) {
      cell = 0.5 * input_.noise_m;
      reason = fmt::format("half the noise, {}", mm(input_.noise_m));
    }
    if (cell < longest / 600.0) {
      cell = longest / 600.0;
      reason = fmt::format("a 600th of the longest side, {}", mm(longest));
    }
    if (input_.grid) {
      cell = longest / *input_.grid;
      reason = fmt::format("voxel-grid {} along {}", *input_.grid, mm(longest));
    }
    scale_.cell_m = choose("voxel-size", input_.cell_m, cell, reason);
    scale_.truncation_m = choose(
        "truncation", options_.truncation_m, std::max(3.0 * input_.noise_m, 2.5 * scale_.cell_m),
        fmt::format("the larger of 3 times the noise of {} and 2.5 voxels", mm(input_.noise_m)));
    scale_.behind_m = scale_.truncation_m * 2.0 / 3.0;
    if (input_.cylinder) scale_.floor_m = std::max(input_.cylinder->margin_m, 0.0);
    out_.cell_m = scale_.cell_m;
    fit_reach_ = choose("fit-reach", options_.fit_reach_m,
                        std::max(0.55 * input_.spacing_m, 1.2 * scale_.cell_m),
                        "0.55 times the spacing of a frame's points");
  }

  Result<TriangleMesh> surface(Box box) {
    const double rim = scale_.truncation_m + 4.0 * scale_.cell_m;
    box.min.array() -= rim;
    box.max.array() += rim;
    if (scale_.floor_m) box.min.y() = -1.0 * scale_.cell_m;
    std::vector<DepthView> some;
    std::span<const DepthView> views = input_.views;
    const std::size_t most = std::size_t(options_.field_frames);
    if (views.size() > most) {
      for (std::size_t k = 0; k < most; ++k) some.push_back(views[k * views.size() / most]);
      views = some;
    }
    TURNSCAN_ASSIGN(Volume volume, accumulate(views, box, scale_, context_));
    smooth(volume, 1);
    close_volume(volume, scale_, context_);
    TURNSCAN_TRY(context_.check());
    TURNSCAN_ASSIGN(const BrickGrid grid, to_grid(volume, std::size_t(2) << 30));
    return isosurface(grid, IsosurfaceOptions(), context_);
  }

  /// Fewer triangles if asked for; what no frame measured; how many points there are.
  Result<> finish(VolumetricPiece& piece) {
    if (options_.triangles && piece.mesh.triangles.size() > std::size_t(*options_.triangles)) {
      TURNSCAN_ASSIGN(piece.mesh, simplify(piece.mesh, {std::size_t(*options_.triangles), 1e30}));
      MeshFitScale measure = fit_scale();
      measure.iterations = 0;
      TURNSCAN_ASSIGN(MeshFit measured, fit_mesh(piece.mesh, input_.views, measure, context_));
      piece.support = std::move(measured.support);
    }
    std::vector<float> sorted = piece.support;
    const auto middle = sorted.begin() + std::ptrdiff_t(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const float least = 0.02f * *middle;
    const float base = scale_.floor_m ? float(*scale_.floor_m) : -1e30f;
    for (const auto& t : piece.mesh.triangles) {
      const auto& p = piece.mesh.vertices;
      const double area = 0.5 * (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm();
      const float low = std::min({p[t[0]].y(), p[t[1]].y(), p[t[2]].y()});
      const float high = std::max({p[t[0]].y(), p[t[1]].y(), p[t[2]].y()});
      if (high < base && high - low < 0.1f * float(scale_.cell_m))
        piece.base_area_m2 += area;
      else if (std::any_of(t.begin(), t.end(),
                           [&](std::uint32_t v) { return piece.support[v] < least; }))
        piece.invented_area_m2 += area;
    }
    Box box = bounds(piece.mesh.vertices);
    box.min.array() -= scale_.truncation_m;
    box.max.array() += scale_.truncation_m;
    for_each_point(input_, input_.views.size(), [&](const Vec3f& p) {
      const auto q = p.cast<double>().array();
      if ((q >= box.min.array()).all() && (q <= box.max.array()).all()) ++piece.points;
    });
    return {};
  }

  void keep_pieces(std::vector<TriangleMesh> pieces) {
    std::vector<double> areas;
    for (const TriangleMesh& piece : pieces) areas.push_back(area_of(piece));
    std::vector<std::size_t> order(pieces.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
    for (const std::size_t i : order) {
      if (input_.keep > 0 && out_.pieces.size() >= std::size_t(input_.keep)) break;
      if (areas[i] >= min_share_ * areas[order[0]])
        out_.pieces.push_back({std::move(pieces[i]), {}, 0.0, 0.0, 0});
    }
  }

  MeshFitScale fit_scale() const {
    MeshFitScale scale;
    scale.noise_m = input_.noise_m;
    scale.reach_m = fit_reach_;
    scale.floor_m = 0.1 * input_.noise_m + 0.1 * scale_.cell_m;
    scale.limit_m = 2.0 * scale_.cell_m;
    scale.iterations = options_.fit ? options_.fit_iterations : 0;
    if (scale_.floor_m) scale.floor_height_m = *scale_.floor_m;
    return scale;
  }

  const VolumetricInput& input_;
  const VolumetricOptions& options_;
  double min_share_;
  const RunContext& context_;
  VolumeScale scale_;
  double fit_reach_ = 0.0;
  VolumetricResult out_;
};

}  // namespace

OptionTable describe(VolumetricOptions& o) {
  OptionTable table;
  table
      .number("truncation", o.truncation_m, Quantity::kLength, {1e-5, 1.0},
              "Volumetric: how far along its ray a measurement counts; automatic: from its noise")
      .number(
          "field-frames", o.field_frames, {1, 100000},
          "Volumetric: at most so many frames, evenly spread, make the volume; all of them take "
          "part in the fit")
      .flag("fit", o.fit, "Volumetric: move the vertices onto the measurements of all frames")
      .number("fit-reach", o.fit_reach_m, Quantity::kLength, {1e-5, 0.1},
              "Volumetric: measurements farther from a vertex, across its normal, do not count in "
              "the fit; automatic: from the spacing")
      .number("fit-iterations", o.fit_iterations, {1, 20}, "Volumetric: steps of the fit")
      .number("triangles", o.triangles, {4, 1000000000},
              "Volumetric: at most so many triangles an object, still closed; automatic: a quarter "
              "of what the volume gives");
  return table;
}

std::vector<Vec3f> sample_points(const VolumetricInput& input) {
  std::vector<Vec3f> points;
  for_each_point(input, 64, [&](const Vec3f& p) { points.push_back(p); });
  return points;
}

Result<VolumetricResult> reconstruct_volume(const VolumetricInput& input,
                                            const VolumetricOptions& options, double min_share,
                                            const RunContext& context) {
  return Run(input, options, min_share, context)();
}

}  // namespace turnscan
