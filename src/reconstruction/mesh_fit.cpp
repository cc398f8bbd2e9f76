#include <algorithm>
#include <cmath>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh_repair.hpp>
#include <turnscan/reconstruction/mesh_fit.hpp>
#include <turnscan/reconstruction/volume.hpp>

namespace turnscan {

namespace {

constexpr std::size_t kBlock = 256;  // vertices that are looked up together
/// Each step looks at twice as many views as the one before it, but not at fewer than these.
constexpr std::size_t kFewestViews = 128;
constexpr double kTukey = 4.685;  // standard deviations; 95 % efficient for normal noise
constexpr int kUnfolds = 5;
constexpr float kLeastTurn = 0.3f;  // cosine between a triangle's normals before and after a step
constexpr float kFacing = 0.2f;     // rays that graze the surface say little about it
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

/// Who is joined to whom, by an edge.
struct Neighbours {
  std::vector<std::uint32_t> begin, list;

  explicit Neighbours(const TriangleMesh& mesh) : begin(mesh.vertices.size() + 1, 0) {
    // Each edge of a closed mesh runs once in each direction.
    for (const auto& t : mesh.triangles) {
      for (const std::uint32_t v : t) ++begin[v + 1];
    }
    for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
    list.resize(3 * mesh.triangles.size());
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (const auto& t : mesh.triangles) {
      for (std::size_t c = 0; c < 3; ++c) list[next[t[c]]++] = t[(c + 1) % 3];
    }
  }
  template <class T>
  T mean(const std::vector<T>& values, std::size_t v, const T& zero) const {
    T sum = zero;
    for (std::uint32_t k = begin[v]; k < begin[v + 1]; ++k) sum += values[list[k]];
    return begin[v + 1] > begin[v] ? T(sum / count(v)) : values[v];
  }
  float count(std::size_t v) const { return float(begin[v + 1] - begin[v]); }
  template <class Visit>
  void each(std::size_t v, const Visit& visit) const {
    for (std::uint32_t k = begin[v]; k < begin[v + 1]; ++k) visit(list[k]);
  }
};

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
      if (scale_.iterations > 0 && iteration == 0 && scale_.fair_m > 0.0) fair();
    }
    if (scale_.iterations > 0 && scale_.floor_height_m) straighten_walls();
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
      const float all = fit_.support[v] + count * neighbours_.mean(fit_.support, v, 0.0f);
      const float near = near_[v] + count * neighbours_.mean(near_, v, 0.0f);
      const float times = times_the_noise(all > 1e-3f ? near / all : 1.0f) / kUsualSpread;
      const float spread = std::clamp(times, 1.0f, kWidest);
      spread_[v] = spread * spread;
    });
    const auto least = [](float a, float b) { return std::min(a, b); };
    const auto most = [](float a, float b) { return std::max(a, b); };
    for (int ring = 0; ring < kRimRings; ++ring) spread_ = among_neighbours(spread_, least);
    for (int ring = 0; ring < kRimRings; ++ring) spread_ = among_neighbours(spread_, most);
  }

  template <class Choose>
  std::vector<float> among_neighbours(const std::vector<float>& values,
                                      const Choose& choose) const {
    std::vector<float> out = values;
    parallel_for(values.size(), 4096, [&](std::size_t v) {
      neighbours_.each(v, [&](std::uint32_t other) { out[v] = choose(out[v], values[other]); });
    });
    return out;
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
    for (auto* sums : {&fit_.support, &offset_, &near_}) sums->resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      fit_.support[order_[i]] = weight[i];
      offset_[order_[i]] = offset[i];
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

  /// Median of the supports that there are.
  float typical_support() const {
    std::vector<float> some;
    for (std::size_t v = 0; v < fit_.mesh.vertices.size(); ++v) {
      if (fit_.support[v] > 0.01f) some.push_back(fit_.support[v]);
    }
    return float(median(some, 1.0));
  }

  /// How far each vertex lies below the mean of its neighbours, along its normal.
  std::vector<float> bends() const {
    const auto& p = fit_.mesh.vertices;
    std::vector<float> out(p.size());
    parallel_for(p.size(), 4096, [&](std::size_t v) {
      out[v] = (neighbours_.mean(p, v, Vec3f(Vec3f::Zero())) - p[v]).dot(normals_[v]);
    });
    return out;
  }

  /// Bends averaged with those of the neighbours: a ridge bends along a line of vertices, while one
  /// vertex that noise pulled out bends its neighbours the other way, and nothing is left.
  std::vector<float> shared_bends(const std::vector<float>& bend) const {
    std::vector<float> out(bend.size());
    parallel_for(bend.size(), 4096, [&](std::size_t v) {
      const float count = neighbours_.count(v);
      out[v] = (bend[v] + count * neighbours_.mean(bend, v, 0.0f)) / (1.0f + count);
    });
    return out;
  }

  /// Offsets d that minimise sum w (d - own)^2 + sum m (bend + mean of the neighbours' d - d)^2,
  /// by damped Jacobi. A bend that is too large to be noise is a feature, and m fades (Geman and
  /// McClure).
  std::vector<float> offsets() const {
    const std::size_t n = fit_.mesh.vertices.size();
    const float typical = typical_support();
    const std::vector<float> bend = bends();
    const std::vector<float> shared = shared_bends(bend);
    const float feature = float(scale_.feature) * float(scale_.noise_m);
    std::vector<float> own(n), stiff(n), diagonal(n), delta(n), rest(n);
    parallel_for(n, 4096, [&](std::size_t v) {
      own[v] = fit_.support[v] > 1e-3f ? offset_[v] / fit_.support[v] : 0.0f;
      // Where less was measured than usual, only a larger bend is more than noise.
      const bool standing = stands(v);
      const float around =
          0.5f * (fit_.support[v] + neighbours_.mean(fit_.support, v, 0.0f)) / typical;
      const float share = standing ? 1.0f : std::clamp(around, 0.02f, 1.0f);
      const float s = shared[v] * std::sqrt(share * typical) / feature;
      stiff[v] = float(scale_.stiffness) * typical / ((1.0f + s * s) * (1.0f + s * s));
    });
    parallel_for(n, 4096, [&](std::size_t v) {
      diagonal[v] = fit_.support[v] + stiff[v] + 1e-6f;
      neighbours_.each(v, [&](std::uint32_t u) {
        diagonal[v] += stiff[u] / (neighbours_.count(u) * neighbours_.count(u));
      });
    });
    for (int round = 0; round < 40; ++round) {
      parallel_for(n, 4096, [&](std::size_t v) {
        rest[v] = stiff[v] * (bend[v] + neighbours_.mean(delta, v, 0.0f) - delta[v]);
      });
      parallel_for(n, 4096, [&](std::size_t v) {
        float gradient = fit_.support[v] * (own[v] - delta[v]) + rest[v];
        neighbours_.each(v, [&](std::uint32_t u) { gradient -= rest[u] / neighbours_.count(u); });
        delta[v] += 0.35f * gradient / diagonal[v];
      });
    }
    return delta;
  }

  bool stands(std::size_t v) const {
    return scale_.floor_height_m && fit_.mesh.vertices[v].y() < float(*scale_.floor_height_m);
  }

  /// What was measured in the lower half of the margin may be the platter.
  void forget_the_platter() {
    if (!scale_.floor_height_m) return;
    for (std::size_t v = 0; v < fit_.mesh.vertices.size(); ++v) {
      if (fit_.mesh.vertices[v].y() < 0.5f * float(*scale_.floor_height_m))
        fit_.support[v] = offset_[v] = 0.0f;
    }
  }

  void move() {
    const std::vector<float> delta = offsets();
    const float limit = float(scale_.limit_m);
    const auto& p = fit_.mesh.vertices;
    std::vector<Vec3f> step(p.size());
    parallel_for(p.size(), 4096, [&](std::size_t v) {
      step[v] = std::clamp(delta[v], -limit, limit) * normals_[v];
      if (stands(v)) step[v].y() = 0.0f;
    });
    take_steps(step);
  }

  void take_steps(std::vector<Vec3f>& step) {
    for (int round = 0; round < kUnfolds && shorten_folding(step, round + 1 == kUnfolds); ++round) {
    }
    parallel_for(step.size(), 4096, [&](std::size_t v) { fit_.mesh.vertices[v] += step[v]; });
  }

  /// Where little or nothing was measured the volume ends in rags, pixel by pixel. Those vertices
  /// move to the middle of their neighbours, held by what was measured around them.
  void fair() {
    constexpr int kRounds = 80;
    constexpr float kMeasured = 0.05f;  // share of the typical support from which on vertices stay
    auto& p = fit_.mesh.vertices;
    const float typical = typical_support(), reach = float(scale_.fair_m);
    std::vector<float> hold(p.size(), 1.0f);
    for (std::uint32_t v = 0; v < p.size(); ++v)
      hold[v] = std::min(1.0f, fit_.support[v] / (kMeasured * typical));
    std::vector<std::uint32_t> loose;
    for (std::uint32_t v = 0; v < p.size(); ++v) {
      if (hold[v] < 1.0f && !stands(v)) loose.push_back(v);
    }
    const std::vector<Vec3f> start = p;
    std::vector<Vec3f> next(loose.size());
    for (int round = 0; round < kRounds; ++round) {
      parallel_for(loose.size(), 4096, [&](std::size_t k) {
        const std::uint32_t v = loose[k];
        const Vec3f mean = neighbours_.mean(p, v, Vec3f(Vec3f::Zero()));
        const Vec3f to = p[v] + 0.5f * (1.0f - hold[v]) * (mean - p[v]) - start[v];
        next[k] = start[v] + to * std::min(1.0f, reach / std::max(to.norm(), 1e-9f));
      });
      for (std::size_t k = 0; k < loose.size(); ++k) p[loose[k]] = next[k];
    }
  }

  /// Below the floor nothing was measured: walls go on straight down from what was fitted above
  /// them, even along the base's outline, and the base's vertices go with it.
  void straighten_walls() {
    constexpr int kRounds = 20;
    constexpr float kMeasured = 0.1f;  // share of the typical support from which on vertices stay
    const float typical = typical_support();
    auto& p = fit_.mesh.vertices;
    // On the base but not at its outline.
    std::vector<std::uint8_t> inner(p.size(), 0);
    std::vector<std::uint32_t> standing;
    const auto lowest = [&](std::uint32_t v) { return std::abs(p[v].y()) < 1e-6f; };
    for (std::uint32_t v = 0; v < p.size(); ++v) {
      if (!stands(v)) continue;
      standing.push_back(v);
      bool all = lowest(v);
      neighbours_.each(v, [&](std::uint32_t u) { all &= lowest(u); });
      inner[v] = all ? 1 : 0;
    }
    std::vector<Vec3f> to = p, next(standing.size());
    for (int round = 0; round < kRounds; ++round) {
      parallel_for(standing.size(), 4096, [&](std::size_t k) {
        const std::uint32_t v = standing[k];
        Vec3f sum = Vec3f::Zero();
        float count = 0.0f;
        neighbours_.each(v, [&](std::uint32_t u) {
          if (inner[u] && !inner[v]) return;
          sum += to[u];
          count += 1.0f;
        });
        const float loose = 0.5f * (1.0f - std::min(1.0f, fit_.support[v] / (kMeasured * typical)));
        next[k] = count > 0.0f ? Vec3f(to[v] + loose * (sum / count - to[v])) : to[v];
        next[k].y() = p[v].y();
      });
      for (std::size_t k = 0; k < standing.size(); ++k) to[standing[k]] = next[k];
    }
    std::vector<Vec3f> step(p.size(), Vec3f::Zero());
    const auto limit = float(scale_.fair_m > 0.0 ? scale_.fair_m : scale_.limit_m);
    for (const std::uint32_t v : standing) {
      step[v] = to[v] - p[v];
      step[v] *= std::min(1.0f, limit / std::max(step[v].norm(), 1e-9f));
    }
    take_steps(step);
  }

  /// Halves the steps, or takes them away, of triangles that would turn over. Whether there were
  /// any.
  bool shorten_folding(std::vector<Vec3f>& step, bool stop) const {
    const auto& p = fit_.mesh.vertices;
    const auto& triangles = fit_.mesh.triangles;
    std::vector<int> folds(triangles.size());
    parallel_for(triangles.size(), 4096, [&](std::size_t i) {
      const auto& [a, b, c] = triangles[i];
      const Vec3f before = (p[b] - p[a]).cross(p[c] - p[a]);
      const Vec3f pa = p[a] + step[a];
      const Vec3f after = (p[b] + step[b] - pa).cross(p[c] + step[c] - pa);
      folds[i] = before.dot(after) < kLeastTurn * before.norm() * after.norm() ? 1 : 0;
    });
    std::vector<float> share(p.size(), 1.0f);
    bool any = false;
    for (std::size_t i = 0; i < folds.size(); ++i) {
      if (folds[i] == 0) continue;
      any = true;
      for (const std::uint32_t v : triangles[i]) share[v] = stop ? 0.0f : 0.5f;
    }
    for (std::size_t v = 0; v < share.size(); ++v) step[v] *= share[v];
    return any;
  }

  std::span<const DepthView> views_;
  MeshFitScale scale_;
  Neighbours neighbours_;
  std::vector<detail::ViewKernel> kernels_;
  MeshFit fit_;
  std::vector<std::uint32_t> order_;  // place in the columns: vertex
  std::vector<Vec3f> normals_;
  std::vector<float> offset_, near_;  // as VertexSums, by vertex
  std::vector<float> spread_;         // squared, as VertexColumns::spread
  std::array<std::vector<float>, 7> columns_;
};

}  // namespace

Result<MeshFit> fit_mesh(const TriangleMesh& mesh, std::span<const DepthView> views,
                         const MeshFitScale& scale, const RunContext& context) {
  return Fitter(mesh, views, scale).run(context);
}

}  // namespace turnscan
