// Painted over the picture: scale bar, axes, legend, hints.

#include <QFontMetricsF>
#include <QLinearGradient>
#include <algorithm>
#include <cmath>

#include "view/scene_view_parts.hpp"

namespace turnscan::studio {

namespace {

constexpr double kMargin = 16.0;

/// The largest of 1, 2, 5 times a power of ten that does not exceed `length`.
double round_length(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  for (const double step : {5.0, 2.0})
    if (step * power <= length) return step * power;
  return power;
}

QString length_text(double metres) {
  if (metres >= 1.0) return QString("%1 m").arg(metres, 0, 'g', 4);
  return QString("%1 mm").arg(1e3 * metres, 0, 'g', 4);
}

void paint_card(QPainter& painter, const QRectF& rect, const Theme& theme) {
  QColor fill = theme.panel;
  fill.setAlpha(225);
  painter.setPen(QPen(theme.line, 1));
  painter.setBrush(fill);
  painter.drawRoundedRect(rect, 7, 7);
}

/// The colours of a continuous legend, low values at the bottom; with a histogram a narrow bar, and
/// its shares next to it.
void paint_color_bar(QPainter& painter, const Legend& legend, const QRectF& bar) {
  std::vector<QColor> colors = legend.bar;
  if (colors.empty())
    for (const auto& entry : legend.entries) colors.push_back(entry.color);
  const std::size_t n = colors.size();
  QLinearGradient gradient(0, bar.top(), 0, bar.bottom());
  for (std::size_t i = 0; i < n; ++i)
    gradient.setColorAt(1.0 - double(i) / double(std::max<std::size_t>(1, n - 1)), colors[i]);
  painter.setPen(Qt::NoPen);
  painter.setBrush(gradient);
  if (legend.histogram.empty()) {
    painter.drawRect(bar);
    return;
  }
  double most = 1e-12;
  for (const double share : legend.histogram) most = std::max(most, share);
  const double step = bar.height() / double(legend.histogram.size());
  painter.drawRect(QRectF(bar.left(), bar.top(), 10, bar.height()));
  for (std::size_t i = 0; i < legend.histogram.size(); ++i) {
    const double length = (bar.width() - 14) * legend.histogram[i] / most;
    painter.drawRect(QRectF(bar.left() + 14, bar.bottom() - double(i + 1) * step, length, step));
  }
}

}  // namespace

void SceneView::paint_overlay(QPainter& painter) {
  painter.setRenderHint(QPainter::Antialiasing);
  paint_texts(painter);
  if (!scene_box().empty()) {
    paint_scale_bar(painter);
    paint_axes(painter);
  }
  if (!parts_->legend.entries.empty()) paint_legend(painter);
  if (parts_->marks) parts_->marks(painter);
  if (tool_) tool_->paint(painter);
  if (!focus_shown_) return;
  painter.setPen(QPen(parts_->theme->accent, 2));
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(QRectF(rect()).adjusted(1, 1, -1, -1));
}

void SceneView::paint_scale_bar(QPainter& painter) {
  const double scale = metres_per_pixel();
  const double length = round_length(140.0 * scale), pixels = length / scale;
  const double x = kMargin, y = height() - kMargin;
  painter.setPen(QPen(parts_->theme->text, 2));
  painter.drawLine(QPointF(x, y), QPointF(x + pixels, y));
  painter.drawLine(QPointF(x, y - 5), QPointF(x, y));
  painter.drawLine(QPointF(x + pixels, y - 5), QPointF(x + pixels, y));
  painter.drawText(QRectF(x, y - 26, pixels, 20), Qt::AlignHCenter | Qt::AlignBottom,
                   length_text(length));
}

void SceneView::paint_axes(QPainter& painter) {
  Vec3d position, focus;
  parts_->camera->GetPosition(position.data());
  parts_->camera->GetFocalPoint(focus.data());
  const Vec3d forward = (focus - position).normalized();
  const Vec3d right = forward.cross(parts_->up).normalized(), up = right.cross(forward);
  const QPointF center(width() - 56.0, height() - 52.0);
  const std::array<QColor, 3> colors{QColor(0xcf4a42), QColor(0x4a9a55), QColor(0x3f72c4)};
  const std::array<QString, 3> names{"X", "Y", "Z"};
  for (int axis = 0; axis < 3; ++axis) {
    const QPointF tip = center + 26.0 * QPointF(right[axis], -up[axis]);
    painter.setPen(QPen(colors[std::size_t(axis)], 2));
    painter.drawLine(center, tip);
    const QPointF at = center + 36.0 * QPointF(right[axis], -up[axis]);
    if (std::hypot(right[axis], up[axis]) > 0.25)
      painter.drawText(QRectF(at.x() - 8, at.y() - 8, 16, 16), Qt::AlignCenter,
                       names[std::size_t(axis)]);
  }
}

void SceneView::paint_legend(QPainter& painter) {
  const Legend& legend = parts_->legend;
  const QFontMetricsF metrics(painter.font());
  const double row = std::max(18.0, metrics.height() + 3.0);
  const double bar_width = legend.histogram.empty() ? 14.0 : 80.0;
  double text_width = 0.0;
  for (const auto& entry : legend.entries)
    text_width = std::max(text_width, metrics.horizontalAdvance(entry.text));
  const double wide =
      std::max(metrics.horizontalAdvance(legend.title), bar_width + 10 + text_width) + 24;
  const double rows = double(legend.entries.size()) * row;
  const QRectF card(width() - kMargin - wide, kMargin, wide, rows + row + 22);
  paint_card(painter, card, *parts_->theme);
  painter.setPen(parts_->theme->text);
  painter.drawText(QRectF(card.left() + 12, card.top() + 8, wide, row), Qt::AlignVCenter,
                   legend.title);
  const double x = card.left() + 12, top = card.top() + row + 12;
  const std::size_t n = legend.entries.size();
  if (legend.continuous)
    paint_color_bar(painter, legend, QRectF(x, top + 0.5 * row, bar_width, rows - row));
  for (std::size_t i = 0; i < n; ++i) {
    const double y = top + double(legend.continuous ? n - 1 - i : i) * row;
    if (!legend.continuous) {
      painter.setPen(Qt::NoPen);
      painter.setBrush(legend.entries[i].color);
      painter.drawRoundedRect(QRectF(x, y + 0.5 * row - 6, 12, 12), 3, 3);
    }
    painter.setPen(parts_->theme->text);
    painter.drawText(QRectF(x + bar_width + 8, y, text_width + 8, row), Qt::AlignVCenter,
                     legend.entries[i].text);
  }
}

/// Below the text in the middle, while nothing else is shown.
void SceneView::place_actions() {
  QWidget* actions = parts_->empty_actions;
  if (!actions) return;
  const bool empty = scene_box().empty();
  actions->setVisible(empty);
  if (!empty) return;
  const QSize size = actions->sizeHint();
  actions->setGeometry(QRect(QPoint((width() - size.width()) / 2, height() / 2 + 34), size));
  actions->raise();
}

void SceneView::paint_texts(QPainter& painter) {
  const Theme& theme = *parts_->theme;
  if (scene_box().empty() && !parts_->empty_title.isEmpty()) {
    QFont big = painter.font();
    const QFont plain = big;
    big.setPointSizeF(1.6 * big.pointSizeF());
    big.setWeight(QFont::DemiBold);
    painter.setFont(big);
    painter.setPen(theme.text);
    const QRectF middle(40, 0.5 * height() - 60, width() - 80, 40);
    painter.drawText(middle, Qt::AlignCenter, parts_->empty_title);
    painter.setFont(plain);
    painter.setPen(theme.quiet_text);
    painter.drawText(QRectF(40, 0.5 * height() - 12, width() - 80, 120),
                     Qt::AlignHCenter | Qt::AlignTop | Qt::TextWordWrap, parts_->empty_text);
  }
  if (parts_->split) {
    painter.setPen(QPen(theme.line, 2));
    painter.drawLine(QPointF(0.5 * width(), 0), QPointF(0.5 * width(), height()));
    painter.setPen(theme.text);
    for (int pane = 0; pane < 2; ++pane)
      painter.drawText(QRectF(0.5 * pane * width() + kMargin, kMargin, 0.5 * width(), 20),
                       Qt::AlignLeft | Qt::AlignVCenter, parts_->pane_titles[std::size_t(pane)]);
  }
  if (parts_->hint.isEmpty()) return;
  const double wide = QFontMetricsF(painter.font()).horizontalAdvance(parts_->hint) + 32;
  const QRectF card(0.5 * (width() - wide), kMargin, wide, 32);
  paint_card(painter, card, theme);
  painter.setPen(theme.text);
  painter.drawText(card, Qt::AlignCenter, parts_->hint);
}

}  // namespace turnscan::studio
