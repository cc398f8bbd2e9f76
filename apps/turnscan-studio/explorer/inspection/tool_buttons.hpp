#pragma once
// Buttons that give the mouse to a tool: one at a time, in whichever panel they are.

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
  /// keeps it), and no other button is. `switched` is called with every change.
  void add(QAbstractButton* button, ViewTool* tool, std::function<void(bool on)> switched = {});
  /// Back to the camera alone.
  void stop();

 private:
  struct Entry {
    QAbstractButton* button;
    ViewTool* tool;
    std::function<void(bool)> switched;
  };
  void on_toggled(std::size_t which, bool on);

  QPointer<SceneView> view_;  ///< when the window ends, it may have gone before
  std::vector<Entry> entries_;
};

}  // namespace turnscan::studio
