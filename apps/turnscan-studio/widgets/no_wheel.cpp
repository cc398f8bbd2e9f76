#include "widgets/no_wheel.hpp"

#include <QEvent>
#include <QWidget>

namespace turnscan::studio {

namespace {

class NoWheel : public QObject {
 public:
  using QObject::QObject;
  bool eventFilter(QObject* object, QEvent* event) override {
    if (event->type() != QEvent::Wheel) return QObject::eventFilter(object, event);
    event->ignore();
    return true;
  }
};

}  // namespace

void leave_wheel_to_panel(QWidget* widget) {
  widget->installEventFilter(new NoWheel(widget));
  widget->setFocusPolicy(Qt::StrongFocus);
}

}  // namespace turnscan::studio
