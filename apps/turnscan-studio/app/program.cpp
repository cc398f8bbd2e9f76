#include "app/program.hpp"

#include <QVTKOpenGLNativeWidget.h>
#include <vtkObject.h>

#include <QCoreApplication>
#include <QSurfaceFormat>
#include <clocale>
#include <turnscan/core/process/thread_priority.hpp>

/// The resources of a static library are only linked if they are requested, outside of any
/// namespace.
static void load_resources() {
  Q_INIT_RESOURCE(studio);
#ifdef TURNSCAN_STUDIO_TRANSLATED
  Q_INIT_RESOURCE(translations);
#endif
}

namespace turnscan::studio {

void prepare_application() {
  QSurfaceFormat format = QVTKOpenGLNativeWidget::defaultFormat();
  format.setSamples(0);
  QSurfaceFormat::setDefaultFormat(format);
  QCoreApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
  QCoreApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
  vtkObject::GlobalWarningDisplayOff();
  process::lower_worker_priority();
  load_resources();
}

void name_application() {
  QCoreApplication::setOrganizationName("turnscan");
  QCoreApplication::setApplicationName("studio");
  // Numbers are written and read independently of the locale.
  std::setlocale(LC_NUMERIC, "C");
}

}  // namespace turnscan::studio
