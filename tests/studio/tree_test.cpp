// The tree of the Explorer: what was made of what, and with which options.

#include <gtest/gtest.h>

#include <QAction>
#include <QComboBox>
#include <QDir>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTabWidget>
#include <QTest>
#include <QTreeWidget>

#include "driver.hpp"
#include "explorer/explorer.hpp"
#include "explorer/model_list.hpp"
#include "explorer/session.hpp"
#include "explorer/verdict_panel.hpp"
#include "view/view_settings.hpp"
#include "widgets/section.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {
namespace {

class Tree : public ::testing::Test, FirstStart {
 protected:
  Tree() : store(window.explorer().store()) {
    show_window(window, {1440, 900});
    window.show_mode("explorer");
  }
  ExplorerMode& mode() { return window.explorer(); }
  QTreeWidget& tree() { return *qobject_cast<QTreeWidget*>(named(mode(), "model_list")); }
  QTabWidget& tabs() { return *mode().findChild<QTabWidget*>(); }
  /// A small recording of a doll, opened.
  void open_doll(const QStringList& more = {}) {
    const QStringList scan{"simulate", "builtin:doll", "-o", folder.filePath("doll"), "--frames",
                           "24"};
    ASSERT_EQ(run_command_line(scan + more), 0);
    window.open(folder.filePath("doll"));
    ASSERT_TRUE(wait_idle(window));
  }
  void press(QWidget* widget) {
    ASSERT_TRUE(click(widget));
    ASSERT_TRUE(wait_idle(window));
  }
  void act(const QString& text) {
    for (QAction* each : mode().list().findChildren<QAction*>())
      if (each->text() == text) return each->trigger();
    ADD_FAILURE() << text.toStdString();
  }
  /// Names of the nodes below one, with their marks.
  static std::string below(const QTreeWidgetItem& item) {
    QStringList names;
    for (int i = 0; i < item.childCount(); ++i)
      names << item.child(i)->text(0) + item.child(i)->text(1);
    return names.join(", ").toStdString();
  }
  std::string properties() {
    return qobject_cast<QPlainTextEdit*>(named(mode(), "model_properties"))
        ->toPlainText()
        .toStdString();
  }

  ScansFolder folder;
  MainWindow window;
  ModelStore& store;
};

TEST_F(Tree, HasStagesBelowTheirRecordingEachOnceWithWhatMadeIt) {
  ASSERT_NO_FATAL_FAILURE(open_doll());
  ASSERT_NO_FATAL_FAILURE(press(named(mode(), "run:voxels")));
  ASSERT_NO_FATAL_FAILURE(press(button_with(mode(), "Reconstruct")));
  ASSERT_EQ(tree().topLevelItemCount(), 1);
  const auto root = [&]() -> QTreeWidgetItem& { return *tree().topLevelItem(0); };
  EXPECT_EQ(below(root()), "voxels, mesh");
  EXPECT_NE(properties().find("Made with the defaults"), std::string::npos) << properties();
  const std::size_t triangles = store.models().back().data->mesh.triangles.size();
  // Anew with another option: the same node, marked.
  ASSERT_TRUE(type(named(mode(), "option:voxel-size"), "4"));
  ASSERT_NO_FATAL_FAILURE(press(button_with(mode(), "Reconstruct")));
  EXPECT_EQ(below(root()), "voxels, mesh≠");
  EXPECT_NE(store.models().back().data->mesh.triangles.size(), triangles);
  EXPECT_TRUE(root().child(1)->toolTip(1).contains("Voxel size 4 mm (default auto)"))
      << root().child(1)->toolTip(1).toStdString();
  EXPECT_NE(properties().find("≠ Voxel size 4 mm"), std::string::npos) << properties();
  keep_picture(window, "tree");
  // The options of a run are there again.
  ASSERT_TRUE(type(named(mode(), "option:voxel-size"), ""));
  act("Use its settings");
  EXPECT_EQ(qobject_cast<QLineEdit*>(named(mode(), "option:voxel-size"))->text(), "4mm");
  keep_picture(window, "tree-process");
  // It is one step of undo, and a duplicate or an edited mesh stays.
  mode().undo();
  EXPECT_EQ(below(root()), "voxels, mesh");
  EXPECT_EQ(store.models().back().data->mesh.triangles.size(), triangles);
  act("Duplicate");
  ASSERT_NO_FATAL_FAILURE(press(named(mode(), "edit_smooth")));
  EXPECT_EQ(below(root()), "voxels, mesh, mesh (2)");
  ASSERT_NO_FATAL_FAILURE(press(button_with(mode(), "Reconstruct")));
  EXPECT_EQ(store.models().size(), 5u) << below(root());
}

TEST_F(Tree, IsThereAgainAfterACrash) {
  ASSERT_TRUE(type(named(mode(), "option:voxel-size"), "4"));
  ASSERT_NO_FATAL_FAILURE(open_doll());
  ASSERT_NO_FATAL_FAILURE(press(button_with(mode(), "Reconstruct")));
  const std::string before = below(*tree().topLevelItem(0)), made = properties();
  EXPECT_EQ(before, "mesh≠");
  EXPECT_TRUE(mode().session().set_stays(true));
  const QDir root(SessionKeeper::default_root());
  const QStringList sessions = root.entryList(QDir::Dirs | QDir::NoDotAndDotDot);
  ASSERT_EQ(sessions.size(), 1);
  const LostSession lost{root.filePath(sessions[0]), read_list(root.filePath(sessions[0]))};
  const auto restored = restore(lost, RunContext());
  ASSERT_TRUE(restored.has_value());
  ModelStore again;
  ModelList list(again);
  again.set_states(restored->states, lost.list.place);
  auto* shown = list.findChild<QTreeWidget*>();
  ASSERT_EQ(shown->topLevelItemCount(), 1);
  EXPECT_EQ(below(*shown->topLevelItem(0)), before);
  list.select(again.models().back().id);
  const std::string told = list.findChild<QPlainTextEdit*>()->toPlainText().toStdString();
  const std::string options = made.substr(0, made.find("\n\n"));
  EXPECT_NE(options.find("Made with\n≠ Voxel size 4 mm"), std::string::npos) << options;
  EXPECT_EQ(told.substr(0, told.find("\n\n")), options);
  mode().session().set_stays(false);
}

TEST_F(Tree, HasPassesThatLeadToTheirFirstFrame) {
  ASSERT_NO_FATAL_FAILURE(open_doll({"--next-pass", "tip=90deg"}));
  QTreeWidgetItem* recording = tree().topLevelItem(0);
  EXPECT_EQ(below(*recording), "Pass 0, Pass 1");
  tree().setCurrentItem(recording->child(1));
  auto* text = qobject_cast<QLabel*>(named(mode(), "frame_text"));
  EXPECT_TRUE(text->text().contains("pass 1")) << text->text().toStdString();
  EXPECT_EQ(mode().list().selected(), store.models().front().id);
  store.set_visible(store.models().front().id, false);
  EXPECT_EQ(tree().currentItem()->text(0), "Pass 1");
}

TEST_F(Tree, TheVerdictIsOneSentenceAndItsFigureUntilMoreIsAskedFor) {
  ASSERT_NO_FATAL_FAILURE(open_doll());
  ASSERT_NO_FATAL_FAILURE(press(button_with(mode(), "Reconstruct")));
  auto* light = qobject_cast<QLabel*>(named(mode(), "verdict"));
  auto* first = qobject_cast<QLabel*>(named(mode(), "verdict_first"));
  QWidget* others = named(mode(), "verdict_others");
  ASSERT_TRUE(light->isVisible() && first->isVisible());
  EXPECT_FALSE(others->isVisible());
  EXPECT_EQ(first->text().count("<p "), 1);
  keep_picture(window, "verdict-card");
  auto* more = qobject_cast<Section*>(named(mode(), "verdict_more"));
  more->set_open(true);
  EXPECT_TRUE(others->isVisible());
  EXPECT_EQ(crowded(window), "");
  keep_picture(window, "verdict-unfolded");
  window.settings().set_dark(true);
  keep_picture(window, "verdict-dark");
  window.resize(1366, 768);
  keep_picture(window, "verdict-dark-small");
  window.settings().set_dark(false);
  // Closed and looked away from: the next scan's is there all the same.
  for (QWidget* up = light; up; up = up->parentWidget())
    if (auto* section = qobject_cast<Section*>(up)) section->set_open(false);
  tabs().setCurrentIndex(1);
  EXPECT_FALSE(light->isVisible());
  ASSERT_TRUE(type(named(mode(), "option:voxel-size"), "4"));
  ASSERT_NO_FATAL_FAILURE(press(button_with(mode(), "Reconstruct")));
  EXPECT_TRUE(light->isVisible() && first->isVisible());
}

}  // namespace
}  // namespace turnscan::studio
