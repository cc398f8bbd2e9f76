#pragma once
// Colours and the style sheet of the window, light and dark.

#include <QColor>
#include <QString>

class QApplication;
class QVariant;
class QWidget;

namespace turnscan::studio {

struct Theme {
  bool dark = false;
  QColor window, panel, field, text, quiet_text, line, accent, accent_text, error, good;
  QColor view_top, view_bottom;  ///< gradient behind the models
};

const Theme& light_theme();
const Theme& dark_theme();

/// Applies the theme's palette and style sheet to the whole program.
void apply_theme(QApplication& app, const Theme& theme);

/// Sets a property that the style sheet selects by, and draws the widget accordingly.
void set_style_property(QWidget& widget, const char* name, const QVariant& value);

/// Distinct, readable on both themes; repeats after 10.
QColor model_color(int number);

}  // namespace turnscan::studio
