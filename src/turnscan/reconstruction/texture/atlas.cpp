#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/texture/atlas.hpp>
#include <turnscan/reconstruction/texture/chart_packing.hpp>
#include <turnscan/reconstruction/texture/charts.hpp>

namespace turnscan::texture {

namespace {

constexpr double kUsualFill = 0.55;  // share of the image that charts cover
constexpr int kScaleSteps = 9;
constexpr int kOverlapRounds = 12;

using Corners = std::array<Eigen::Vector2f, 3>;

/// The charts projected along their axes; metres, from the lower corner of each.
struct DrawnCharts {
  std::vector<Corners> corners;                       ///< per triangle
  std::vector<Eigen::Vector2f> size;                  ///< per chart
  std::vector<std::vector<std::uint32_t>> triangles;  ///< per chart
};

/// Right and down directions, with the axis towards the viewer; the chart's longer direction is
/// upright, since tall charts pack better.
struct ChartFrame {
  Vec3f right, down;
};

ChartFrame frame_of(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles,
                    const Vec3f& axis) {
  const Vec3f helper = std::abs(axis.y()) < 0.9f ? Vec3f::UnitY() : Vec3f::UnitX();
  const Vec3f a = helper.cross(axis).normalized(), b = axis.cross(a);
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double count = 0.0;
  for (const std::uint32_t t : triangles)
    for (const std::uint32_t v : mesh.triangles[t]) {
      const Eigen::Vector2d p(double(a.dot(mesh.vertices[v])), double(b.dot(mesh.vertices[v])));
      mean += p;
      spread += p * p.transpose();
      count += 1.0;
    }
  mean /= count;
  spread = spread / count - mean * mean.transpose();
  const double turn = 0.5 * std::atan2(2.0 * spread(0, 1), spread(0, 0) - spread(1, 1));
  const auto c = float(std::cos(turn)), s = float(std::sin(turn));
  const Vec3f along = c * a + s * b;
  return {along.cross(axis), -along};
}

DrawnCharts draw_charts(const TriangleMesh& mesh, const Charts& charts) {
  DrawnCharts out;
  out.corners.resize(mesh.triangles.size());
  out.size.resize(charts.axis.size());
  out.triangles.resize(charts.axis.size());
  for (std::uint32_t t = 0; t < charts.of.size(); ++t) out.triangles[charts.of[t]].push_back(t);
  parallel_for(charts.axis.size(), 1, [&](std::size_t chart) {
    const auto& own = out.triangles[chart];
    const ChartFrame frame = frame_of(mesh, own, charts.axis[chart]);
    Eigen::Vector2f least(1e30f, 1e30f), most(-1e30f, -1e30f);
    for (const std::uint32_t t : own)
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3f& p = mesh.vertices[mesh.triangles[t][k]];
        const Eigen::Vector2f place(frame.right.dot(p), frame.down.dot(p));
        out.corners[t][k] = place;
        least = least.cwiseMin(place);
        most = most.cwiseMax(place);
      }
    for (const std::uint32_t t : own)
      for (Eigen::Vector2f& place : out.corners[t]) place -= least;
    out.size[chart] = most - least;
  });
  return out;
}

Eigen::Vector2f snapped(const Eigen::Vector2f& texels) {
  return (texels * 256.0f).array().round().matrix() / 256.0f;
}

/// Corners of a chart, in texels from the corner of its squares.
Corners placed(const Corners& corners_m, double texels_per_m) {
  Corners out;
  for (std::size_t k = 0; k < 3; ++k)
    out[k] =
        snapped(corners_m[k] * float(texels_per_m)) + Eigen::Vector2f::Constant(float(kPadding_px));
  return out;
}

/// Adds the rows that a triangle covers within [left, right], widened by the padding.
void add_columns(const Corners& c, ChartOutline& outline) {
  const float pad = float(kPadding_px), block = float(kBlock_px);
  const auto [least, most] = std::minmax({c[0].x(), c[1].x(), c[2].x()});
  const int first = std::max(0, int(std::floor((least - pad) / block)));
  const int last = std::min(outline.width - 1, int(std::floor((most + pad) / block)));
  for (int column = first; column <= last; ++column) {
    const float left = float(column) * block - pad, right = float(column + 1) * block + pad;
    float low = 1e30f, high = -1e30f;
    for (std::size_t k = 0; k < 3; ++k) {
      Eigen::Vector2f a = c[k], b = c[(k + 1) % 3];
      if (a.x() > b.x()) std::swap(a, b);
      if (b.x() < left || a.x() > right) continue;
      const float slope = b.x() > a.x() ? (b.y() - a.y()) / (b.x() - a.x()) : 0.0f;
      const float at_left = a.x() < left ? a.y() + slope * (left - a.x()) : a.y();
      const float at_right = b.x() > right ? a.y() + slope * (right - a.x()) : b.y();
      low = std::min({low, at_left, at_right});
      high = std::max({high, at_left, at_right});
    }
    if (low > high) continue;
    std::int32_t& bottom = outline.bottom[std::size_t(column)];
    std::int32_t& top = outline.top[std::size_t(column)];
    bottom = std::min(bottom, std::max(0, int(std::floor((low - pad) / block))));
    top = std::max(top, int(std::floor((high + pad) / block)) + 1);
  }
}

ChartOutline outline_of(const DrawnCharts& drawn, std::size_t chart, double texels_per_m) {
  const auto blocks = [&](float metres) {
    return int(std::floor((double(metres) * texels_per_m + 0.01 + 2 * kPadding_px) / kBlock_px)) +
           1;
  };
  ChartOutline out;
  out.width = blocks(drawn.size[chart].x());
  out.height = blocks(drawn.size[chart].y());
  out.bottom.assign(std::size_t(out.width), out.height);
  out.top.assign(std::size_t(out.width), 0);
  for (const std::uint32_t t : drawn.triangles[chart])
    add_columns(placed(drawn.corners[t], texels_per_m), out);
  for (std::size_t c = 0; c < out.bottom.size(); ++c) {
    out.top[c] = std::min(out.top[c], out.height);
    if (out.bottom[c] > out.top[c]) out.bottom[c] = out.top[c] = 0;
  }
  return out;
}

std::optional<std::vector<ChartPlace>> pack_at(const DrawnCharts& drawn, double texels_per_m,
                                               int side) {
  for (const Eigen::Vector2f& size : drawn.size)
    if (double(size.maxCoeff()) * texels_per_m > side * kBlock_px) return std::nullopt;
  std::vector<ChartOutline> outlines(drawn.size.size());
  parallel_for(outlines.size(), 4,
               [&](std::size_t c) { outlines[c] = outline_of(drawn, c, texels_per_m); });
  return pack_charts(outlines, side);
}

struct Packing {
  double texels_per_m = 0.0;
  std::vector<ChartPlace> places;
};

/// The largest scale, to about a percent, at which all charts fit.
std::optional<Packing> pack_largest(const DrawnCharts& drawn, int side, double most) {
  double area = 0.0;
  for (const Corners& c : drawn.corners)
    area += 0.5 * std::abs(double((c[1] - c[0]).x()) * double((c[2] - c[0]).y()) -
                           double((c[2] - c[0]).x()) * double((c[1] - c[0]).y()));
  double high = std::min(most, double(side * kBlock_px) / std::sqrt(std::max(area, 1e-12)));
  if (auto places = pack_at(drawn, high, side)) return Packing{high, std::move(*places)};
  std::optional<Packing> best;
  double low = 0.0;
  for (int step = 0; step < kScaleSteps || (!best && step < 40); ++step) {
    const double middle = best ? 0.5 * (low + high) : 0.7 * high;
    auto places = pack_at(drawn, middle, side);
    if (places) {
      low = middle;
      best = Packing{middle, std::move(*places)};
    } else {
      high = middle;
    }
  }
  return best;
}

/// Triangles that cover a texel already covered by an earlier one of their chart.
std::vector<std::uint32_t> overlapping(const DrawnCharts& drawn, double texels_per_m) {
  std::vector<std::vector<std::uint32_t>> found(drawn.size.size());
  parallel_for(drawn.size.size(), 1, [&](std::size_t chart) {
    const Eigen::Vector2f size = drawn.size[chart] * float(texels_per_m);
    const int width = int(size.x()) + 2 * kPadding_px + 2;
    const int height = int(size.y()) + 2 * kPadding_px + 2;
    std::vector<std::uint8_t> covered(std::size_t(width) * std::size_t(height), 0);
    for (const std::uint32_t t : drawn.triangles[chart]) {
      const Corners corners = placed(drawn.corners[t], texels_per_m);
      bool twice = false;
      for_each_texel(corners, [&](int x, int y) {
        twice |= covered[std::size_t(y) * std::size_t(width) + std::size_t(x)] != 0;
      });
      if (twice) {
        found[chart].push_back(t);
        continue;
      }
      for_each_texel(corners, [&](int x, int y) {
        covered[std::size_t(y) * std::size_t(width) + std::size_t(x)] = 1;
      });
    }
  });
  std::vector<std::uint32_t> all;
  for (const auto& own : found) all.insert(all.end(), own.begin(), own.end());
  return all;
}

/// Largest over smallest singular value of the map from a triangle to the image.
double stretch_of(const std::vector<Vec3f>& normals, const Charts& charts) {
  double most = 1.0;
  for (std::size_t t = 0; t < normals.size(); ++t) {
    if (normals[t].squaredNorm() == 0.0f) continue;
    const auto cosine = double(normals[t].dot(charts.axis[charts.of[t]]));
    most = std::max(most, 1.0 / std::max(cosine, 1e-3));
  }
  return most;
}

Atlas finished(const DrawnCharts& drawn, const Charts& charts, const Packing& packing,
               int size_px) {
  Atlas atlas;
  atlas.size_px = size_px;
  atlas.chart = charts.of;
  atlas.charts = charts.axis.size();
  atlas.texels_per_m = packing.texels_per_m;
  atlas.corners.resize(drawn.corners.size());
  parallel_for(atlas.corners.size(), 4096, [&](std::size_t t) {
    const ChartPlace& place = packing.places[charts.of[t]];
    const Eigen::Vector2f offset(float(place.column * kBlock_px), float(place.row * kBlock_px));
    atlas.corners[t] = placed(drawn.corners[t], packing.texels_per_m);
    for (Eigen::Vector2f& corner : atlas.corners[t]) corner += offset;
  });
  return atlas;
}

}  // namespace

double expected_side_px(const TriangleMesh& mesh, double texels_per_m) {
  double area = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3f& a = mesh.vertices[t[0]];
    area += 0.5 * double((mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm());
  }
  return texels_per_m * std::sqrt(area / kUsualFill);
}

Result<Atlas> make_atlas(const TriangleMesh& mesh, int size_px, double texels_per_m,
                         const RunContext& context) {
  TURNSCAN_TRY(validate_mesh(mesh));
  const auto neighbours = neighbours_of(mesh);
  Charts charts = find_charts(mesh, neighbours);
  const int side = size_px / kBlock_px;
  for (int round = 0;; ++round) {
    TURNSCAN_TRY(context.check());
    const DrawnCharts drawn = draw_charts(mesh, charts);
    const auto packing = pack_largest(drawn, side, texels_per_m);
    if (!packing)
      return fail(ErrorCode::kResourceLimit,
                  "a texture of {} pixels a side does not hold the {} charts of the mesh; give a "
                  "larger --texture-size",
                  size_px, charts.axis.size());
    const auto twice = overlapping(drawn, packing->texels_per_m);
    if (twice.empty() || round == kOverlapRounds) {
      Atlas atlas = finished(drawn, charts, *packing, size_px);
      atlas.stretch = stretch_of(face_normals(mesh), charts);
      return atlas;
    }
    split_off(mesh, neighbours, twice, charts);
  }
}

}  // namespace turnscan::texture
