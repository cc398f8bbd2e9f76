#include <algorithm>
#include <array>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/reconstruction/points/refine.hpp>
#include <turnscan/reconstruction/points/refine_kernel.hpp>

namespace turnscan::points {

namespace {

/// The compact weight (1 - r^2)^3 has the standard deviation of a Gaussian at this reach.
constexpr double kReach = 2.45;  // times radius_m
/// Tukey's biweight keeps 95 % efficiency at 4.685 sigma; the first step, whose site may still be
/// off the surface by some sigma, has twice the range.
constexpr double kTukey = 4.685;  // times noise_m
/// A measurement supports a surface if the incidence angle of its ray is below about 80 degrees.
constexpr float kFacing = 0.17f;
constexpr double kMinSupport = 0.1;  // relative to the median support

struct Site {
  Vec3d p, n;
  double support = 0.0;
  bool lost = false;
};

using Moments = std::array<double, refinement::kMoments>;

class Projector {
 public:
  Projector(const voxels::MeasuredCells& measurements, const RefineScale& scale)
      : measurements_(measurements), grid_(measurements.grid) {
    reach_ = kReach * scale.radius_m;
    height_ = std::max(kTukey * scale.noise_m, 0.5 * scale.radius_m);
  }

  /// One step: the site moves onto the fitted height field over its own tangent plane.
  void step(Site& site, double height_factor) const {
    if (site.lost) return;
    const Vec3d u = site.n.unitOrthogonal(), v = site.n.cross(u);
    const double height = height_factor * height_;
    const Moments s = collect(site, u, v, height);
    site.support = s[0];
    site.lost = site.support < 0.5;
    if (site.lost) return;
    const Eigen::Matrix<double, 6, 1> x = fit(s);
    site.lost = !x.allFinite() || std::abs(x[0]) > height;
    if (site.lost) return;
    site.p += x[0] * site.n;
    site.n = (site.n - x[1] / reach_ * u - x[2] / reach_ * v).normalized();
  }

 private:
  /// Least squares h = x0 + x1 x + x2 y + x3 xx + x4 xy + x5 yy. A ridge term suppresses slope and
  /// curvature if too few points support them.
  static estimation::Vector6d fit(const Moments& s) {
    estimation::Matrix6d a;
    a << s[0], s[1], s[2], s[3], s[4], s[5],    //
        s[1], s[3], s[4], s[6], s[7], s[8],     //
        s[2], s[4], s[5], s[7], s[8], s[9],     //
        s[3], s[6], s[7], s[10], s[11], s[12],  //
        s[4], s[7], s[8], s[11], s[12], s[13],  //
        s[5], s[8], s[9], s[12], s[13], s[14];
    estimation::Vector6d b;
    b << s[15], s[16], s[17], s[18], s[19], s[20];
    for (int k = 1; k < 3; ++k) a(k, k) += 0.1;
    for (int k = 3; k < 6; ++k) a(k, k) += 0.2;
    return estimation::solve_ldlt(a, b);
  }

  Moments collect(const Site& site, const Vec3d& u, const Vec3d& v, double height) const {
    refinement::TangentFrame frame;
    for (int a = 0; a < 3; ++a) {
      frame.p[a] = static_cast<float>(site.p[a]);
      frame.n[a] = static_cast<float>(site.n[a]);
      frame.u[a] = static_cast<float>(u[a]);
      frame.v[a] = static_cast<float>(v[a]);
    }
    frame.inverse_reach = static_cast<float>(1.0 / reach_);
    frame.inverse_height = static_cast<float>(1.0 / height);
    frame.facing = kFacing;
    // The bounding box of the cylinder, and the voxels in it that the cylinder may intersect.
    const double size = grid_.size_m();
    const Vec3d half = height * site.n.cwiseAbs() +
                       reach_ * (Vec3d::Ones() - site.n.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
    const voxels::VoxelIndex low = grid_.index_of(site.p - half);
    const voxels::VoxelIndex high = grid_.index_of(site.p + half);
    const double far = reach_ + 0.87 * size, far2 = far * far;
    refinement::MomentLanes lanes{};
    const refinement::RefineKernel& kernel = refinement::RefineKernels::current();
    // Consecutive voxels are consecutive in memory.
    std::uint32_t begin = 0, end = 0;
    grid_.for_each_in_box(low, high, [&](std::uint32_t i) {
      const voxels::VoxelGrid::Voxel& voxel = grid_.voxels()[i];
      const Vec3d d = grid_.center(voxel) - site.p;
      const double h = d.dot(site.n);
      if (d.squaredNorm() - h * h > far2 || std::abs(h) > height + 0.87 * size) return;
      if (voxel.begin != end) {
        if (begin < end) kernel.add_moments(measurements(), begin, end, frame, lanes);
        begin = voxel.begin;
      }
      end = voxel.end;
    });
    if (begin < end) kernel.add_moments(measurements(), begin, end, frame, lanes);
    Moments sums{};
    for (std::size_t m = 0; m < sums.size(); ++m) {
      for (const float value : lanes.sum[m]) sums[m] += value;
    }
    return sums;
  }

  refinement::Measurements measurements() const {
    const auto& c = measurements_.columns;
    return {c[0].data(), c[1].data(), c[2].data(), c[3].data(),
            c[4].data(), c[5].data(), c[6].data()};
  }

  const voxels::MeasuredCells& measurements_;
  const voxels::VoxelGrid& grid_;
  double reach_ = 0.0, height_ = 0.0;
};

double median_support(const std::vector<Site>& sites) {
  std::vector<double> support;
  for (const Site& site : sites) {
    if (!site.lost) support.push_back(site.support);
  }
  return median(support);
}

/// Merges those candidates of one voxel that have similar normals.
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

  /// Appends the groups as candidates and sites, and resets.
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

/// One candidate per voxel of the given size (and orientation).
Result<Candidates> thin(const Candidates& from, const std::vector<Site>& sites, double size_m,
                        std::vector<Site>& out_sites, const RunContext& context) {
  std::vector<Vec3f> points;
  std::vector<std::uint32_t> origin;
  const double least = kMinSupport * median_support(sites);
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    if (sites[i].lost || sites[i].support < least) continue;
    points.push_back(sites[i].p.cast<float>());
    origin.push_back(i);
  }
  if (points.empty())
    return fail(ErrorCode::kTooFewPoints,
                "refine: no candidate has enough measurements around it; the scan is too sparse "
                "for refine-radius, or use --no-refine");
  TURNSCAN_ASSIGN(const voxels::VoxelGrid grid, voxels::VoxelGrid::build(points, size_m, context));
  Candidates out;
  out_sites.clear();
  VoxelMeans means(from);
  for (const voxels::VoxelGrid::Voxel& voxel : grid.voxels()) {
    for (std::uint32_t k = voxel.begin; k < voxel.end; ++k) {
      const std::uint32_t i = origin[grid.order()[k]];
      means.add(sites[i], i);
    }
    means.flush(out, out_sites);
  }
  return out;
}

/// Of the layers of voxels over which noise spreads along the normal, the fullest is the best
/// start: drops candidates whose voxel has a fuller neighbour along their normal.
std::vector<Site> starting_sites(const voxels::VoxelGrid& grid, const Candidates& candidates) {
  std::vector<Site> sites(candidates.cloud.size());
  parallel_for(sites.size(), 1024, [&](std::size_t i) {
    Site& site = sites[i];
    site.p = candidates.cloud.points[i].cast<double>();
    site.n = candidates.cloud.normals[i].cast<double>();
    const std::uint32_t own = grid.voxels()[candidates.voxel[i]].count();
    site.support = candidates.cloud.weights[i];
    for (const double side : {-1.0, 1.0}) {
      const Vec3d q =
          grid.center(grid.voxels()[candidates.voxel[i]]) + side * grid.size_m() * site.n;
      const auto next = grid.find(grid.index_of(q));
      if (next >= 0 && grid.voxels()[std::size_t(next)].count() > own) site.lost = true;
    }
  });
  return sites;
}

}  // namespace

Result<Candidates> refine_candidates(const voxels::MeasuredCells& measurements,
                                     const voxels::VoxelGrid& grid, const Candidates& candidates,
                                     const RefineScale& scale, int iterations,
                                     const RunContext& context) {
  if (candidates.cloud.normals.size() != candidates.cloud.size())
    throw std::invalid_argument("refine_candidates: candidates need normals");
  const Projector projector(measurements, scale);
  // A surface that is smooth over radius_m needs no candidates much closer than that.
  const double spacing = std::max(grid.size_m(), 0.6 * scale.radius_m);
  std::vector<Site> sites;
  TURNSCAN_ASSIGN(Candidates current,
                  thin(candidates, starting_sites(grid, candidates), spacing, sites, context));
  for (int iteration = 0; iteration < iterations; ++iteration) {
    context.begin_phase("refine candidates", sites.size());
    TURNSCAN_TRY(parallel_for(sites.size(), 64, context, [&](std::size_t i) {
      projector.step(sites[i], iteration == 0 ? 2.0 : 1.0);
      context.advance();
    }));
    std::vector<Site> next;
    TURNSCAN_ASSIGN(current, thin(current, sites, spacing, next, context));
    sites.swap(next);
  }
  return current;
}

}  // namespace turnscan::points
