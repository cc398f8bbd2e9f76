#include <QApplication>
#include <QCommandLineParser>
#include <turnscan/core/process/process_setup.hpp>
#include <version/named_version.hpp>

#include "app/language.hpp"
#include "app/program.hpp"
#include "window/main_window.hpp"

int main(int argc, char** argv) {
  using namespace turnscan::studio;
  turnscan::process::set_up_process();
  prepare_application();
  QApplication app(argc, argv);
  name_application();
  QApplication::setApplicationVersion(QString::fromStdString(turnscan::named_version()));
  install_language(app, shown_language());
  QCommandLineParser parser;
  parser.setApplicationDescription("Scan, look at and simulate objects on a turntable.");
  parser.addHelpOption();
  parser.addVersionOption();
  parser.addPositionalArgument("FILE", "Meshes, clouds or recordings to open.", "[FILE...]");
  parser.process(app);
  MainWindow window;
  window.show();
  window.offer_lost_session();
  window.offer_unfinished_recording();
  for (const QString& file : parser.positionalArguments()) window.open(file);
  return QApplication::exec();
}
