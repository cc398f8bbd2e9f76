#include "explorer/passes/pair_tool.hpp"

#include <QPainter>
#include <algorithm>
#include <array>

namespace turnscan::studio {

namespace {

constexpr double kDiscRadius = 9.0;
const QColor kPairColor(0xd2453c);

}  // namespace

PairTool::PairTool(SceneView& view, std::function<void()> changed)
    : view_(view), changed_(std::move(changed)) {}

void PairTool::change() {
  view_.update_overlay();
  changed_();
}

void PairTool::clear() {
  clicks_.clear();
  change();
}

void PairTool::undo() {
  if (!clicks_.empty()) clicks_.pop_back();
  change();
}

std::size_t PairTool::places(int pane) const {
  return std::size_t(std::count_if(clicks_.begin(), clicks_.end(),
                                   [&](const Click& click) { return click.pane == pane; }));
}

std::vector<PointPair> PairTool::pairs() const {
  std::array<std::vector<Vec3d>, 2> places;
  for (const Click& click : clicks_) places[std::size_t(click.pane)].push_back(click.place);
  std::vector<PointPair> out;
  for (std::size_t i = 0; i < std::min(places[0].size(), places[1].size()); ++i)
    out.push_back({places[1][i], places[0][i]});
  return out;
}

bool PairTool::press(const QPointF& at, Qt::KeyboardModifiers keys) {
  if (keys != Qt::NoModifier) return false;
  const auto place = view_.pick(at);
  if (!place) return false;
  clicks_.push_back({at.x() > 0.5 * view_.width() ? 1 : 0, *place});
  change();
  return true;
}

void PairTool::paint(QPainter& painter) {
  std::array<int, 2> number{};
  for (const Click& click : clicks_) {
    const QString text = QString::number(++number[std::size_t(click.pane)]);
    const auto pixel = view_.project(click.place);
    if (!pixel) continue;
    const QPointF at = *pixel + QPointF(0.5 * click.pane * view_.width(), 0.0);
    painter.setPen(QPen(Qt::white, 1.5));
    painter.setBrush(kPairColor);
    painter.drawEllipse(at, kDiscRadius, kDiscRadius);
    painter.drawText(
        QRectF(at - QPointF(kDiscRadius, kDiscRadius), QSizeF(2 * kDiscRadius, 2 * kDiscRadius)),
        Qt::AlignCenter, text);
  }
}

}  // namespace turnscan::studio
