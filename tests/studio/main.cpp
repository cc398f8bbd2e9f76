#include <gtest/gtest.h>

#include <QApplication>
#include <QSettings>
#include <QTemporaryDir>

#include "program.hpp"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  // The settings of whoever runs the tests stay as they are.
  const QTemporaryDir settings;
  qputenv("XDG_CONFIG_HOME", settings.path().toUtf8());
  qputenv("XDG_STATE_HOME", settings.path().toUtf8());
  turnscan::studio::prepare_application();
  QApplication app(argc, argv);
  turnscan::studio::name_application();
  return RUN_ALL_TESTS();
}
