#include "explorer/inspection/measure_tool.hpp"

#include <QFontMetricsF>
#include <QPainter>
#include <QPainterPath>
#include <cmath>
#include <numbers>

namespace turnscan::studio {

namespace {

const QColor kMark(0xd2453c), kHighlight(0x1f6fd0);

std::vector<QPointF> pixels_of(const SceneView& view, const std::vector<Vec3d>& places) {
  std::vector<QPointF> out;
  for (const Vec3d& p : places)
    if (const auto pixel = view.project(p)) out.push_back(*pixel);
  return out;
}

/// Outline of a circle, or of the patch of a plane.
std::vector<Vec3d> ring_of(const Vec3d& center, const Vec3d& normal, double radius) {
  constexpr int kSides = 72;
  const Vec3d u = normal.unitOrthogonal(), v = normal.cross(u);
  std::vector<Vec3d> out;
  for (int i = 0; i <= kSides; ++i) {
    const double a = 2.0 * std::numbers::pi * i / kSides;
    out.push_back(center + radius * (std::cos(a) * u + std::sin(a) * v));
  }
  return out;
}

std::vector<Vec3d> line_of(const Measurement& m) {
  if (m.kind == MeasurementKind::kCircle)
    return ring_of(m.circle.center, m.circle.normal, m.circle.radius_m);
  if (m.kind == MeasurementKind::kPlane) {
    const double radius = std::max(1e-3, (m.places[0] - m.plane.point).norm() + 0.003);
    return ring_of(m.plane.point, m.plane.normal, radius);
  }
  return m.places;
}

void paint_text_card(QPainter& painter, const QPointF& at, const QString& text,
                     const QColor& color) {
  const QFontMetricsF metrics(painter.font());
  const QRectF card(at + QPointF(10, -26), QSizeF(metrics.horizontalAdvance(text) + 14, 22));
  painter.setPen(QPen(color, 1));
  painter.setBrush(QColor(255, 255, 255, 235));
  painter.drawRoundedRect(card, 5, 5);
  painter.setPen(QColor(0x1d2630));
  painter.drawText(card, Qt::AlignCenter, text);
}

}  // namespace

MeasureTool::MeasureTool(SceneView& view, std::function<void()> clicked, Done done)
    : view_(view), clicked_(std::move(clicked)), done_(std::move(done)) {}

void MeasureTool::begin(std::size_t count) {
  count_ = count;
  places_.clear();
  view_.update_overlay();
}

bool MeasureTool::press(const QPointF& at, Qt::KeyboardModifiers keys) {
  if (keys != Qt::NoModifier) return false;
  const auto place = view_.pick(at);
  if (!place) return false;
  places_.push_back(*place);
  view_.update_overlay();
  if (places_.size() < count_) {
    clicked_();
    return true;
  }
  const std::vector<Vec3d> all = std::move(places_);
  places_.clear();
  clicked_();
  done_(all);
  return true;
}

void MeasureTool::paint(QPainter& painter) {
  const auto pixels = pixels_of(view_, places_);
  painter.setPen(QPen(kMark, 2));
  painter.setBrush(kMark);
  for (std::size_t i = 1; i < pixels.size(); ++i) painter.drawLine(pixels[i - 1], pixels[i]);
  for (const QPointF& pixel : pixels) painter.drawEllipse(pixel, 4, 4);
}

void paint_measurement(QPainter& painter, const SceneView& view, const Measurement& measurement,
                       const QString& text, bool highlighted) {
  const QColor color = highlighted ? kHighlight : kMark;
  const auto line = pixels_of(view, line_of(measurement));
  const auto places = pixels_of(view, measurement.places);
  if (places.empty()) return;
  painter.setPen(QPen(color, highlighted ? 3 : 2));
  painter.setBrush(Qt::NoBrush);
  for (std::size_t i = 1; i < line.size(); ++i) painter.drawLine(line[i - 1], line[i]);
  painter.setBrush(color);
  for (const QPointF& pixel : places) painter.drawEllipse(pixel, 3.5, 3.5);
  QPointF middle = measurement.kind == MeasurementKind::kAngle && places.size() == 3
                       ? places[1]
                       : 0.5 * (places.front() + places.back());
  paint_text_card(painter, middle, text, color);
}

}  // namespace turnscan::studio
