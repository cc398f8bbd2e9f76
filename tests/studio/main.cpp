#include <dlfcn.h>
#include <gtest/gtest.h>

#include <QApplication>
#include <QDir>
#include <QTemporaryDir>

#include "app/program.hpp"
#include "widgets/message_log.hpp"

#ifdef __SANITIZE_ADDRESS__
/// Drivers and plug-ins stay loaded, so that the leak check can name them (leaks_of_others.txt).
extern "C" int dlclose(void*) noexcept { return 0; }
#endif

namespace {

/// What the window said before a check failed.
class Said : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo&) override { first_ = QDateTime::currentDateTime(); }
  void OnTestPartResult(const testing::TestPartResult& part) override {
    if (!part.failed()) return;
    for (const auto& entry : turnscan::studio::messages().entries())
      if (entry.time >= first_)
        std::fprintf(stderr, "said%s at %s: %s\n", entry.error ? " as an error" : "",
                     qUtf8Printable(entry.time.toString("HH:mm:ss.zzz")),
                     qUtf8Printable(entry.text));
  }
  QDateTime first_;
};

}  // namespace

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
  testing::UnitTest::GetInstance()->listeners().Append(new Said);
  return RUN_ALL_TESTS();
}
