#pragma once
// Internal to the sources of the 3D Scanner.

#include <turnscan/turntable/detection/average.hpp>
#include <turnscan/turntable/detection/detect.hpp>

#include "scanner/scanner.hpp"
#include "view/scene_view.hpp"

namespace turnscan::studio {

struct ScannerMode::CalibrationOptions {
  AverageOptions average;
  DetectOptions detect;
};

/// Pixels of a sensor, drawn large enough to look like a surface.
inline ItemStyle picture_style(bool visible) {
  ItemStyle style;
  style.visible = visible;
  style.boxed = false;
  style.point_scale = 2.2;
  return style;
}

/// Picks points on the rim of the platter.
class PickTool : public ViewTool {
 public:
  explicit PickTool(ScannerMode& mode) : mode_(mode) {}
  bool press(const QPointF& at, Qt::KeyboardModifiers keys) override {
    if (keys != Qt::NoModifier) return false;
    if (const auto point = mode_.view().pick(at)) mode_.add_pick(*point);
    return true;
  }

 private:
  ScannerMode& mode_;
};

}  // namespace turnscan::studio
