#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh_repair.hpp>
#include <turnscan/reconstruction/mesh_fit_parts.hpp>
#include <turnscan/reconstruction/volume.hpp>

namespace turnscan {

namespace {

constexpr std::size_t kBlock = 256;  // vertices that are looked up together
/// Each step looks at twice as many views as the one before it, but not at fewer than these.
constexpr std::size_t kFewestViews = 128;
constexpr double kTukey = 4.685;  // standard deviations; 95 % efficient for normal noise
constexpr float kFacing = 0.2f;   // rays that graze the surface say little about it
/// Dark or slanted places are noisier than others, up to so many times as far as it matters.
constexpr float kWidest = 4.0f;
/// What a scatter may exceed the noise by before it counts as larger: outliers make some, too.
constexpr float kUsualSpread = 1.2f;
/// A rim scatters, too, by what else is measured near it, but it is narrow: noisy places are wider
/// than twice so many rings of neighbours.
constexpr int kRimRings = 6;
/// Fewer views do not tell how they scatter.
constexpr std::size_t kTellSpread = 24;

/// How many times the noise measurements scatter, when a share of them lies within kNear of its
/// deviations: of normal errors it is erf(kNear / (sqrt(2) times)).
float times_the_noise(float share) {
  float low = 1.0f, high = kWidest * kUsualSpread;
  for (int round = 0; round < 12; ++round) {
    const float middle = 0.5f * (low + high);
    (std::erf(detail::kNear / (1.4142136f * middle)) > share ? low : high) = middle;
  }
  return low;
}

/// Vertices that face alike and lie near each other stand together, so that a view that sees one
/// of them sees most, and one that sees none can be left out.
std::vector<std::uint32_t> order_by_facing(const std::vector<Vec3f>& positions,
                                           const std::vector<Vec3f>& normals) {
  Box box = bounds(positions);
  const double side = std::max(box.size().maxCoeff(), 1e-9);
  // Of each axis 10 bits of position, interleaved; before them one of 24 directions: the cube's
  // face that the normal goes through, and the quarter of it.
  const auto spread = [](std::uint64_t v) {
    std::uint64_t out = 0;
    for (int bit = 0; bit < 10; ++bit) out |= (v >> bit & 1) << (3 * bit);
    return out;
  };
  std::vector<std::pair<std::uint64_t, std::uint32_t>> key(positions.size());
  parallel_for(positions.size(), 4096, [&](std::size_t v) {
    int axis = 0;
    normals[v].cwiseAbs().maxCoeff(&axis);
    std::uint64_t code = std::uint64_t(axis);
    for (int a = 0; a < 3; ++a) code = 2 * code + (normals[v][a] < 0.0f ? 1 : 0);
    code <<= 30;
    for (int a = 0; a < 3; ++a) {
      const double at = (double(positions[v][a]) - box.min[a]) / side * 1023.0;
      code |= spread(std::uint64_t(std::clamp(at, 0.0, 1023.0))) << a;
    }
    key[v] = {code, std::uint32_t(v)};
  });
  std::sort(key.begin(), key.end());
  std::vector<std::uint32_t> order(key.size());
  for (std::size_t i = 0; i < key.size(); ++i) order[i] = key[i].second;
  return order;
}

/// A ball around the vertices of a block, and a cone around their normals.
struct Patch {
  Vec3f center = Vec3f::Zero(), axis = Vec3f::Zero();
  float radius = 0.0f, opening = 0.0f;  // metres, radians
};

class Fitter {
 public:
  Fitter(const TriangleMesh& mesh, std::span<const DepthView> views, const MeshFitScale& scale)
      : views_(views), scale_(scale), neighbours_(mesh) {
    fit_.mesh = mesh;
    order_ = order_by_facing(mesh.vertices, vertex_normals(mesh));
    for (const DepthView& view : views) kernels_.push_back(kernel_of(view));
  }

  Result<MeshFit> run(const RunContext& context) {
    const std::size_t n = fit_.mesh.vertices.size();
    const bool tells = scale_.iterations > 0 && views_.size() >= kTellSpread;
    const int rounds = std::max(1, scale_.iterations), looks = tells ? 1 : 0;
    context.begin_phase("fit", (n + kBlock - 1) / kBlock * std::size_t(rounds + looks));
    spread_.assign(n, 1.0f);
    if (looks > 0) {
      std::fill(spread_.begin(), spread_.end(), kWidest * kWidest);
      take_columns(0);
      TURNSCAN_TRY(measure_all(views_apart(rounds - 1), context));
      take_spread();
    }
    for (int iteration = 0; iteration < rounds; ++iteration) {
      take_columns(iteration);
      TURNSCAN_TRY(measure_all(views_apart(rounds - 1 - iteration), context));
      forget_the_platter();
      if (scale_.iterations > 0) move();
      if (scale_.iterations > 0 && iteration == 0 && scale_.fair_m > 0.0)
        detail::fair(fit_.mesh, neighbours_, measured_.support, scale_);
    }
    if (scale_.iterations > 0 && scale_.floor_height_m)
      detail::straighten_walls(fit_.mesh, neighbours_, measured_.support, scale_);
    fit_.support = std::move(measured_.support);
    return std::move(fit_);
  }

 private:
  static std::size_t pad(std::size_t n) {
    return (n + detail::kVertexRow - 1) / detail::kVertexRow * detail::kVertexRow;
  }

  /// With so many steps to go.
  std::size_t views_apart(int to_go) const {
    std::size_t step = 1;
    for (; to_go > 0 && views_.size() / (2 * step) >= kFewestViews; --to_go) step *= 2;
    return step;
  }

  /// Positions and smoothed normals as the kernel reads them.
  void take_columns(int iteration) {
    const std::size_t n = fit_.mesh.vertices.size();
    normals_ = vertex_normals(fit_.mesh);
    for (int round = 0; round < (iteration == 0 ? 3 : 2); ++round) {
      std::vector<Vec3f> next(n);
      parallel_for(n, 4096, [&](std::size_t v) {
        const Vec3f sum = normals_[v] + neighbours_.mean(normals_, v, Vec3f(Vec3f::Zero()));
        next[v] = sum.norm() > 1e-3f ? Vec3f(sum.normalized()) : normals_[v];
      });
      normals_.swap(next);
    }
    const std::size_t padded = pad(n);
    for (auto& column : columns_) column.assign(padded, 1.0f);
    parallel_for(n, 4096, [&](std::size_t i) {
      const std::uint32_t v = order_[i];
      for (int a = 0; a < 3; ++a) {
        columns_[std::size_t(a)][i] = fit_.mesh.vertices[v][a];
        columns_[std::size_t(a + 3)][i] = normals_[v][a];
      }
      columns_[6][i] = spread_[v];
    });
  }

  /// How much more measurements scatter than the noise says, from those of the neighbours, too.
  void take_spread() {
    parallel_for(spread_.size(), 1024, [&](std::size_t v) {
      const float count = neighbours_.count(v);
      const float all = measured_.support[v] + count * neighbours_.mean(measured_.support, v, 0.0f);
      const float near = near_[v] + count * neighbours_.mean(near_, v, 0.0f);
      const float times = times_the_noise(all > 1e-3f ? near / all : 1.0f) / kUsualSpread;
      const float spread = std::clamp(times, 1.0f, kWidest);
      spread_[v] = spread * spread;
    });
    const auto least = [](float a, float b) { return std::min(a, b); };
    const auto most = [](float a, float b) { return std::max(a, b); };
    spread_ = neighbours_.chosen(std::move(spread_), kRimRings, least);
    spread_ = neighbours_.chosen(std::move(spread_), kRimRings, most);
  }

  /// With every step-th view.
  Result<> measure_all(std::size_t step, const RunContext& context) {
    const std::size_t n = fit_.mesh.vertices.size();
    std::vector<float> weight(pad(n), 0.0f), offset(pad(n), 0.0f), near(pad(n), 0.0f);
    parallel_for((n + kBlock - 1) / kBlock, 1, [&](std::size_t b) {
      if (context.cancelled()) return;
      measure(b * kBlock, std::min(n, (b + 1) * kBlock), step,
              {weight.data(), offset.data(), near.data()});
      context.advance();
    });
    TURNSCAN_TRY(context.check());
    for (auto* sums : {&measured_.support, &measured_.offset, &near_}) sums->resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      measured_.support[order_[i]] = weight[i];
      measured_.offset[order_[i]] = offset[i];
      near_[order_[i]] = near[i];
    }
    return {};
  }

  /// Of the vertices that stand at [begin, end).
  Patch patch(std::size_t begin, std::size_t end) const {
    Patch out;
    Box box;
    for (std::size_t i = begin; i < end; ++i) {
      box.add(fit_.mesh.vertices[order_[i]].cast<double>());
      out.axis += normals_[order_[i]];
    }
    out.center = box.center().cast<float>();
    out.radius = float(0.5 * box.size().norm());
    out.axis.normalize();
    float least = 1.0f;
    for (std::size_t i = begin; i < end; ++i)
      least = std::min(least, out.axis.dot(normals_[order_[i]]));
    out.opening = std::acos(std::clamp(least, -1.0f, 1.0f));
    return out;
  }

  void measure(std::size_t begin, std::size_t end, std::size_t step, detail::VertexSums sums) {
    const Patch around = patch(begin, end);
    const detail::VertexColumns columns{columns_[0].data(), columns_[1].data(), columns_[2].data(),
                                        columns_[3].data(), columns_[4].data(), columns_[5].data(),
                                        columns_[6].data()};
    const detail::FitScale scale{float(1.0 / (scale_.reach_m * scale_.reach_m)),
                                 float(scale_.noise_m),
                                 float(scale_.floor_m),
                                 float(kTukey),
                                 kFacing,
                                 scale_.edge_weight};
    for (std::size_t v = 0; v < views_.size(); v += step) {
      if (turned_away(views_[v], around) || outside_window(views_[v], around)) continue;
      detail::add_view_to_vertices(kernels_[v], columns, begin, pad(end), scale, sums);
    }
  }

  /// Whether no vertex of the patch faces the view.
  static bool turned_away(const DepthView& view, const Patch& patch) {
    constexpr float kHalfPi = 1.5707963f, kSlack = 0.01f;
    const Vec3f axis = view.rotation * patch.axis;
    const Vec3f c = view.rotation * patch.center + view.translation;
    const float distance = c.norm();
    // Directions to the sensor differ across the patch.
    float wide = patch.opening + kSlack;
    if (!view.parallel) {
      if (distance <= 2.0f * patch.radius) return false;
      wide += std::asin(patch.radius / distance);
    }
    const float facing = view.parallel ? -axis.z() : -axis.dot(c) / distance;
    return std::acos(std::clamp(facing, -1.0f, 1.0f)) - wide > std::acos(kFacing) && wide < kHalfPi;
  }

  static bool outside_window(const DepthView& view, const Patch& patch) {
    const Vec3f c = view.rotation * patch.center + view.translation;
    const float radius = patch.radius;
    if (view.parallel || view.distorted) return false;
    if (c.z() <= radius) return true;
    const float reach = 1.1f * radius / (c.z() - radius);
    const float u = c.x() / c.z() * view.fx + view.cx, v = c.y() / c.z() * view.fy + view.cy;
    return u + reach * view.fx < 0.0f || v + reach * view.fy < 0.0f ||
           u - reach * view.fx > float(view.width) || v - reach * view.fy > float(view.height);
  }

  /// What was measured in the lower half of the margin may be the platter.
  void forget_the_platter() {
    if (!scale_.floor_height_m) return;
    for (std::size_t v = 0; v < fit_.mesh.vertices.size(); ++v) {
      if (fit_.mesh.vertices[v].y() < 0.5f * float(*scale_.floor_height_m))
        measured_.support[v] = measured_.offset[v] = 0.0f;
    }
  }

  void move() {
    const std::vector<float> delta =
        detail::fitted_offsets(fit_.mesh, neighbours_, normals_, measured_, scale_);
    const float limit = float(scale_.limit_m);
    const auto& p = fit_.mesh.vertices;
    std::vector<Vec3f> step(p.size());
    parallel_for(p.size(), 4096, [&](std::size_t v) {
      step[v] = std::clamp(delta[v], -limit, limit) * normals_[v];
      if (detail::stands(p[v], scale_)) step[v].y() = 0.0f;
    });
    detail::take_steps(fit_.mesh, std::move(step));
  }

  std::span<const DepthView> views_;
  MeshFitScale scale_;
  detail::MeshNeighbours neighbours_;
  std::vector<detail::ViewKernel> kernels_;
  MeshFit fit_;
  std::vector<std::uint32_t> order_;  // place in the columns: vertex
  std::vector<Vec3f> normals_;
  detail::VertexMeasurements measured_;
  std::vector<float> near_;    // as VertexSums, by vertex
  std::vector<float> spread_;  // squared, as VertexColumns::spread
  std::array<std::vector<float>, 7> columns_;
};

}  // namespace

Result<MeshFit> fit_mesh(const TriangleMesh& mesh, std::span<const DepthView> views,
                         const MeshFitScale& scale, const RunContext& context) {
  return Fitter(mesh, views, scale).run(context);
}

}  // namespace turnscan
