#pragma once

class QWidget;

namespace turnscan::studio {

/// Makes the wheel scroll the panel that contains the widget instead of changing its value.
void leave_wheel_to_panel(QWidget* widget);

}  // namespace turnscan::studio
