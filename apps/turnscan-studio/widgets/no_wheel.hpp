#pragma once

class QWidget;

namespace turnscan::studio {

/// The wheel scrolls the panel that the widget is on; it does not change its value on the way.
void leave_wheel_to_panel(QWidget* widget);

}  // namespace turnscan::studio
