#pragma once

#include <QWidget>
#include <turnscan/core/triangle_mesh.hpp>
#include <utility>

class QComboBox;
class QDoubleSpinBox;
class QPushButton;
class QSlider;

namespace turnscan::studio {

/// A plane perpendicular to an axis: which axis, position in millimetres, and which side.
class PlaneBox : public QWidget {
  Q_OBJECT
 public:
  enum Side { kAbove, kBelow };  ///< of the position on the axis
  /// name: of the object; its editors are NAME_axis, NAME_place, NAME_slider and NAME_flip.
  /// `stays`: the side that is kept unless it is flipped.
  PlaneBox(const QString& name, Side stays, QWidget* parent = nullptr);

  /// Sets the range of the position. One outside it is moved to the middle.
  void set_box(const Box& box);
  /// Normal and offset of the side that is kept: normal . p >= offset.
  std::pair<Vec3d, double> plane() const;

 Q_SIGNALS:
  void changed();

 private:
  void set_range();
  double low() const;
  double high() const;

  QComboBox* axis_;
  QDoubleSpinBox* place_;
  QSlider* slider_;
  QPushButton* flip_;
  Side stays_;
  Box box_;
};

}  // namespace turnscan::studio
