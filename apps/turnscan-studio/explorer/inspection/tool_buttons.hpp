#pragma once
// Buttons that give the mouse to a tool: one at a time, across all panels.

#include <QObject>
#include <QPointer>
#include <functional>
#include <vector>

class QAbstractButton;

namespace turnscan::studio {

class SceneView;
class ViewTool;

class ToolButtons : public QObject {
 public:
  explicit ToolButtons(SceneView& view, QObject* parent = nullptr);
  ~ToolButtons() override;

  /// Makes the button checkable. While it is checked the tool has the mouse (nullptr: the camera
  /// keeps it), and no other button is checked. `switched` is called with every change.
  void add(QAbstractButton* button, ViewTool* tool, std::function<void(bool on)> switched = {});
  /// Returns the mouse to the camera.
  void stop();

 private:
  struct Entry {
    QAbstractButton* button;
    ViewTool* tool;
    std::function<void(bool)> switched;
  };
  void on_toggled(std::size_t which, bool on);

  QPointer<SceneView> view_;  ///< may be destroyed first when the window closes
  std::vector<Entry> entries_;
};

}  // namespace turnscan::studio
