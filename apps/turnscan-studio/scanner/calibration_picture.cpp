#include "scanner/calibration_picture.hpp"

#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>

#include "scanner/live_picture.hpp"

namespace turnscan::studio {

namespace {

constexpr int kRingPieces = 120;
constexpr double kResidualScale_m = 0.003;  // at the ends of the colour range
constexpr double kPlatterReach_m = 0.008;   // maximum distance of platter points from its plane
constexpr double kRimMargin_m = 0.003;

QColor color_of_residual(double residual_m) {
  const double share = std::clamp(residual_m / kResidualScale_m, -1.0, 1.0);
  const QColor middle(196, 206, 200), above(200, 78, 60), below(52, 104, 178);
  const QColor& end = share < 0.0 ? below : above;
  const double t = std::abs(share);
  return {int((1 - t) * middle.red() + t * end.red()),
          int((1 - t) * middle.green() + t * end.green()),
          int((1 - t) * middle.blue() + t * end.blue())};
}

}  // namespace

DrawablePtr averaged_picture(const AveragedScan& scan, const TurntableInfo* table) {
  const FramePoints points = points_of(scan);
  LivePicture picture = live_picture(points, std::nullopt, points.cloud.size());
  PointCloud& cloud = picture.cloud;
  if (table) {
    const double radius = table->radius_m.value_or(0.0) + kRimMargin_m;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Vec3d away = cloud.points[i].cast<double>() - table->center_m;
      const double height = away.dot(table->axis);
      if (std::abs(height) > kPlatterReach_m || (away - height * table->axis).norm() > radius)
        continue;
      const QColor color = color_of_residual(height);
      cloud.colors[i] = {std::uint8_t(color.red()), std::uint8_t(color.green()),
                         std::uint8_t(color.blue())};
    }
  }
  return make_drawable(picture, 1.0 / scan.intrinsics.fx);
}

Legend residual_legend() {
  Legend legend;
  legend.title = QObject::tr("Above the plane");
  legend.continuous = true;
  for (const double share : {-1.0, 0.0, 1.0})
    legend.entries.push_back({color_of_residual(share * kResidualScale_m),
                              QObject::tr("%1 mm").arg(1e3 * share * kResidualScale_m, 0, 'g', 2)});
  return legend;
}

Segments table_outline(const TurntableInfo& table) {
  Segments lines;
  const double radius = table.radius_m.value_or(0.1);
  const Vec3d u = table.axis.unitOrthogonal(), v = table.axis.cross(u);
  for (int i = 0; i < kRingPieces; ++i) {
    const double a = kTurn * i / kRingPieces;
    const double b = kTurn * (i + 1) / kRingPieces;
    lines.add(table.center_m + radius * (std::cos(a) * u + std::sin(a) * v),
              table.center_m + radius * (std::cos(b) * u + std::sin(b) * v));
  }
  lines.add(table.center_m, table.center_m + 0.8 * radius * table.axis);
  lines.add(table.center_m - 0.08 * radius * u, table.center_m + 0.08 * radius * u);
  lines.add(table.center_m - 0.08 * radius * v, table.center_m + 0.08 * radius * v);
  return lines;
}

}  // namespace turnscan::studio
