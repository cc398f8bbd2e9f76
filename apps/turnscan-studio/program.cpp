#include "program.hpp"

#include <QVTKOpenGLNativeWidget.h>
#include <vtkObject.h>

#include <QCoreApplication>
#include <QSurfaceFormat>
#include <clocale>

namespace turnscan::studio {

void prepare_application() {
  QSurfaceFormat format = QVTKOpenGLNativeWidget::defaultFormat();
  format.setSamples(0);
  QSurfaceFormat::setDefaultFormat(format);
  QCoreApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
  QCoreApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
  vtkObject::GlobalWarningDisplayOff();
}

void name_application() {
  QCoreApplication::setOrganizationName("turnscan");
  QCoreApplication::setApplicationName("studio");
  // Numbers are written and read the same way everywhere.
  std::setlocale(LC_NUMERIC, "C");
}

}  // namespace turnscan::studio
