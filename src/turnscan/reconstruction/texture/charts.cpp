#include <algorithm>
#include <cmath>
#include <map>
#include <turnscan/core/disjoint_sets.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/texture/charts.hpp>

namespace turnscan::texture {

namespace {

using Neighbours = std::vector<std::array<std::uint32_t, 3>>;

constexpr int kDirections = 14;
constexpr int kSmoothings = 4;  // of the normals that determine a direction
constexpr int kLabelRounds = 6;
constexpr float kPull = 0.12f;           // of a neighbour, in cosines
constexpr std::size_t kSmallChart = 48;  // triangles
constexpr double kSmallShare = 1.5e-3;   // of the surface
constexpr float kJoinCosine = 0.45f;     // to the axis of the chart that absorbs a small one

std::array<Vec3f, kDirections> directions() {
  std::array<Vec3f, kDirections> out;
  std::size_t n = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {1.0f, -1.0f}) out[n++] = sign * Vec3f::Unit(axis);
  for (int corner = 0; corner < 8; ++corner)
    out[n++] =
        Vec3f(corner & 1 ? 1.0f : -1.0f, corner & 2 ? 1.0f : -1.0f, corner & 4 ? 1.0f : -1.0f)
            .normalized();
  return out;
}

/// Twice the area, along the normal.
Vec3f area_vector(const TriangleMesh& mesh, std::size_t t) {
  const auto& c = mesh.triangles[t];
  const Vec3f& a = mesh.vertices[c[0]];
  return (mesh.vertices[c[1]] - a).cross(mesh.vertices[c[2]] - a);
}

/// Normals of the surface around each triangle, with noise averaged out.
std::vector<Vec3f> smooth_normals(const TriangleMesh& mesh, const Neighbours& neighbours) {
  const std::size_t n = mesh.triangles.size();
  std::vector<Vec3f> now(n), next(n);
  parallel_for(n, 4096, [&](std::size_t t) { now[t] = area_vector(mesh, t); });
  for (int round = 0; round < kSmoothings; ++round) {
    parallel_for(n, 4096, [&](std::size_t t) {
      Vec3f sum = now[t];
      for (const std::uint32_t u : neighbours[t])
        if (u != kNoTriangle) sum += now[u];
      next[t] = sum;
    });
    now.swap(next);
  }
  for (Vec3f& v : now) {
    const float length = v.norm();
    v = length > 0.0f ? Vec3f(v / length) : Vec3f::Zero();
  }
  return now;
}

int best_direction(const Vec3f& normal, const std::array<Vec3f, kDirections>& all,
                   const std::array<float, kDirections>& pull) {
  int best = 0;
  float most = -1e9f;
  for (int d = 0; d < kDirections; ++d) {
    const float value = normal.dot(all[std::size_t(d)]) + pull[std::size_t(d)];
    if (value > most) most = value, best = d;
  }
  return best;
}

/// In the order of the triangles, each using the new labels of those before it.
std::vector<std::uint8_t> label_triangles(const std::vector<Vec3f>& normals,
                                          const Neighbours& neighbours) {
  const auto all = directions();
  std::vector<std::uint8_t> label(normals.size());
  for (std::size_t t = 0; t < normals.size(); ++t)
    label[t] = std::uint8_t(best_direction(normals[t], all, {}));
  for (int round = 0; round < kLabelRounds; ++round) {
    for (std::size_t t = 0; t < normals.size(); ++t) {
      std::array<float, kDirections> pull{};
      for (const std::uint32_t u : neighbours[t])
        if (u != kNoTriangle) pull[label[u]] += kPull;
      label[t] = std::uint8_t(best_direction(normals[t], all, pull));
    }
  }
  return label;
}

/// Charts numbered in the order of their first triangles, with the mean normal as axis.
Charts number_charts(const TriangleMesh& mesh, DisjointSets& sets) {
  Charts out;
  const std::size_t n = mesh.triangles.size();
  std::vector<std::uint32_t> number(n, kNoTriangle);
  std::vector<Vec3d> sums;
  out.of.resize(n);
  for (std::uint32_t t = 0; t < n; ++t) {
    std::uint32_t& own = number[sets.root(t)];
    if (own == kNoTriangle) {
      own = std::uint32_t(sums.size());
      sums.emplace_back(Vec3d::Zero());
    }
    out.of[t] = own;
    sums[own] += area_vector(mesh, t).cast<double>();
  }
  for (const Vec3d& sum : sums)
    out.axis.push_back(sum.norm() > 0.0 ? Vec3f(sum.normalized().cast<float>())
                                        : Vec3f(Vec3f::UnitY()));
  return out;
}

/// Triangles and area of each chart, and the lengths of its borders with the others.
struct ChartSizes {
  std::vector<std::size_t> triangles;
  std::vector<double> area;
  std::vector<std::map<std::uint32_t, double>> border;
};

ChartSizes measure(const TriangleMesh& mesh, const Neighbours& neighbours, const Charts& charts) {
  ChartSizes out;
  out.triangles.assign(charts.axis.size(), 0);
  out.area.assign(charts.axis.size(), 0.0);
  out.border.resize(charts.axis.size());
  for (std::size_t t = 0; t < charts.of.size(); ++t) {
    const std::uint32_t own = charts.of[t];
    ++out.triangles[own];
    out.area[own] += 0.5 * double(area_vector(mesh, t).norm());
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t u = neighbours[t][k];
      if (u == kNoTriangle || charts.of[u] == own) continue;
      const auto& c = mesh.triangles[t];
      out.border[own][charts.of[u]] +=
          double((mesh.vertices[c[(k + 1) % 3]] - mesh.vertices[c[k]]).norm());
    }
  }
  return out;
}

/// Whether nearly all of a chart's triangles are within the angle of another axis.
bool fits_axis(const std::vector<std::uint32_t>& triangles, const std::vector<Vec3f>& normals,
               const Vec3f& axis) {
  const auto fit = std::count_if(triangles.begin(), triangles.end(), [&](std::uint32_t t) {
    return normals[t].squaredNorm() == 0.0f || normals[t].dot(axis) >= kJoinCosine;
  });
  return fit * 50 >= std::ptrdiff_t(triangles.size()) * 49;
}

/// One round: each small chart joins the one with which it shares most of its border. Returns
/// whether one did.
bool join_small(const TriangleMesh& mesh, const Neighbours& neighbours,
                const std::vector<Vec3f>& normals, Charts& charts) {
  const ChartSizes sizes = measure(mesh, neighbours, charts);
  double total = 0.0;
  for (const double a : sizes.area) total += a;
  const auto small = [&](std::uint32_t c) {
    return sizes.triangles[c] < kSmallChart || sizes.area[c] < kSmallShare * total;
  };
  std::vector<std::vector<std::uint32_t>> members(charts.axis.size());
  for (std::uint32_t t = 0; t < charts.of.size(); ++t)
    if (small(charts.of[t])) members[charts.of[t]].push_back(t);
  std::vector<std::uint32_t> into(charts.axis.size());
  std::vector<std::uint8_t> fixed(charts.axis.size(), 0);  // has absorbed one, or has been absorbed
  bool any = false;
  for (std::uint32_t c = 0; c < into.size(); ++c) into[c] = c;
  for (std::uint32_t c = 0; c < into.size(); ++c) {
    if (!small(c) || fixed[c]) continue;
    std::uint32_t best = c;
    double longest = 0.0;
    for (const auto& [other, length] : sizes.border[c]) {
      if (length <= longest || into[other] != other) continue;
      if (!fits_axis(members[c], normals, charts.axis[other])) continue;
      best = other, longest = length;
    }
    if (best == c) continue;
    into[c] = best;
    fixed[best] = fixed[c] = 1;
    any = true;
  }
  if (!any) return false;
  DisjointSets sets(charts.of.size());
  std::vector<std::uint32_t> first(charts.axis.size(), kNoTriangle);
  for (std::uint32_t t = 0; t < charts.of.size(); ++t) {
    std::uint32_t& one = first[into[charts.of[t]]];
    if (one == kNoTriangle) one = t;
    sets.join(one, t);
  }
  charts = number_charts(mesh, sets);
  return true;
}

/// Triangles that are too oblique to their chart's axis.
std::vector<std::uint32_t> badly_seen(const std::vector<Vec3f>& normals, const Charts& charts) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t t = 0; t < charts.of.size(); ++t)
    if (normals[t].squaredNorm() > 0.0f &&
        !(normals[t].dot(charts.axis[charts.of[t]]) >= kMinChartCosine))
      out.push_back(t);
  return out;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> neighbours_of(const TriangleMesh& mesh) {
  struct Side {
    std::uint64_t vertices;
    std::uint32_t triangle;
    std::uint32_t k;
  };
  std::vector<Side> sides(mesh.triangles.size() * 3);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      sides[t * 3 + k] = {std::min(a, b) << 32 | std::max(a, b), std::uint32_t(t),
                          std::uint32_t(k)};
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.vertices != b.vertices ? a.vertices < b.vertices : a.triangle < b.triangle;
  });
  Neighbours out(mesh.triangles.size(), {kNoTriangle, kNoTriangle, kNoTriangle});
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].vertices == sides[i].vertices) ++end;
    if (end - i == 2 && sides[i].triangle != sides[i + 1].triangle) {
      out[sides[i].triangle][sides[i].k] = sides[i + 1].triangle;
      out[sides[i + 1].triangle][sides[i + 1].k] = sides[i].triangle;
    }
    i = end;
  }
  return out;
}

std::vector<Vec3f> face_normals(const TriangleMesh& mesh) {
  std::vector<Vec3f> out(mesh.triangles.size());
  parallel_for(out.size(), 4096, [&](std::size_t t) {
    const Vec3f n = area_vector(mesh, t);
    const float length = n.norm();
    out[t] = length > 0.0f ? Vec3f(n / length) : Vec3f(Vec3f::Zero());
  });
  return out;
}

void split_off(const TriangleMesh& mesh, const Neighbours& neighbours,
               const std::vector<std::uint32_t>& triangles, Charts& charts) {
  const auto all = directions();
  const std::vector<Vec3f> normals = face_normals(mesh);
  constexpr std::uint8_t kStays = 255;
  std::vector<std::uint8_t> label(charts.of.size(), kStays);
  for (const std::uint32_t t : triangles)
    label[t] = std::uint8_t(best_direction(normals[t], all, {}));
  DisjointSets sets(charts.of.size());
  for (std::uint32_t t = 0; t < charts.of.size(); ++t)
    for (const std::uint32_t u : neighbours[t])
      if (u != kNoTriangle && label[t] == label[u] && charts.of[t] == charts.of[u]) sets.join(t, u);
  // The rest of a chart remains one, even in several pieces: they did not overlap.
  std::vector<std::uint32_t> first(charts.axis.size(), kNoTriangle);
  for (std::uint32_t t = 0; t < charts.of.size(); ++t) {
    if (label[t] != kStays) continue;
    std::uint32_t& one = first[charts.of[t]];
    if (one == kNoTriangle) one = t;
    sets.join(one, t);
  }
  Charts out = number_charts(mesh, sets);
  // The rest keeps its axis, and thus its projection.
  for (std::uint32_t t = 0; t < charts.of.size(); ++t)
    if (label[t] == kStays) out.axis[out.of[t]] = charts.axis[charts.of[t]];
  charts = std::move(out);
}

Charts find_charts(const TriangleMesh& mesh, const Neighbours& neighbours) {
  const std::vector<Vec3f> smooth = smooth_normals(mesh, neighbours);
  const std::vector<std::uint8_t> label = label_triangles(smooth, neighbours);
  DisjointSets sets(mesh.triangles.size());
  for (std::uint32_t t = 0; t < label.size(); ++t)
    for (const std::uint32_t u : neighbours[t])
      if (u != kNoTriangle && label[t] == label[u]) sets.join(t, u);
  Charts charts = number_charts(mesh, sets);
  for (int round = 0; round < 8; ++round)
    if (!join_small(mesh, neighbours, smooth, charts)) break;
  const std::vector<Vec3f> normals = face_normals(mesh);
  // One of the 14 directions is within 36 degrees of any normal, and so is the mean of such
  // triangles.
  for (int round = 0; round < 8; ++round) {
    const auto bad = badly_seen(normals, charts);
    if (bad.empty()) break;
    split_off(mesh, neighbours, bad, charts);
  }
  return charts;
}

}  // namespace turnscan::texture
