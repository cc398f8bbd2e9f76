#pragma once

#include <QWidget>
#include <turnscan/core/triangle_mesh.hpp>
#include <utility>

class QComboBox;
class QDoubleSpinBox;
class QPushButton;
class QSlider;

namespace turnscan::studio {

/// A plane across an axis: which, where in millimetres, and which side.
class PlaneBox : public QWidget {
  Q_OBJECT
 public:
  enum Side { kAbove, kBelow };  ///< of the place on the axis
  /// name: of the object; its editors are NAME_axis, NAME_place, NAME_slider and NAME_flip.
  /// `stays`: unless it is flipped.
  PlaneBox(const QString& name, Side stays, QWidget* parent = nullptr);

  /// The range of the place. One that is beyond it goes to the middle.
  void set_box(const Box& box);
  /// Normal and offset of the side that stays: normal . p >= offset.
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
