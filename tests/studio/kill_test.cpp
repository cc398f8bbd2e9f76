// The window's process is killed (SIGKILL) at random moments: a recording opens with every frame
// that its table listed, a mesh that was there is the old one or the new one, whole, and the next
// start goes on with all models, steps and the view. TURNSCAN_KILLS: how many times each, 3 unless
// it says otherwise.

#include <gtest/gtest.h>

#include <QApplication>
#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>
#include <array>
#include <map>
#include <turnscan/core/random.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/recording/recording.hpp>

#include "driver.hpp"
#include "explorer/editing/edits.hpp"
#include "explorer/explorer.hpp"
#include "explorer/loading.hpp"
#include "explorer/model_list.hpp"
#include "explorer/session.hpp"
#include "scanner/record_panel.hpp"
#include "scanner/scanner.hpp"
#include "tests/geometry/shapes.hpp"
#include "tests/io/scarcity.hpp"
#include "view/scene_view.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {
namespace {

int kills() {
  const int stated = qEnvironmentVariableIntValue("TURNSCAN_KILLS");
  return stated > 0 ? stated : 3;
}

/// Between 0 and the longest, another one for each kill.
int pause_ms(int kill, int longest_ms) {
  return int(hash_key(0x6b696c6c, std::uint64_t(kill)) % std::uint64_t(longest_ms));
}

/// What a killed process does: each of its tests runs until it is killed.
class Victim : public ::testing::Test, FirstStart {
 protected:
  static QString path(const QString& name) {
    return QDir(qEnvironmentVariable(kKilledFolder)).filePath(name);
  }
  static void say(const char* text) {
    std::puts(text);
    std::fflush(stdout);
  }

  MainWindow window;
};

TEST_F(Victim, DISABLED_Records) {
  show_window(window, {1000, 700});
  window.show_mode("scanner");
  ScannerMode& mode = window.scanner();
  mode.recording().set_folder(path("recording"));
  mode.set_device("virtual:letter-a?sensor=kinect-v2&realtime=1");
  ASSERT_TRUE(click(button_with(mode, "Play")));
  QWidget* record = named(mode, "record");
  ASSERT_TRUE(wait_for([&] { return record->isEnabled(); }));
  ASSERT_TRUE(click(record));
  ASSERT_TRUE(wait_for([&] { return QFileInfo::exists(path("recording/frames.csv")); }));
  say("begun");
  run_for(60000);
}

TEST_F(Victim, DISABLED_ReconstructsAndSavesAgainAndAgain) {
  show_window(window, {1000, 700});
  for (;;) {
    window.open(path("letter"));
    ASSERT_TRUE(wait_idle(window));
    say("begun");
    ASSERT_TRUE(click(button_with(window.explorer(), "Reconstruct")));
    ASSERT_TRUE(wait_idle(window));
    window.explorer().save_as(window.explorer().store().models().back().id, path("mesh.ply"));
    ASSERT_TRUE(wait_idle(window));
    say("saved");
  }
}

TriangleMesh tetrahedron() {
  TriangleMesh mesh;
  mesh.vertices = {{0.0f, 0.0f, 0.0f}, {0.1f, 0.0f, 0.0f}, {0.0f, 0.1f, 0.0f}, {0.0f, 0.0f, 0.1f}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  return mesh;
}

TEST_F(Victim, DISABLED_HasModels) {
  show_window(window, {1000, 700});
  ASSERT_TRUE(write_mesh(path("saved.stl").toStdString(), tetrahedron()));
  window.open(path("saved.stl"));
  ASSERT_TRUE(wait_idle(window));
  ModelStore& store = window.explorer().store();
  const int made = store.add("made", mesh_model(tetrahedron(), "a test"));
  store.set_color(made, QColor("#336699"), false);
  store.set_visible(made, false);
  store.remove(store.add("removed", mesh_model(tetrahedron(), "a test")));
  store.undo();
  store.undo();  // it is neither added nor removed
  const ModelDataPtr data = store.find(made)->data;
  const Selection one{0, 1, 0, 0};
  store.select_parts({data, std::make_shared<const Selection>(one), selection_drawable(*data, one)},
                     "select");
  window.explorer().list().select(made);
  window.explorer().view().look(StandardView::kTop);
  ASSERT_TRUE(wait_idle(window));
  window.explorer().session().flush();
  say("begun");
  run_for(60000);
}

/// What is at work when it is killed: by its place in here.
constexpr std::array<const char*, 5> kWork{"RecordsWithModels", "Reconstructs", "Edits", "Saves",
                                           "Autosaves"};

/// A person's models, and one of the works of kWork, which never ends.
class VictimAtWork : public Victim {
 protected:
  VictimAtWork() : store(window.explorer().store()) {
    show_window(window, {1000, 700});
    window.open(path("letter"));
    EXPECT_TRUE(wait_idle(window));
    ball = store.add("ball", mesh_model(test::sphere(0.05, 6), "a test"));
    store.set_color(ball, QColor("#336699"), false);
    window.explorer().list().select(ball);
    window.explorer().view().look(StandardView::kTop);
    EXPECT_TRUE(wait_idle(window));
    window.explorer().session().flush();
  }
  void press(const QString& name) {
    ASSERT_TRUE(click(named(window.explorer(), name))) << name.toStdString();
    ASSERT_TRUE(wait_idle(window));
  }

  ModelStore& store;
  int ball = 0;
};

TEST_F(VictimAtWork, DISABLED_RecordsWithModels) {
  window.show_mode("scanner");
  ScannerMode& mode = window.scanner();
  mode.recording().set_folder(path("recording"));
  mode.set_device("virtual:letter-a?sensor=kinect-v2&realtime=1");
  ASSERT_TRUE(click(button_with(mode, "Play")));
  QWidget* record = named(mode, "record");
  ASSERT_TRUE(wait_for([&] { return record->isEnabled(); }));
  ASSERT_TRUE(click(record));
  say("begun");
  run_for(60000);
}

TEST_F(VictimAtWork, DISABLED_Reconstructs) {
  window.explorer().list().select(store.models().front().id);
  for (;;) {
    say("begun");
    ASSERT_TRUE(click(button_with(window.explorer(), "Reconstruct")));
    ASSERT_TRUE(wait_idle(window));
    window.explorer().list().select(store.models().front().id);
  }
}

TEST_F(VictimAtWork, DISABLED_Edits) {
  say("begun");
  for (;;) {
    press("select_all");
    press("edit_smooth");
    QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
    QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  }
}

TEST_F(VictimAtWork, DISABLED_Saves) {
  say("begun");
  for (;;) {
    window.explorer().save_as(ball, path("mesh.ply"));
    ASSERT_TRUE(wait_idle(window));
  }
}

TEST_F(VictimAtWork, DISABLED_Autosaves) {
  say("begun");
  for (int i = 0;; ++i) {
    store.add(QString("more %1").arg(i), mesh_model(test::sphere(0.05, 6), "a test"));
    window.explorer().session().flush();
  }
}

std::size_t lines_of(const QString& table) { return std::size_t(content(table).count('\n')); }

TEST(KilledStudio, ARecordingKeepsEveryFrameThatItsTableListed) {
  std::size_t most = 0;
  for (int kill = 0; kill < kills(); ++kill) {
    SCOPED_TRACE(kill);
    const QTemporaryDir folder;
    (void)kill_in_the_middle("Victim.DISABLED_Records", folder.path(), pause_ms(kill, 2000));
    const QString recording = folder.filePath("recording");
    const std::size_t lines = lines_of(recording + "/frames.csv");
    const auto opened = Recording::open(recording.toStdString());
    ASSERT_TRUE(opened.has_value()) << opened.error().text();
    EXPECT_FALSE(opened->complete());
    EXPECT_GE(opened->frames().size() + 1, lines);  // the first line names the columns
    for (std::size_t i = 0; i < opened->frames().size(); ++i)
      EXPECT_TRUE(opened->read(i).has_value()) << i;
    most = std::max(most, opened->frames().size());
  }
  EXPECT_GT(most, 0u);
}

/// Answers the next question with the button of this name.
class Answer : public QTimer {
 public:
  explicit Answer(const QString& name) {
    setInterval(50);
    connect(this, &QTimer::timeout, this, [this, name] {
      auto* question = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      if (!question) return;
      stop();
      asked = question->text();
      for (QAbstractButton* button : question->buttons())
        if (button->text() == name) QTest::mouseClick(button, Qt::LeftButton);
    });
    start();
  }
  QString asked;
};

TEST(KilledStudio, ARecordingIsOfferedByTheNextStartAndGoesOn) {
  const QTemporaryDir folder;
  (void)kill_in_the_middle("Victim.DISABLED_Records", folder.path(), 2000);
  const QString recording = folder.filePath("recording");
  const auto killed = Recording::open(recording.toStdString());
  ASSERT_TRUE(killed.has_value());
  const std::size_t before = killed->frames().size();
  ASSERT_GT(before, 3u);
  // The next start has the settings of the killed one.
  QDirIterator file(folder.path(), {"*.conf"}, QDir::Files | QDir::Hidden,
                    QDirIterator::Subdirectories);
  ASSERT_TRUE(file.hasNext());
  QSettings().setValue("scanner/running",
                       QSettings(file.next(), QSettings::IniFormat).value("scanner/running"));
  QSettings().setValue("scanner/reconstruct", false);
  EXPECT_EQ(RecordPanel::unfinished(), recording);
  MainWindow window;
  show_window(window, {1000, 700});
  {
    const Answer answer("Go on");
    window.offer_unfinished_recording();
    EXPECT_TRUE(answer.asked.contains(QString("has %1 frame").arg(before)))
        << answer.asked.toStdString();
  }
  auto* record = qobject_cast<QPushButton*>(named(window.scanner(), "record"));
  ASSERT_TRUE(wait_for([&] { return record->isEnabled(); }));
  EXPECT_EQ(record->text(), "Go on with the recording");
  keep_picture(window, "go-on");
  ASSERT_TRUE(click(record));
  ASSERT_TRUE(wait_for([&] { return lines_of(recording + "/frames.csv") > before + 5; }));
  ASSERT_TRUE(click(record));
  ASSERT_TRUE(wait_for([&] {
    const auto now = Recording::open(recording.toStdString());
    return now && now->complete();
  }));
  const auto now = Recording::open(recording.toStdString());
  EXPECT_GT(now->frames().size(), before);
  EXPECT_EQ(now->frames()[before - 1].stretch, 0u);
  EXPECT_EQ(now->frames().back().stretch, 1u);
  EXPECT_EQ(RecordPanel::unfinished(), QString());
  QSettings().remove("scanner");
}

std::map<QString, QByteArray> files_of(const QString& folder) {
  std::map<QString, QByteArray> out;
  for (const QString& name : QDir(folder).entryList(QDir::Files))
    out[name] = content(folder + "/" + name);
  return out;
}

TEST(KilledStudio, AMeshIsTheOldOneOrTheNewOneAndTheRecordingIsAsItWas) {
  const QTemporaryDir folder;
  ASSERT_EQ(run_command_line({"simulate", "builtin:letter-a", "-o", folder.filePath("letter"),
                              "--frames", "12", "--scanner", "kinect-v2"}),
            0);
  const auto before = files_of(folder.filePath("letter"));
  const auto depth_before = files_of(folder.filePath("letter/depth"));
  QByteArray mesh;  // the last one that was said to be saved
  for (int kill = 0; kill < kills(); ++kill) {
    SCOPED_TRACE(kill);
    const QByteArray said = kill_in_the_middle("Victim.DISABLED_ReconstructsAndSavesAgainAndAgain",
                                               folder.path(), pause_ms(kill, 3000));
    EXPECT_EQ(files_of(folder.filePath("letter")), before);
    EXPECT_EQ(files_of(folder.filePath("letter/depth")), depth_before);
    const QByteArray now = content(folder.filePath("mesh.ply"));
    if (!mesh.isEmpty() || said.contains("saved")) {
      EXPECT_TRUE(read_mesh(folder.filePath("mesh.ply").toStdString()).has_value());
    }
    // The same recording and options: the same bytes, each time.
    if (!mesh.isEmpty()) {
      EXPECT_TRUE(now == mesh);
    }
    if (!now.isEmpty()) mesh = now;
  }
}

TEST(KilledStudio, ItsModelsAreThereAgainAfterTheNextStart) {
  const QTemporaryDir folder;
  (void)kill_in_the_middle("Victim.DISABLED_HasModels", folder.path(), 1);
  const QString root = sessions_of_killed(folder.path());
  const auto lost = SessionKeeper::find_lost(root);
  ASSERT_TRUE(lost.has_value()) << root.toStdString();
  MainWindow window;
  show_window(window, {1000, 700});
  window.explorer().restore_session(*lost);
  ASSERT_TRUE(wait_idle(window));
  ModelStore& store = window.explorer().store();
  ASSERT_EQ(store.models().size(), 2u);
  EXPECT_EQ(store.models()[0].name, "saved");
  EXPECT_EQ(store.file_of(*store.models()[0].data), folder.filePath("saved.stl"));
  EXPECT_EQ(store.models()[1].name, "made");
  EXPECT_EQ(store.models()[1].color, QColor("#336699"));
  EXPECT_FALSE(store.models()[1].visible);
  EXPECT_EQ(store.models()[1].data->mesh.triangles.size(), 4u);
  EXPECT_EQ(store.unsaved(), QStringList{"made"});
  // What was done, and how it was looked at.
  EXPECT_EQ(store.history(),
            (QStringList{"open saved.stl", "add made", "colour", "hide", "select"}));
  EXPECT_EQ(window.explorer().list().selected(), store.models()[1].id);
  ASSERT_EQ(store.selected_parts().of, store.models()[1].data);
  EXPECT_EQ(*store.selected_parts().parts, (Selection{0, 1, 0, 0}));
  const CameraPlace camera = window.explorer().view().camera();
  EXPECT_GT((camera.position - camera.focus).normalized().y(), 0.99) << "from above";
  store.undo();
  EXPECT_EQ(store.selected_parts().of, nullptr);
  store.undo();
  EXPECT_TRUE(store.models()[1].visible);
  store.go_to(0);
  EXPECT_TRUE(store.models().empty());
  store.go_to(5);
  EXPECT_EQ(store.models().size(), 2u);
  EXPECT_EQ(*store.selected_parts().parts, (Selection{0, 1, 0, 0}));
  // Kept by this session now, so that the lost one may go.
  window.explorer().session().flush();
  EXPECT_FALSE(SessionKeeper::find_lost(root).has_value());
}

/// Whatever it does when it is killed: its models, its steps and its view are there again.
TEST(KilledStudio, ASessionIsRestoredWhateverWasBeingDone) {
  const QTemporaryDir folder;
  ASSERT_EQ(run_command_line({"simulate", "builtin:letter-a", "-o", folder.filePath("letter"),
                              "--frames", "12", "--scanner", "kinect-v2"}),
            0);
  const int count = std::max(kills(), int(kWork.size()));
  for (int kill = 0; kill < count; ++kill) {
    const char* work = kWork[std::size_t(kill) % kWork.size()];
    SCOPED_TRACE(fmt::format("kill {}, {}", kill, work));
    (void)kill_in_the_middle(QString("VictimAtWork.DISABLED_%1").arg(work), folder.path(),
                             pause_ms(100 + kill, 1500));
    if (QFileInfo::exists(folder.filePath("mesh.ply"))) {
      EXPECT_TRUE(read_mesh(folder.filePath("mesh.ply").toStdString()).has_value());
    }
    QDir(folder.filePath("recording")).removeRecursively();
    const auto lost = SessionKeeper::find_lost(sessions_of_killed(folder.path()));
    ASSERT_TRUE(lost.has_value());
    MainWindow window;
    show_window(window, {1000, 700});
    window.explorer().restore_session(*lost);
    ASSERT_TRUE(wait_idle(window));
    ModelStore& store = window.explorer().store();
    ASSERT_GE(store.models().size(), 2u);
    EXPECT_EQ(store.models()[0].data->kind, ModelKind::kRecording);
    EXPECT_EQ(store.models()[1].name, "ball");
    EXPECT_EQ(store.models()[1].color, QColor("#336699"));
    EXPECT_EQ(store.models()[1].data->mesh.triangles.size(),
              test::sphere(0.05, 6).triangles.size());
    EXPECT_EQ(store.history().mid(0, 3), (QStringList{"open letter", "add ball", "colour"}));
    const CameraPlace camera = window.explorer().view().camera();
    EXPECT_GT((camera.position - camera.focus).normalized().y(), 0.99) << "from above";
    while (store.can_undo()) store.undo();
    EXPECT_TRUE(store.models().empty());
    SessionKeeper::discard(*lost);
  }
}

TEST(KilledStudio, WhatASessionLeftInPiecesIsRefusedOrReadInPart) {
  const QTemporaryDir root;
  const auto put = [&](const QString& session, const QByteArray& list) {
    QDir(root.path()).mkpath(session);
    QFile file(root.filePath(session + "/session.json"));
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(list);
  };
  put("1", "{\"models\": [{\"name\"");
  put("2", "");
  EXPECT_FALSE(SessionKeeper::find_lost(root.path()).has_value());
  EXPECT_FALSE(QDir(root.filePath("1")).exists());
  put("3", R"({"states": [], "place": 0})");
  put("4", R"({"states": [{"models": [{"name": "a", "file": "a.ply"}]}], "place": 7})");
  EXPECT_FALSE(SessionKeeper::find_lost(root.path()).has_value());
  put("5", R"({"states": [{"what": 3, "models": 4}, {"selected_model": 9, "selected": "&",
      "models": [{"name": "gone", "file": "9.ply"}, {"name": 4, "place_in_file": -3}]}],
      "place": 1, "camera": [[0, 0], 1, "x"]})");
  const auto lost = SessionKeeper::find_lost(root.path());
  ASSERT_TRUE(lost.has_value());
  MainWindow window;
  show_window(window, {1000, 700});
  window.explorer().restore_session(*lost);
  ASSERT_TRUE(wait_idle(window));
  EXPECT_TRUE(window.explorer().store().models().empty());
  EXPECT_TRUE(QDir(lost->folder).exists());
}

TEST(KilledStudio, ASessionThatEndsWellOrStillLivesIsNotLost) {
  const QTemporaryDir root;
  ModelStore store;
  {
    SessionKeeper keeper(store, root.path());
    store.add("made", mesh_model(tetrahedron(), "a test"));
    keeper.flush();
    EXPECT_FALSE(QDir(root.path()).entryList(QDir::Dirs | QDir::NoDotAndDotDot).isEmpty());
    EXPECT_FALSE(SessionKeeper::find_lost(root.path()).has_value());
  }
  EXPECT_TRUE(QDir(root.path()).entryList(QDir::AllEntries | QDir::NoDotAndDotDot).isEmpty());
}

TEST(KilledStudio, WhatAFullDiskKeptOutOfASessionIsWrittenLater) {
  const QTemporaryDir root;
  ModelStore store;
  SessionKeeper keeper(store, root.path());
  int said = 0;
  QObject::connect(&keeper, &SessionKeeper::failed, [&said] { ++said; });
  store.add("made", mesh_model(tetrahedron(), "a test"));
  {
    const turnscan::testing::FullDisk full(150);  // enough for the lock, not for a mesh
    keeper.flush();
  }
  EXPECT_EQ(said, 1);
  keeper.flush();
  const QDir session(
      root.filePath(QDir(root.path()).entryList(QDir::Dirs | QDir::NoDotAndDotDot).value(0)));
  EXPECT_EQ(session.entryList({"*.ply"}).size(), 1);
  EXPECT_TRUE(session.exists("session.json"));
}

struct Closing : ::testing::Test, FirstStart {};

/// Without a question: what is in no file is kept, and offered by the next start.
TEST_F(Closing, KeepsWhatACrashKeepsAndNothingThatIsInFiles) {
  const QTemporaryDir folder;
  const auto lost = [] { return SessionKeeper::find_lost(SessionKeeper::default_root()); };
  QStringList asked;
  {
    MainWindow window;
    show_window(window, {1000, 700});
    window.set_close_question([&](const QStringList& at_stake) {
      asked << at_stake;
      return true;
    });
    window.explorer().store().add("made", mesh_model(tetrahedron(), "a test"));
    EXPECT_TRUE(window.close());
  }
  EXPECT_TRUE(asked.isEmpty());
  const auto kept = lost();
  ASSERT_TRUE(kept.has_value());
  {
    MainWindow window;
    show_window(window, {1000, 700});
    window.explorer().restore_session(*kept);
    ASSERT_TRUE(wait_idle(window));
    ModelStore& store = window.explorer().store();
    EXPECT_EQ(store.unsaved(), QStringList{"made"});
    window.explorer().save_all(folder.path());
    ASSERT_TRUE(wait_idle(window));
    EXPECT_TRUE(QFile::exists(folder.filePath("made.ply")));
    EXPECT_TRUE(store.unsaved().isEmpty());
    EXPECT_TRUE(window.close());
  }
  EXPECT_FALSE(lost().has_value());
}

TEST_F(Closing, AsksWhereTheSessionCannotBeKept) {
  MainWindow window;
  show_window(window, {1000, 700});
  QStringList asked;
  window.set_close_question([&](const QStringList& at_stake) {
    asked << at_stake;
    return false;
  });
  window.explorer().store().add("made", mesh_model(tetrahedron(), "a test"));
  {
    const turnscan::testing::FullDisk full(150);
    EXPECT_FALSE(window.close());
  }
  ASSERT_EQ(asked.size(), 1);
  EXPECT_TRUE(asked[0].contains("made"));
}

}  // namespace
}  // namespace turnscan::studio
