#include <Eigen/Cholesky>
#include <algorithm>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/refine.hpp>

namespace turnscan {

namespace {

/// Reach of the cylinder: beyond it Gaussian weights and Gaussian noise are negligible.
constexpr double kTangentialReach = 2.5;  // times radius_m
constexpr double kNormalReach = 3.5;      // times noise_m
/// A measurement supports a surface if its ray met it at less than about 80 degrees.
constexpr double kFacing = 0.17;
/// Tukey's biweight keeps 95 % efficiency at 4.685 sigma.
constexpr double kTukey = 4.685;
constexpr double kLeastSupport = 0.05;  // of the median support

struct Site {
  Vec3d p, n;
  double support = 0.0;
  bool lost = false;
};

struct Sums {
  Eigen::Matrix<double, 6, 6> a = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> b = Eigen::Matrix<double, 6, 1>::Zero();
};

class Projector {
 public:
  Projector(const MergedCloud& merged, const VoxelGrid& grid, const RefineScale& scale)
      : merged_(merged), grid_(grid), scale_(scale) {
    tangential_ = kTangentialReach * scale.radius_m;
    normal_ = std::max(kNormalReach * scale.noise_m, scale.radius_m);
    sorted_.reserve(grid.order().size());
    for (std::uint32_t i : grid.order()) sorted_.push_back(merged.cloud.points[i]);
  }

  /// One step: the site moves onto the fitted height field over its own tangent plane.
  void step(Site& site, bool robust) const {
    if (site.lost) return;
    const Vec3d u = site.n.unitOrthogonal(), v = site.n.cross(u);
    Sums sums = collect(site, u, v, robust);
    site.support = sums.a(0, 0);
    if (site.support < 3.0) {
      site.lost = true;
      return;
    }
    // A ridge lets the curvature terms fade where too few points carry them.
    const double r2 = scale_.radius_m * scale_.radius_m;
    for (int k = 1; k < 3; ++k) sums.a(k, k) += 0.5 * r2;
    for (int k = 3; k < 6; ++k) sums.a(k, k) += 4.0 * r2 * r2;
    const Eigen::Matrix<double, 6, 1> x = sums.a.ldlt().solve(sums.b);
    if (!x.allFinite() || std::abs(x[0]) > normal_) {
      site.lost = true;
      return;
    }
    site.p += x[0] * site.n;
    site.n = (site.n - x[1] * u - x[2] * v).normalized();
  }

 private:
  Sums collect(const Site& site, const Vec3d& u, const Vec3d& v, bool robust) const {
    const double size = grid_.size_m();
    // The box of the cylinder.
    const Vec3d half = normal_ * site.n.cwiseAbs() +
                       tangential_ * (Vec3d::Ones() - site.n.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
    const VoxelIndex low = ((site.p - half) / size).array().floor().cast<int>();
    const VoxelIndex high = ((site.p + half) / size).array().floor().cast<int>();
    const double far = tangential_ + 0.87 * size, far2 = far * far;
    Sums sums;
    grid_.for_each_in_box(low, high, [&](std::uint32_t i) {
      const VoxelGrid::Voxel& voxel = grid_.voxels()[i];
      const Vec3d d = grid_.center(voxel) - site.p;
      const double h = d.dot(site.n);
      if (d.squaredNorm() - h * h > far2) return;
      for (std::uint32_t k = voxel.begin; k < voxel.end; ++k) add(site, u, v, k, robust, sums);
    });
    return sums;
  }

  void add(const Site& site, const Vec3d& u, const Vec3d& v, std::uint32_t k, bool robust,
           Sums& sums) const {
    const Vec3d q = sorted_[k].cast<double>();
    const Vec3d d = q - site.p;
    const double h = d.dot(site.n);
    if (std::abs(h) > normal_) return;
    const double x = d.dot(u), y = d.dot(v), r2 = x * x + y * y;
    if (r2 > tangential_ * tangential_) return;
    const Viewpoint& view = merged_.viewpoints[merged_.cloud.frame[grid_.order()[k]]];
    if (view.direction_from(q).dot(site.n) < kFacing) return;
    double w = std::exp(-0.5 * r2 / (scale_.radius_m * scale_.radius_m));
    if (robust) {
      const double c = std::max(kTukey * scale_.noise_m, 1e-9), t = 1.0 - (h / c) * (h / c);
      if (t <= 0.0) return;
      w *= t * t;
    }
    Eigen::Matrix<double, 6, 1> basis;
    basis << 1.0, x, y, x * x, x * y, y * y;
    sums.a.noalias() += w * basis * basis.transpose();
    sums.b.noalias() += (w * h) * basis;
  }

  const MergedCloud& merged_;
  const VoxelGrid& grid_;
  RefineScale scale_;
  double tangential_ = 0.0, normal_ = 0.0;
  std::vector<Vec3f> sorted_;  ///< in the grid's order: neighbours lie together in memory
};

double median_support(const std::vector<Site>& sites) {
  std::vector<double> support;
  for (const Site& site : sites) {
    if (!site.lost) support.push_back(site.support);
  }
  if (support.empty()) return 0.0;
  const auto middle = support.begin() + std::ptrdiff_t(support.size() / 2);
  std::nth_element(support.begin(), middle, support.end());
  return *middle;
}

/// Joins those candidates of one voxel that face the same way.
class VoxelMeans {
 public:
  explicit VoxelMeans(const Candidates& from) : from_(from) {}

  void add(const Site& site, std::uint32_t i) {
    for (Group& g : groups_) {
      if (g.n.dot(site.n) < 0.5 * g.n.norm()) continue;
      join(g, site, i);
      return;
    }
    groups_.push_back({});
    join(groups_.back(), site, i);
  }

  /// Appends the groups as candidates and sites and starts anew.
  void flush(Candidates& out, std::vector<Site>& sites) {
    for (const Group& g : groups_) {
      Site site{g.p / g.weight, g.n.normalized(), g.support / g.weight, false};
      sites.push_back(site);
      out.cloud.points.push_back(site.p.cast<float>());
      out.cloud.normals.push_back(site.n.cast<float>());
      out.cloud.weights.push_back(static_cast<float>(g.weight));
      if (!from_.cloud.colors.empty()) {
        const Vec3d c = (g.color / g.weight).array() + 0.5;
        out.cloud.colors.push_back({std::uint8_t(c.x()), std::uint8_t(c.y()), std::uint8_t(c.z())});
      }
      out.towards_sensor.push_back((g.towards / g.weight).cast<float>());
      out.voxel.push_back(g.voxel);
    }
    groups_.clear();
  }

 private:
  struct Group {
    Vec3d p = Vec3d::Zero(), n = Vec3d::Zero(), towards = Vec3d::Zero(), color = Vec3d::Zero();
    double weight = 0.0, support = 0.0;
    std::uint32_t voxel = 0;
  };

  void join(Group& g, const Site& site, std::uint32_t i) {
    const double w = std::max(1e-6f, from_.cloud.weights[i]);
    if (g.weight == 0.0) g.voxel = from_.voxel[i];
    g.p += w * site.p;
    g.n += w * site.n;
    g.towards += w * from_.towards_sensor[i].cast<double>();
    if (!from_.cloud.colors.empty()) {
      const Rgb& c = from_.cloud.colors[i];
      g.color += w * Vec3d(c.r, c.g, c.b);
    }
    g.weight += w;
    g.support += w * site.support;
  }

  const Candidates& from_;
  std::vector<Group> groups_;
};

/// One candidate per voxel of the given size (and facing).
Result<Candidates> thin(const Candidates& from, const std::vector<Site>& sites, double size_m,
                        std::vector<Site>& out_sites, const RunContext& context) {
  std::vector<Vec3f> points;
  std::vector<std::uint32_t> origin;
  const double least = kLeastSupport * median_support(sites);
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    if (sites[i].lost || sites[i].support < least) continue;
    points.push_back(sites[i].p.cast<float>());
    origin.push_back(i);
  }
  if (points.empty())
    return fail(ErrorCode::kTooFewPoints,
                "refine: no candidate has enough measurements around it; the scan is too sparse "
                "for refine-radius, or use --no-refine");
  TURNSCAN_ASSIGN(const VoxelGrid grid, VoxelGrid::build(points, size_m, context));
  Candidates out;
  out_sites.clear();
  VoxelMeans means(from);
  for (const VoxelGrid::Voxel& voxel : grid.voxels()) {
    for (std::uint32_t k = voxel.begin; k < voxel.end; ++k) {
      const std::uint32_t i = origin[grid.order()[k]];
      means.add(sites[i], i);
    }
    means.flush(out, out_sites);
  }
  return out;
}

}  // namespace

OptionTable describe(RefineOptions& o) {
  OptionTable table;
  table.flag("refine", o.enabled, "Move candidates onto the local surface of the measurements")
      .number(
          "refine-radius", o.radius_m, Quantity::kLength, {1e-5, 1.0},
          "Standard deviation of the weight along the surface; automatic: from noise and density")
      .number("refine-iterations", o.iterations, {1, 20}, "Projection steps");
  return table;
}

Result<Candidates> refine_candidates(const MergedCloud& merged, const VoxelGrid& grid,
                                     const Candidates& candidates, const RefineScale& scale,
                                     int iterations, const RunContext& context) {
  if (candidates.cloud.normals.size() != candidates.cloud.size())
    throw std::invalid_argument("refine_candidates: candidates need normals");
  const double cell = std::max(scale.radius_m, 0.5 * grid.size_m());
  TURNSCAN_ASSIGN(const VoxelGrid index, VoxelGrid::build(merged.cloud.points, cell, context));
  const Projector projector(merged, index, scale);
  Candidates current = candidates;
  std::vector<Site> sites(current.cloud.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    sites[i].p = current.cloud.points[i].cast<double>();
    sites[i].n = current.cloud.normals[i].cast<double>();
  }
  for (int iteration = 0; iteration < iterations; ++iteration) {
    context.begin_phase("refine candidates", sites.size());
    parallel_for(sites.size(), 64, [&](std::size_t i) {
      if (context.cancelled()) return;
      projector.step(sites[i], iteration > 0);
      context.advance();
    });
    TURNSCAN_TRY(context.check());
    std::vector<Site> next;
    TURNSCAN_ASSIGN(current, thin(current, sites, grid.size_m(), next, context));
    sites.swap(next);
  }
  return current;
}

}  // namespace turnscan
