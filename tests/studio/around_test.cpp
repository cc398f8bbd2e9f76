// What stands around the work: units of files, the queue, exports, keys, the manual, languages,
// names for screen readers.

#include <gtest/gtest.h>
#include <map>

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QAccessible>
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QDir>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPlainTextEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QRegularExpression>
#include <QScrollArea>
#include <QSettings>
#include <QStatusBar>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTest>
#include <QTextBrowser>
#include <algorithm>
#include <set>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>

#include "app/jobs.hpp"
#include "app/language.hpp"
#include "driver.hpp"
#include "explorer/explorer.hpp"
#include "explorer/model_list.hpp"
#include "explorer/output/queue_dialog.hpp"
#include "explorer/session.hpp"
#include "explorer/session_list.hpp"
#include "scanner/scanner.hpp"
#include "simulator/simulator.hpp"
#include "view/scene_view.hpp"
#include "view/view_settings.hpp"
#include "widgets/section.hpp"
#include "widgets/text.hpp"
#include "window/help.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {
namespace {

class Around : public ::testing::Test, FirstStart {
 protected:
  Around() {
    show_window(window, {1366, 768});
    window.show_mode("explorer");
  }
  QString path(const QString& name) const { return folder.filePath(name); }
  ModelStore& store() { return window.explorer().store(); }
  /// The letter, 0.22 m tall, written `scale` times as large.
  QString letter(const QString& name, float scale) {
    TriangleMesh mesh = *builtin_object("letter-a");
    for (Vec3f& p : mesh.vertices) p *= scale;
    EXPECT_TRUE(write_mesh(path(name).toStdString(), mesh));
    return path(name);
  }
  double height(std::size_t model) {
    return box_of(*store().models().at(model).data->drawable).size().y();
  }

  ScansFolder folder;
  MainWindow window;
};

TEST_F(Around, AFileOfDoubtfulUnitAsksAndAPlausibleOneDoesNot) {
  std::vector<DoubtfulUnit> asked;
  std::optional<double> answer;
  window.explorer().set_unit_question([&](const DoubtfulUnit& doubt) {
    asked.push_back(doubt);
    return answer;
  });
  const double tall = bounds(builtin_object("letter-a")->vertices).size().y();
  window.open(letter("plain.obj", 1.0f));
  ASSERT_TRUE(wait_idle(window));
  EXPECT_TRUE(asked.empty());
  window.open(letter("mm.obj", 1000.0f));
  ASSERT_TRUE(wait_idle(window));
  ASSERT_EQ(asked.size(), 1u);
  EXPECT_EQ(store().models().size(), 1u) << "the question was dismissed";
  answer = 1e-3;
  asked.clear();
  window.open(letter("mm.obj", 1000.0f));
  ASSERT_TRUE(wait_idle(window));
  ASSERT_EQ(asked.size(), 1u);
  EXPECT_EQ(asked[0].file, "mm.obj");
  EXPECT_DOUBLE_EQ(asked[0].likely, 1e-3);
  ASSERT_EQ(store().models().size(), 2u);
  EXPECT_NEAR(height(1), tall, 1e-4);
  window.open(letter("mm.ply", 1000.0f));
  ASSERT_TRUE(wait_idle(window));
  EXPECT_NEAR(height(2), tall, 1e-4);
  // An STL in metres is read in millimetres: far too small.
  answer = 1.0;
  window.open(letter("metres.stl", 0.001f));
  ASSERT_TRUE(wait_idle(window));
  ASSERT_EQ(asked.size(), 3u);
  EXPECT_DOUBLE_EQ(asked[2].likely, 1.0);
  EXPECT_NEAR(height(3), tall, 1e-4);
  PointCloud cloud;
  cloud.points = {{0.0f, 0.0f, 0.0f}, {0.0f, 150.0f, 0.0f}, {60.0f, 0.0f, 0.0f}};
  ASSERT_TRUE(write_cloud(path("cloud.ply").toStdString(), cloud));
  answer = 1e-3;
  window.open(path("cloud.ply"));
  ASSERT_TRUE(wait_idle(window));
  EXPECT_NEAR(height(4), 0.15, 1e-6);
  // The session opens the person's own files again: with the same units.
  window.explorer().session().flush();
  const QDir root(SessionKeeper::default_root());
  const KeptList kept =
      read_list(root.filePath(root.entryList(QDir::Dirs | QDir::NoDotAndDotDot).front()));
  ASSERT_FALSE(kept.states.empty());
  const std::vector<KeptModel>& models = kept.states[kept.place].models;
  EXPECT_EQ(models.size(), 5u);
  EXPECT_EQ(std::count_if(models.begin(), models.end(),
                          [](const KeptModel& model) { return model.metres_per_unit.has_value(); }),
            4);
}

TEST_F(Around, AnOpenedModelIsFramedWhereverTheCameraIs) {
  window.explorer().set_unit_question(
      [](const DoubtfulUnit& doubt) { return doubt.metres_per_unit; });
  window.open(letter("large.obj", 60.0f));  // 13 m tall
  ASSERT_TRUE(wait_idle(window));
  window.open(letter("small.obj", 1.0f));
  ASSERT_TRUE(wait_idle(window));
  EXPECT_TRUE(window.mode().view().sees(box_of(*store().models()[1].data->drawable)));
  EXPECT_FALSE(window.mode().view().sees(box_of(*store().models()[0].data->drawable)));
  // What is seen already does not move the camera.
  const double scale = window.mode().view().metres_per_pixel();
  window.open(letter("again.obj", 0.9f));
  ASSERT_TRUE(wait_idle(window));
  EXPECT_DOUBLE_EQ(window.mode().view().metres_per_pixel(), scale);
}

TEST_F(Around, TheQueueReconstructsAllThatCanBeAndSaysWhyTheOthersCannot) {
  for (const char* name : {"one", "two"})
    ASSERT_EQ(run_command_line({"simulate", "builtin:letter-a", "-o", path(name), "--frames", "12",
                                "--scanner", "kinect-v2"}),
              0);
  ASSERT_TRUE(type(named(window.explorer(), "option:voxel-size"), "4"));
  QueueDialog queue(window.explorer(), window.jobs());
  queue.show();
  queue.add({path("one"), path("missing"), path("two"), path("one")});
  auto* table = queue.findChild<QTableWidget*>("queue_table");
  ASSERT_EQ(table->rowCount(), 3);
  ASSERT_TRUE(type(queue.findChild<QLineEdit*>("queue_folder"), path("meshes")));
  ASSERT_TRUE(click(button_with(queue, "Reconstruct all")));
  ASSERT_TRUE(wait_idle(window, 300));
  keep_picture(queue, "queue");
  EXPECT_TRUE(table->item(0, 1)->text().contains("triangles"))
      << table->item(0, 1)->text().toStdString();
  EXPECT_TRUE(table->item(1, 1)->text().contains("missing"))
      << table->item(1, 1)->text().toStdString();
  EXPECT_TRUE(table->item(2, 1)->text().contains("triangles"));
  EXPECT_EQ(store().models().size(), 2u);
  EXPECT_TRUE(store().unsaved().isEmpty());
  EXPECT_EQ(QDir(path("meshes")).entryList(QDir::Files), QStringList({"one.ply", "two.ply"}));
}

TEST_F(Around, AnExportHasTheTrianglesAndTheUnitThatWereAskedFor) {
  ASSERT_TRUE(write_mesh(path("cylinder.ply").toStdString(), *builtin_object("cylinder")));
  window.open(path("cylinder.ply"));
  ASSERT_TRUE(wait_idle(window));
  const std::size_t all = store().models()[0].data->mesh.triangles.size();
  const double tall = height(0);
  ExportOptions options;
  options.metres_per_unit = 0.0254;
  options.triangles = all / 2;
  window.explorer().export_as(1, path("inches.stl"), options);
  ASSERT_TRUE(wait_idle(window));
  const auto read = read_mesh(path("inches.stl").toStdString(), {0.0254});
  ASSERT_TRUE(read);
  EXPECT_LE(read->triangles.size(), all / 2);
  EXPECT_GT(read->triangles.size(), all / 8);
  EXPECT_NEAR(bounds(read->vertices).size().y(), tall, 1e-4);
}

TEST_F(Around, TheKeysThatAreListedAreThoseThatWork) {
  const auto lines = keys_of(window);
  std::set<QString> keys;
  for (const KeyLine& line : lines) keys.insert(line.keys);
  for (const char* each : {"F1", "F2", "F3", "?", "Ctrl+F1", "Ctrl+O", "Ctrl+S", "Ctrl+E", "Ctrl+R",
                           "Ctrl+Z", "Ctrl+Shift+R", "Home", "1", "B", "Esc", "Ctrl+L"})
    EXPECT_EQ(keys.count(each), 1u) << each;
  QTest::keyClick(&window, Qt::Key_Question);
  QWidget* dialog = nullptr;
  ASSERT_TRUE(wait_for([&] { return (dialog = named(window, "keys")) != nullptr; }, 5.0));
  auto* text = dialog->findChild<QTextBrowser*>();
  EXPECT_TRUE(text->toPlainText().contains("Ctrl+Shift+R"));
  keep_picture(*dialog, "keys");
}

TEST_F(Around, TheManualOpensWithItsPicturesAndLinks) {
  ASSERT_FALSE(manual_file().isEmpty());
  show_manual(window);
  QWidget* dialog = named(window, "manual");
  ASSERT_NE(dialog, nullptr);
  auto* browser = dialog->findChild<QTextBrowser*>();
  ASSERT_TRUE(wait_for([&] { return browser->toPlainText().contains("Model Explorer"); }, 5.0));
  keep_picture(*dialog, "manual");
  browser->setSource(browser->source().resolved(QUrl("textures.md")));
  EXPECT_TRUE(browser->toPlainText().contains("atlas"));
  EXPECT_FALSE(browser->toPlainText().contains("|---|"));  // a table, not its text
}

TEST_F(Around, TheManualIsItsSiteWhereThatIsInstalled) {
  EXPECT_TRUE(site_file().isEmpty());
  const QTemporaryDir prefix;
  const QString page = prefix.filePath("share/doc/turnscan/html/index.html");
  for (const char* part : {"share/turnscan/scanners", "share/doc/turnscan/html"})
    ASSERT_TRUE(QDir().mkpath(prefix.filePath(part)));
  ASSERT_TRUE(QFile(page).open(QIODevice::WriteOnly));
  const QByteArray data = qgetenv("TURNSCAN_DATA");
  qputenv("TURNSCAN_DATA", prefix.filePath("share/turnscan").toUtf8());
  EXPECT_EQ(site_file(), page);
  qputenv("TURNSCAN_DATA", data);
}

TEST_F(Around, AboutNamesVersionAndLicences) {
  show_about(window);
  QWidget* dialog = named(window, "about");
  ASSERT_NE(dialog, nullptr);
  const QString text = dialog->findChild<QTextBrowser*>()->toPlainText();
  for (const char* part : {"Apache License", "TERMS AND CONDITIONS", "VTK", "LGPL", qVersion()})
    EXPECT_TRUE(text.contains(part)) << part;
  keep_picture(*dialog, "about");
}

/// Controls that a screen reader could not name.
std::string nameless(QWidget& in) {
  std::string found;
  for (QWidget* each : in.findChildren<QWidget*>()) {
    const bool control = qobject_cast<QAbstractButton*>(each) || qobject_cast<QLineEdit*>(each) ||
                         qobject_cast<QComboBox*>(each) || qobject_cast<QAbstractSlider*>(each) ||
                         qobject_cast<QAbstractItemView*>(each) ||
                         qobject_cast<QPlainTextEdit*>(each) || qobject_cast<QTextBrowser*>(each) ||
                         qobject_cast<QProgressBar*>(each);
    // Parts of Qt's own controls: scroll bars, the list of a combo box.
    bool inner = each->objectName().startsWith("qt_") || each->inherits("QScrollBar") ||
                 each->inherits("QHeaderView") || each->inherits("QTableCornerButton") ||
                 each->inherits("QComboBoxListView");
    for (QWidget* up = each->parentWidget(); up; up = up->parentWidget())
      inner = inner || up->inherits("QLineEdit") || up->inherits("QComboBox") ||
              up->inherits("QComboBoxPrivateContainer") || up->inherits("QMenuBar");
    if (!control || inner) continue;
    const QAccessibleInterface* said = QAccessible::queryAccessibleInterface(each);
    // More than signs: "…" says nothing.
    static const QRegularExpression word("\\w");
    if (!said || !said->text(QAccessible::Name).contains(word))
      found += std::string(each->metaObject()->className()) + " " +
               each->objectName().toStdString() + " of " +
               each->parentWidget()->metaObject()->className() + " '" +
               each->toolTip().left(40).toStdString() + "'\n";
  }
  return found;
}

TEST_F(Around, EveryControlHasANameForScreenReaders) {
  QueueDialog queue(window.explorer(), window.jobs(), &window);
  ASSERT_TRUE(wait_for([&] { return window.simulator().ready(); }));
  EXPECT_EQ(nameless(window), "");
}

TEST_F(Around, LongNumbersAreShownShort) {
  EXPECT_EQ(short_value("1.98754mm"), "1.99 mm");
  EXPECT_EQ(short_value("256000000"), QString("256 000 000").replace(' ', QChar(0x202f)));
  EXPECT_EQ(short_value("0.2deg"), "0.2 deg");
  EXPECT_EQ(short_value("10.4478deg/s"), "10.4 deg/s");
  EXPECT_EQ(short_value("120mm"), "120 mm");
  EXPECT_EQ(short_value("-0.0346mm"), "-0.0346 mm");
  EXPECT_EQ(short_value("poisson"), "poisson");
  EXPECT_EQ(short_value("8"), "8");
}

TEST_F(Around, NoFieldShowsANumberWithAnExponent) {
  for (const QLineEdit* each : window.findChildren<QLineEdit*>())
    EXPECT_FALSE(each->text().contains("e+"))
        << each->objectName().toStdString() << " " << each->text().toStdString();
}

TEST_F(Around, TheListSaysHowManyFramesOfARecordingWereDropped) {
  ASSERT_EQ(run_command_line({"simulate", "builtin:letter-a", "-o", path("letter"), "--frames",
                              "16", "--scanner", "kinect-v2"}),
            0);
  QFile table(path("letter/frames.csv"));
  ASSERT_TRUE(table.open(QIODevice::ReadWrite));
  QByteArray text = table.readAll();
  ASSERT_TRUE(text.contains(",ok\n"));
  const int last = text.lastIndexOf(",ok");
  text.replace(last, 3, ",dropped");  // as a recorder notes a frame that it could not keep
  table.resize(0);
  table.write(text);
  table.close();
  window.open(path("letter"));
  ASSERT_TRUE(wait_idle(window));
  ASSERT_EQ(store().models().size(), 1u);
  const ModelData& data = *store().models()[0].data;
  EXPECT_TRUE(data.report.contains(QRegularExpression("frames: +16, 1 dropped")))
      << data.report.toStdString();
  EXPECT_EQ(count_text(data), "15 frames, 1 dropped");
}

TEST_F(Around, AFailedSaveDoesNotLeaveThatSomethingWasWritten) {
  window.open(letter("letter.ply", 1.0f));
  ASSERT_TRUE(wait_idle(window));
  window.explorer().export_as(1, path("good.ply"), {});
  ASSERT_TRUE(wait_idle(window));
  const auto said = [&] {
    QString all;
    for (const QLabel* label : window.statusBar()->findChildren<QLabel*>()) all += label->text();
    return all;
  };
  EXPECT_TRUE(said().contains("Wrote"));
  window.explorer().export_as(1, "/proc/bad.ply", {});
  ASSERT_TRUE(wait_idle(window));
  EXPECT_FALSE(said().contains("Wrote")) << said().toStdString();
}

TEST_F(Around, ThereIsAWindowInEachLanguage) {
  if (languages().size() < 2) GTEST_SKIP() << "built without lrelease";
  const std::map<QString, QString> words{{"en", "Reconstruct"},
                                         {"es", "Reconstruir"},
                                         {"de", "Rekonstruieren"},
                                         {"fr", "Reconstruire"}};
  EXPECT_EQ(words.size(), languages().size());
  for (const auto& [code, word] : words) {
    install_language(*QApplication::instance(), code);
    MainWindow other;
    show_window(other, {1366, 768});
    other.show_mode("explorer");
    EXPECT_NE(button_with(other.explorer(), word), nullptr) << code.toStdString();
    for (const char* name : {"scanner", "explorer", "simulator"}) {
      other.show_mode(name);
      ASSERT_TRUE(wait_for([&] { return other.simulator().ready(); }));
      keep_picture(other, QString("%1-%2").arg(code, name));
      for (const QPushButton* button : other.mode().findChildren<QPushButton*>())
        EXPECT_TRUE(!button->isVisible() || button->width() >= button->sizeHint().width())
            << code.toStdString() << ": " << button->text().toStdString() << " is cut";
      for (const QScrollArea* area : other.mode().findChildren<QScrollArea*>()) {
        const auto fits = [&] { return area->widget()->width() <= area->viewport()->width(); };
        EXPECT_TRUE(!area->isVisible() || wait_for(fits, 5.0))
            << code.toStdString() << ", " << name;
      }
    }
  }
  install_language(*QApplication::instance(), "en");
  MainWindow english;
  EXPECT_NE(button_with(english.explorer(), "Reconstruct"), nullptr);
}

TEST_F(Around, TheLanguageIsTheChosenOneOrThatOfTheSystem) {
  if (languages().size() < 2) GTEST_SKIP() << "built without lrelease";
  EXPECT_EQ(chosen_language(), "");
  choose_language("es");
  EXPECT_EQ(shown_language(), "es");
  choose_language("xx");
  EXPECT_EQ(chosen_language(), "");
  choose_language("en");
  EXPECT_EQ(shown_language(), "en");
}

}  // namespace
}  // namespace turnscan::studio
