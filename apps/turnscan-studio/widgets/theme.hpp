#pragma once
// Colours and the style sheet of the window, light and dark.

#include <QColor>
#include <QString>

class QApplication;

namespace turnscan::studio {

struct Theme {
  bool dark = false;
  QColor window, panel, field, text, quiet_text, line, accent, accent_text, error, good;
  QColor view_top, view_bottom;  ///< of the gradient behind the models
};

const Theme& light_theme();
const Theme& dark_theme();

/// Gives the whole program palette and style sheet of the theme.
void apply_theme(QApplication& app, const Theme& theme);

/// Distinct, readable on both themes; repeats after 10.
QColor model_color(int number);

}  // namespace turnscan::studio
