#include "explorer/inspection/tool_buttons.hpp"

#include <QAbstractButton>

#include "view/scene_view.hpp"

namespace turnscan::studio {

ToolButtons::ToolButtons(SceneView& view, QObject* parent) : QObject(parent), view_(&view) {}

ToolButtons::~ToolButtons() {
  if (view_) view_->set_tool(nullptr);
}

void ToolButtons::add(QAbstractButton* button, ViewTool* tool,
                      std::function<void(bool on)> switched) {
  button->setCheckable(true);
  const std::size_t which = entries_.size();
  entries_.push_back({button, tool, std::move(switched)});
  connect(button, &QAbstractButton::toggled, this,
          [this, which](bool on) { on_toggled(which, on); });
}

void ToolButtons::stop() {
  for (const Entry& each : entries_) each.button->setChecked(false);
}

void ToolButtons::on_toggled(std::size_t which, bool on) {
  if (on) {
    for (std::size_t i = 0; i < entries_.size(); ++i)
      if (i != which) entries_[i].button->setChecked(false);
    if (view_) view_->set_tool(entries_[which].tool);
  } else if (view_ && view_->tool() == entries_[which].tool) {
    view_->set_tool(nullptr);
  }
  if (entries_[which].switched) entries_[which].switched(on);
}

}  // namespace turnscan::studio
