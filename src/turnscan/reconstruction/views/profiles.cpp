#include <algorithm>
#include <cmath>
#include <numbers>
#include <turnscan/core/median.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/reconstruction/views/profiles.hpp>
#include <turnscan/reconstruction/views/scan_surface.hpp>

namespace turnscan::views {

namespace {

/// Maximum thickness of a sheet, seen from the viewpoint, relative to its width.
constexpr double kThickestOfWidth = 0.01;
/// Maximum difference of the viewing directions of a group's profiles...
const double kMinGroupCosine = std::cos(8.0 * std::numbers::pi / 180.0);
/// ... except for fast rotations; and their maximum number.
constexpr std::size_t kMinProfiles = 3, kMaxProfiles = 128;

/// Position of a point along the line: an angle, or a length if rays are parallel.
double position_along(const LightSheet& sheet, const Viewpoint& eye, const Vec3f& p) {
  if (eye.parallel) return sheet.across.dot(p.cast<double>());
  const Vec3d d = p.cast<double>() - eye.value;
  return std::atan2(sheet.across.dot(d), sheet.along.dot(d));
}

Vec3d mean_of(const std::vector<Vec3f>& points) {
  Vec3d sum = Vec3d::Zero();
  for (const Vec3f& p : points) sum += p.cast<double>();
  return sum / double(std::max<std::size_t>(1, points.size()));
}

/// A strip of triangles between two rows of points, each in its order along the line.
void join_rows(const FramePoints& a, const FramePoints& b, std::uint32_t first_a,
               std::uint32_t first_b, const std::vector<double>& position,
               std::vector<std::array<std::uint32_t, 3>>& triangles) {
  if (a.cell.empty() || b.cell.empty()) return;
  const auto follows = [](const FramePoints& row, std::size_t i) {
    return row.cell[i + 1] == row.cell[i] + 1;
  };
  std::size_t i = 0, j = 0;
  while (i + 1 < a.cell.size() || j + 1 < b.cell.size()) {
    const auto at_a = std::uint32_t(first_a + i), at_b = std::uint32_t(first_b + j);
    const bool take_a = j + 1 == b.cell.size() ||
                        (i + 1 < a.cell.size() && position[at_a + 1] <= position[at_b + 1]);
    if (take_a) {
      if (follows(a, i)) triangles.push_back({at_a, at_a + 1, at_b});
      ++i;
    } else {
      if (follows(b, j)) triangles.push_back({at_a, at_b, at_b + 1});
      ++j;
    }
  }
}

}  // namespace

std::optional<LightSheet> find_sheet(const FramePoints& points) {
  const auto& p = points.cloud.points;
  if (p.size() < 10 || (points.width > 1 && points.height > 1)) return std::nullopt;
  const Viewpoint& eye = points.viewpoint;
  const Vec3d center = mean_of(p);
  const Vec3d away = eye.parallel ? Vec3d(-eye.value) : Vec3d((center - eye.value).normalized());
  // On the plane that faces the viewpoint, the projected points form a line.
  std::vector<Vec3d> seen;
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const Vec3f& q : p) {
    Vec3d d = q.cast<double>() - (eye.parallel ? center : eye.value);
    const double depth = d.dot(away);
    if (!eye.parallel) {
      if (!(depth > 0.0)) return std::nullopt;
      d /= depth;
    }
    seen.push_back(d - d.dot(away) * away);
    squares += seen.back() * seen.back().transpose();
  }
  const Vec3d line = estimation::symmetric_eigen(squares).vectors.col(2), thick = away.cross(line);
  std::vector<double> width, thickness;
  for (const Vec3d& d : seen) {
    width.push_back(std::abs(line.dot(d)));
    thickness.push_back(std::abs(thick.dot(d)));
  }
  const double wide = median(width);
  std::nth_element(thickness.begin(), thickness.end() - 1, thickness.end());
  if (!(wide > 0.0) || thickness.back() > kThickestOfWidth * wide) return std::nullopt;
  return LightSheet{away, line};
}

FramePoints in_sheet_order(const FramePoints& points, const LightSheet& sheet) {
  const std::size_t n = points.cloud.size();
  std::vector<std::pair<double, std::uint32_t>> order(n);
  for (std::uint32_t i = 0; i < n; ++i)
    order[i] = {position_along(sheet, points.viewpoint, points.cloud.points[i]), i};
  std::sort(order.begin(), order.end());
  std::vector<double> steps;
  for (std::size_t i = 1; i < n; ++i) steps.push_back(order[i].first - order[i - 1].first);
  const double usual = median(steps);
  FramePoints out;
  out.viewpoint = points.viewpoint;
  out.height = 1;
  std::int32_t cell = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0) cell += order[i].first - order[i - 1].first > 3.0 * usual ? 2 : 1;
    out.cell.push_back(cell);
    out.cloud.points.push_back(points.cloud.points[order[i].second]);
    if (!points.cloud.colors.empty())
      out.cloud.colors.push_back(points.cloud.colors[order[i].second]);
  }
  out.width = cell + 1;
  return out;
}

bool ProfileGroups::fits(const Profile& profile) const {
  if (group_.size() >= kMaxProfiles) return false;
  const Profile& first = group_.front();
  const auto& points = first.points.cloud.points.empty() ? profile.points : first.points;
  const Vec3d middle = (first.points.cloud.points.empty() ? profile : first).T_table_sensor *
                       mean_of(points.cloud.points);
  const auto direction = [&](const Profile& p) {
    return p.points.viewpoint.transformed(p.T_table_sensor).direction_from(middle);
  };
  return group_.size() < kMinProfiles || direction(first).dot(direction(profile)) > kMinGroupCosine;
}

std::vector<Profile> ProfileGroups::add(Profile profile) {
  std::vector<Profile> done;
  if (!group_.empty() && !fits(profile)) {
    done = std::move(group_);
    group_ = {done.back()};
  }
  group_.push_back(std::move(profile));
  return done;
}

std::vector<Profile> ProfileGroups::flush() { return std::exchange(group_, {}); }

DepthView view_of_profiles(std::span<const Profile> group, const LightSheet& sheet,
                           const ViewScale& scale) {
  if (group.empty()) return {};
  const Profile& middle = group[group.size() / 2];
  const Pose T_middle_table = middle.T_table_sensor.inverse();
  ScanSurface surface;
  surface.viewpoint = middle.points.viewpoint;
  std::vector<std::uint32_t> first;
  std::vector<double> position;
  for (const Profile& profile : group) {
    first.push_back(std::uint32_t(surface.points.size()));
    const Pose T_middle_own = T_middle_table * profile.T_table_sensor;
    for (const Vec3f& p : profile.points.cloud.points) {
      surface.points.push_back((T_middle_own * p.cast<double>()).cast<float>());
      position.push_back(position_along(sheet, profile.points.viewpoint, p));
    }
    if (scale.colored)
      surface.colors.insert(surface.colors.end(), profile.points.cloud.colors.begin(),
                            profile.points.cloud.colors.end());
  }
  if (surface.points.empty()) return {};
  if (surface.colors.size() != surface.points.size()) surface.colors.clear();
  for (std::size_t k = 1; k < group.size(); ++k) {
    join_rows(group[k - 1].points, group[k].points, first[k - 1], first[k], position,
              surface.triangles);
  }
  return view_of_surface(surface, middle.T_table_sensor, 0.5 * scale.spacing_m, scale.edge_step_m);
}

}  // namespace turnscan::views
