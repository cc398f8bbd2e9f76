// A person's afternoon: three objects in two passes each, a kill, a device that is unplugged, a
// full disk, edits, a comparison, a report and an export. Nothing is lost, and everything is said.
//   TURNSCAN_SCREENSHOTS=FOLDER     a picture of every step
//   TURNSCAN_AFTERNOON=1920x1080    size of the window; with "dark" behind it in the dark theme

#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QApplication>
#include <QComboBox>
#include <QDialog>
#include <QFileInfo>
#include <QLabel>
#include <QMessageBox>
#include <QMouseEvent>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTest>
#include <algorithm>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/selection/selection.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/recording/recording.hpp>

#include "driver.hpp"
#include "explorer/editing/edit_panel.hpp"
#include "explorer/explorer.hpp"
#include "explorer/model_list.hpp"
#include "explorer/session.hpp"
#include "explorer/verdict_panel.hpp"
#include "scanner/record_panel.hpp"
#include "scanner/scanner.hpp"
#include "tests/io/scarcity.hpp"
#include "view/scene_view.hpp"
#include "view/view_settings.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {
namespace {

/// Few frames a turn, quicker than they would come.
QString device(const QString& object, const QString& more = {}) {
  return QString(
             "virtual:%1?sensor=kinect-v2&calibration=true&angles=1&frames=6000&turns=250"
             "&noise=gaussian:1mm%2")
      .arg(object, more);
}

QSize stated_size() {
  const QStringList words = qEnvironmentVariable("TURNSCAN_AFTERNOON").split('x');
  const QSize size(words.value(0).toInt(), words.value(1).section(' ', 0, 0).toInt());
  return size.isEmpty() ? QSize(1366, 768) : size;
}

class Afternoon : public ::testing::Test, FirstStart {
 protected:
  Afternoon() : store(window.explorer().store()), view(window.explorer().view()) {
    window.settings().set_dark(qEnvironmentVariable("TURNSCAN_AFTERNOON").contains("dark"));
    show_window(window, stated_size());
    window.set_close_question([this](const QStringList& stake) {
      at_stake = stake;
      return true;
    });
  }
  ~Afternoon() override { window.settings().set_dark(false); }

  QString path(const QString& name) const {
    const QString killed = qEnvironmentVariable(kKilledFolder);
    return killed.isEmpty() ? folder.filePath(name) : QDir(killed).filePath(name);
  }
  void picture(const QString& name) {
    run_for(60);
    EXPECT_EQ(crowded(window), "") << name.toStdString();
    keep_picture(window, QString("%1-%2").arg(++pictures, 2, 10, QChar('0')).arg(name));
  }
  void press(QWidget* widget, const char* what) {
    ASSERT_TRUE(widget) << what;
    ASSERT_TRUE(wait_for([&] { return widget->isEnabled(); })) << what;
    ASSERT_TRUE(click(widget)) << what;
  }
  void press(const char* text) {
    press(button_with(window.mode(), text), text);
    ASSERT_TRUE(wait_idle(window)) << text;
  }
  void press_named(const char* name) {
    press(named(window.mode(), name), name);
    ASSERT_TRUE(wait_idle(window)) << name;
  }
  /// Errors that are shown in a mode.
  QString errors(QWidget& in) {
    QString out;
    for (const QLabel* label : in.findChildren<QLabel*>("error")) out += label->text();
    return out;
  }
  bool was_said(const QString& text) {
    QTest::keyClick(&window, Qt::Key_L, Qt::ControlModifier);
    auto* dialog = window.findChild<QDialog*>("messages");
    const bool found = dialog && dialog->findChild<QPlainTextEdit*>()->toPlainText().contains(text);
    if (dialog) dialog->close();
    QApplication::setActiveWindow(&window);
    return found;
  }
  void play(const QString& uri, const QString& recording) {
    window.show_mode("scanner");
    ScannerMode& mode = window.scanner();
    if (!button_with(mode, "Play")) {
      press(button_with(mode, "Stop"), "Stop");
      ASSERT_TRUE(wait_for([&] { return button_with(mode, "Play") != nullptr; }));
    }
    mode.recording().set_folder(path(recording));
    mode.set_device(uri);
    press(button_with(mode, "Play"), "Play");
    ASSERT_TRUE(wait_for([&] { return named(mode, "record")->isEnabled(); }));
  }
  /// Until it is a mesh in the Explorer. A further pass is in the place of the mesh before.
  void record() {
    const ModelDataPtr before = store.models().empty() ? nullptr : store.models().back().data;
    press(named(window.scanner(), "record"), "record");
    ASSERT_TRUE(wait_for(
        [&] {
          return !store.models().empty() && store.models().back().data != before &&
                 store.models().back().data->kind == ModelKind::kMesh;
        },
        120.0))
        << errors(window.scanner()).toStdString() << errors(window.explorer()).toStdString();
    ASSERT_TRUE(wait_idle(window));
  }
  /// A pass, the advice, another pass, and both in one mesh.
  void scan_both_sides(const QString& object) {
    play(device(object), object);
    picture(object + "-sensor");
    record();
    picture(object + "-first-pass");
    ASSERT_NO_FATAL_FAILURE(press("Scan another side"));
    run_for(300);  // the object is laid
    picture(object + "-laid");
    record();
    const Model& made = store.models().back();
    EXPECT_TRUE(made.data->report.contains("2 passes in one mesh"))
        << errors(window.explorer()).toStdString();
    EXPECT_TRUE(check_mesh(made.data->mesh).watertight());
    EXPECT_EQ(recordings_called(object), 1);
    picture(object + "-joined");
  }
  std::ptrdiff_t recordings_called(const QString& object) const {
    return std::count_if(store.models().begin(), store.models().end(), [&](const Model& model) {
      return model.data->kind == ModelKind::kRecording && model.name.startsWith(object);
    });
  }
  /// As many turns are recorded while this lives.
  struct Turns {
    Turns(Afternoon& of, const char* count) : test(of) {
      test.window.show_mode("scanner");
      EXPECT_TRUE(type(named(test.window.scanner(), "option:turns"), count));
    }
    ~Turns() { EXPECT_TRUE(type(named(test.window.scanner(), "option:turns"), "")); }
    Afternoon& test;
  };
  void drag(const std::vector<QPoint>& way) {
    QWidget* canvas = view.childAt(view.rect().center());
    QTest::mousePress(canvas, Qt::LeftButton, {}, way.front());
    for (const QPoint& at : way) {
      QMouseEvent move(QEvent::MouseMove, at, Qt::NoButton, Qt::LeftButton, {});
      QApplication::sendEvent(canvas, &move);
    }
    QTest::mouseRelease(canvas, Qt::LeftButton, {}, way.back());
    ASSERT_TRUE(wait_idle(window));
  }
  const Model& model(const QString& name) {
    for (const Model& each : store.models())
      if (each.name == name) return each;
    ADD_FAILURE() << "no model is called " << name.toStdString();
    return store.models().front();
  }

  void restore_what_was_killed();
  void lose_the_device();
  void fill_the_disk();
  void edit();
  void compare_report_and_export();

  ScansFolder folder;
  MainWindow window;
  ModelStore& store;
  SceneView& view;
  QStringList at_stake;
  int pictures = 0;
};

/// The first object, whose program is killed.
TEST_F(Afternoon, DISABLED_BeginsAndIsKilled) {
  ASSERT_NO_FATAL_FAILURE(scan_both_sides("skull"));
  window.explorer().session().flush();
  std::puts("begun");
  std::fflush(stdout);
  run_for(60000);
}

/// As the next start asks.
void Afternoon::restore_what_was_killed() {
  bool asked = false;
  QTimer answer;
  answer.setInterval(100);
  QObject::connect(&answer, &QTimer::timeout, [&] {
    auto* question = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (!question) return;
    answer.stop();
    asked = true;
    EXPECT_TRUE(question->text().contains("skull")) << question->text().toStdString();
    keep_picture(*question, QString("%1-restore").arg(++pictures, 2, 10, QChar('0')));
    for (QAbstractButton* button : question->buttons())
      if (button->text() == "Restore") QTest::mouseClick(button, Qt::LeftButton);
  });
  answer.start();
  window.offer_lost_session();
  EXPECT_TRUE(asked);
  QApplication::setActiveWindow(&window);  // there is no window manager to do it
  ASSERT_TRUE(wait_idle(window));
  ASSERT_EQ(store.models().size(), 2u);
  EXPECT_GT(store.models().back().data->mesh.triangles.size(), 1000u);
  EXPECT_EQ(store.unsaved().size(), 1);
  EXPECT_GE(store.history().size(), 4);
  picture("restored");
}

void Afternoon::lose_the_device() {
  const Turns many(*this, "100");  // the device goes before they are done
  play(device("doll", "&realtime=1&fault=lost@4s"), "unplugged");
  press(named(window.scanner(), "record"), "record");
  ASSERT_TRUE(wait_for([&] { return button_with(window.scanner(), "Play") != nullptr; }));
  picture("unplugged");
  const auto kept = Recording::open(path("unplugged").toStdString());
  ASSERT_TRUE(kept.has_value());
  EXPECT_GT(kept->frames().size(), 10u);
  // The reason stands where the person is.
  EXPECT_EQ(&window.mode(), &window.scanner());
  EXPECT_FALSE(errors(window.scanner()).isEmpty());
}

void Afternoon::fill_the_disk() {
  const Turns many(*this, "100");
  play(device("scorpion", "&realtime=1"), "no-room");
  press(named(window.scanner(), "record"), "record");
  ASSERT_TRUE(wait_for([&] { return QDir(path("no-room/depth")).count() > 6; }));
  {
    const turnscan::testing::FullDisk full(5000);
    ASSERT_TRUE(wait_for([&] { return errors(window.scanner()).contains("no-room"); }));
  }
  EXPECT_EQ(&window.mode(), &window.scanner());
  picture("disk-full");
  const auto kept = Recording::open(path("no-room").toStdString());
  ASSERT_TRUE(kept.has_value());
  EXPECT_GE(kept->frames().size(), 3u);
}

void Afternoon::edit() {
  store.duplicate(model("doll mesh").id);  // to compare with
  const std::size_t triangles = model("doll mesh (2)").data->mesh.triangles.size();
  const auto now = [&] { return model("doll mesh (2)").data->mesh.triangles.size(); };
  // What came last is shown alone.
  EXPECT_FALSE(model("doll mesh (2)").visible);
  store.set_visible(model("scorpion mesh").id, false);
  store.set_visible(model("doll mesh (2)").id, true);
  window.explorer().list().select(model("doll mesh (2)").id);
  view.look(StandardView::kFront);
  ASSERT_TRUE(wait_idle(window));
  ASSERT_NO_FATAL_FAILURE(press_named("select_rectangle"));
  const QPoint middle = view.rect().center();
  drag({middle - QPoint(60, 60), middle, middle + QPoint(20, 20)});
  EXPECT_GT(window.explorer().edits().selected(), 20u);
  picture("selected");
  QTest::keyClick(&window, Qt::Key_Delete);
  ASSERT_TRUE(wait_idle(window));
  EXPECT_LT(now(), triangles);
  picture("deleted");
  if (small_pieces(model("doll mesh (2)").data->mesh, 0.05).pieces > 0) {
    ASSERT_NO_FATAL_FAILURE(press_named("select_small"));
    QTest::keyClick(&window, Qt::Key_Delete);
    ASSERT_TRUE(wait_idle(window));
    EXPECT_EQ(small_pieces(model("doll mesh (2)").data->mesh, 0.05).pieces, 0u);
    QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
    QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  }
  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(now(), triangles);
  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_LT(now(), triangles);
  ASSERT_NO_FATAL_FAILURE(press_named("edit_fill"));
  EXPECT_TRUE(check_mesh(model("doll mesh (2)").data->mesh).closed);
  ASSERT_NO_FATAL_FAILURE(press_named("edit_smooth"));
  ASSERT_TRUE(click(named(window.explorer(), "history")));
  picture("edited");
}

void Afternoon::compare_report_and_export() {
  const auto choose = [&](const char* box, const QString& name) {
    auto* combo = qobject_cast<QComboBox*>(named(window.explorer(), box));
    ASSERT_TRUE(combo);
    combo->setCurrentText(name);
    Q_EMIT combo->activated(combo->currentIndex());
  };
  choose("compare_reference", "doll mesh");
  choose("compare_model", "doll mesh (2)");
  ASSERT_NO_FATAL_FAILURE(press("Side by side"));
  picture("side-by-side");
  ASSERT_NO_FATAL_FAILURE(press("Distances"));
  picture("distances");
  EXPECT_EQ(store.models().back().name, "doll mesh (2) to doll mesh");
  ASSERT_TRUE(wait_idle(window));
  window.explorer().list().select(model("scorpion mesh").id);
  window.explorer().export_report(model("scorpion mesh").id, path("scorpion.html"));
  ASSERT_TRUE(wait_idle(window));
  EXPECT_TRUE(content(path("scorpion.html")).contains("scorpion"));
  picture("report");
  for (const char* name : {"skull mesh", "doll mesh (2)", "scorpion mesh"})
    window.explorer().export_as(model(name).id, path(QString(name) + ".3mf"), {});
  ASSERT_TRUE(wait_idle(window));
  for (const char* name : {"skull mesh", "doll mesh (2)", "scorpion mesh"}) {
    const auto read = read_mesh(path(QString(name) + ".3mf").toStdString());
    ASSERT_TRUE(read.has_value()) << name;
    EXPECT_EQ(read->triangles.size(), model(name).data->mesh.triangles.size());
  }
  picture("exported");
}

TEST_F(Afternoon, NothingIsLostAndEverythingIsSaid) {
  qputenv("XDG_DATA_HOME", path("data").toUtf8());  // where both keep their sessions
  (void)kill_in_the_middle("Afternoon.DISABLED_BeginsAndIsKilled", path(""), 1);
  pictures = 4;  // it made these
  ASSERT_NO_FATAL_FAILURE(restore_what_was_killed());
  ASSERT_NO_FATAL_FAILURE(lose_the_device());
  ASSERT_NO_FATAL_FAILURE(scan_both_sides("doll"));
  ASSERT_NO_FATAL_FAILURE(fill_the_disk());
  ASSERT_NO_FATAL_FAILURE(scan_both_sides("scorpion"));
  ASSERT_NO_FATAL_FAILURE(edit());
  ASSERT_NO_FATAL_FAILURE(compare_report_and_export());

  for (const char* text :
       {"stopped answering", "no-room", "Delete selected: ", "Fill holes: ", "Smooth: ",
        "Wrote ~/scans/scorpion.html", "Wrote ~/scans/doll mesh (2).3mf"})
    EXPECT_TRUE(was_said(text)) << text;
  for (const char* name : {"skull", "doll", "scorpion"}) {
    const auto recording = Recording::open(path(name).toStdString());
    ASSERT_TRUE(recording.has_value()) << name;
    EXPECT_TRUE(recording->complete());
    EXPECT_EQ(recording->frames().back().pass, 1u);
  }
  window.close();
  EXPECT_TRUE(at_stake.isEmpty()) << at_stake.join("\n").toStdString();
  EXPECT_TRUE(window.explorer().store().unsaved().contains("skull mesh"));
  qunsetenv("XDG_DATA_HOME");  // where the killed one kept its session, not this window
  const QDir sessions(SessionKeeper::default_root());
  const QStringList kept = sessions.entryList(QDir::Dirs | QDir::NoDotAndDotDot);
  ASSERT_EQ(kept.size(), 1) << "the one of this window, which is still there";
  EXPECT_TRUE(sessions.exists(kept[0] + "/session.json"));
}

}  // namespace
}  // namespace turnscan::studio
