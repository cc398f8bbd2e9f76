#include <gtest/gtest.h>

#include <QApplication>
#include <QDir>
#include <QTemporaryDir>

#include "app/program.hpp"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  // The settings and files of whoever runs the tests stay as they are; compiled shaders are kept.
  if (!qEnvironmentVariableIsSet("XDG_CACHE_HOME"))
    qputenv("XDG_CACHE_HOME", QDir::home().filePath(".cache").toUtf8());
  const QTemporaryDir home;
  for (const char* name : {"HOME", "XDG_CONFIG_HOME", "XDG_STATE_HOME"})
    qputenv(name, home.path().toUtf8());
  turnscan::studio::prepare_application();
  QApplication app(argc, argv);
  turnscan::studio::name_application();
  return RUN_ALL_TESTS();
}
