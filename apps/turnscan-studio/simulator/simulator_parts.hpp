#pragma once
// Internal to the sources of the Simulator.

#include <memory>
#include <turnscan/sensors/scanner_file.hpp>

#include "simulator/scanner_editor.hpp"
#include "simulator/simulator.hpp"
#include "view/scene_view.hpp"

namespace turnscan::studio {

struct SimulatorMode::RigScanner {
  ScannerEditor* editor = nullptr;
  int lines = 0, bodies = 0;  // items in the view
};

/// Drags a scanner around its target point; with Shift, closer and farther.
class RigTool : public ViewTool {
 public:
  explicit RigTool(SimulatorMode& mode) : mode_(mode) {}
  bool press(const QPointF& at, Qt::KeyboardModifiers keys) override;
  void drag(const QPointF& at, Qt::KeyboardModifiers keys) override;
  void release(const QPointF& at) override;
  QCursor cursor() const override { return Qt::ArrowCursor; }

 private:
  Vec3d position_of(const SimulatorMode::RigScanner& scanner) const;
  void turn(SimulatorMode::RigScanner& scanner, const QPointF& at) const;

  SimulatorMode& mode_;
  int dragged_ = -1;
  QPointF last_;
};

}  // namespace turnscan::studio
