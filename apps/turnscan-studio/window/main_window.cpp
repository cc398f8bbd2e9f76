#include "window/main_window.hpp"

#include <QApplication>
#include <QBuffer>
#include <QCloseEvent>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QMessageBox>
#include <QMimeData>
#include <QScreen>
#include <QSettings>
#include <QStackedWidget>
#include <QStatusBar>
#include <QToolButton>
#include <QVBoxLayout>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/recording/recording.hpp>

#include "app/jobs.hpp"
#include "app/paths.hpp"
#include "explorer/explorer.hpp"
#include "explorer/session.hpp"
#include "scanner/record_panel.hpp"
#include "scanner/scanner.hpp"
#include "simulator/simulator.hpp"
#include "view/scene_view.hpp"
#include "view/view_settings.hpp"
#include "widgets/message_log.hpp"
#include "widgets/theme.hpp"
#include "window/job_bar.hpp"

namespace turnscan::studio {

namespace {

constexpr int kRecentFiles = 10;

bool ask_in_a_dialog(QWidget* window, const QStringList& at_stake) {
  QMessageBox question(QMessageBox::Warning, QObject::tr("Quit?"), at_stake.join("\n\n"),
                       QMessageBox::NoButton, window);
  const auto* quit =
      question.addButton(QObject::tr("Quit without saving"), QMessageBox::DestructiveRole);
  question.setDefaultButton(question.addButton(QObject::tr("Stay"), QMessageBox::RejectRole));
  question.exec();
  return question.clickedButton() == quit;
}

}  // namespace

MainWindow::MainWindow()
    : jobs_(new JobRunner(this)),
      settings_(new ViewSettings(this)),
      stack_(new QStackedWidget(this)),
      mode_bar_(nullptr),
      scanner_(nullptr),
      explorer_(nullptr),
      simulator_(nullptr),
      status_(new QLabel(this)),
      ask_to_close_([this](const QStringList& stake) { return ask_in_a_dialog(this, stake); }) {
  setWindowTitle(tr("turnscan Studio"));
  setAcceptDrops(true);
  auto* center = new QWidget(this);
  auto* column = new QVBoxLayout(center);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(make_top_bar());
  column->addWidget(stack_, 1);
  setCentralWidget(center);
  statusBar()->addWidget(status_, 1);
  auto* job_bar = new JobBar(*jobs_, this);
  statusBar()->addPermanentWidget(job_bar);
  statusBar()->setSizeGripEnabled(false);
  scanner_ = new ScannerMode({*jobs_, *settings_}, stack_);
  add_mode("scanner", tr("3D Scanner"), tr("Calibrate and record with a sensor (F1)"), scanner_);
  explorer_ = new ExplorerMode({*jobs_, *settings_}, stack_);
  add_mode("explorer", tr("Model Explorer"), tr("Look at models and process them (F2)"), explorer_);
  simulator_ = new SimulatorMode({*jobs_, *settings_}, stack_);
  add_mode("simulator", tr("Scanner Simulator"), tr("Try a rig before it is built (F3)"),
           simulator_);
  connect(jobs_, &JobRunner::cancelled, this,
          [this](const QString& title) { say(tr("%1: cancelled").arg(title)); });
  // The status line's text about an earlier job is outdated.
  connect(jobs_, &JobRunner::failed, this,
          [this](const QString& title) { say(tr("%1: failed").arg(title)); });
  connect(explorer_, &ExplorerMode::file_opened, this, &MainWindow::add_recent);
  menu_ = make_main_menu(*this);
  connect(menu_.recent, &QMenu::aboutToShow, this, &MainWindow::fill_recent);
  connect(settings_, &ViewSettings::changed, this, &MainWindow::apply_settings);
  apply_settings();
  // The same height without a job, so that the view does not jump when one begins. Polished first,
  // because the style's edges count.
  job_bar->ensurePolished();
  for (QWidget* part : job_bar->findChildren<QWidget*>()) part->ensurePolished();
  statusBar()->setMinimumHeight(job_bar->sizeHint().height() + 6);
  restore_window();
}

MainWindow::~MainWindow() {
  // Before the modes, whose widgets receive the results of jobs.
  delete jobs_;
  jobs_ = nullptr;
}

QWidget* MainWindow::make_top_bar() {
  mode_bar_ = new QWidget(this);
  mode_bar_->setObjectName("top_bar");
  auto* row = new QHBoxLayout(mode_bar_);
  row->setContentsMargins(12, 7, 12, 7);
  row->setSpacing(6);
  row->addStretch();
  return mode_bar_;
}

void MainWindow::add_mode(const QString& name, const QString& title, const QString& tip,
                          Mode* mode) {
  stack_->addWidget(mode);
  auto* button = new QToolButton(mode_bar_);
  button->setObjectName("mode");
  button->setText(title);
  button->setToolTip(tip);
  button->setCheckable(true);
  button->setAutoExclusive(true);
  button->setShortcut(QKeySequence(name == "scanner"    ? Qt::Key_F1
                                   : name == "explorer" ? Qt::Key_F2
                                                        : Qt::Key_F3));
  static_cast<QHBoxLayout*>(mode_bar_->layout())->insertWidget(int(mode_buttons_.size()), button);
  mode_buttons_.emplace_back(name, button);
  connect(button, &QToolButton::clicked, this, [this, name] { show_mode(name); });
  connect(mode, &Mode::status, this, &MainWindow::say);
  connect(mode, &Mode::described, status_, &QLabel::setText);
  connect(mode, &Mode::mode_wanted, this, &MainWindow::show_mode);
  connect(mode, &Mode::undo_changed, this, [this] {
    if (menu_.undo) update_undo();
  });
  connect(mode, &Mode::another_side_wanted, this, [this](const AnotherSide& side) {
    show_mode("scanner");
    scanner_->scan_another_side(side);
  });
  connect(mode, &Mode::surface_left, this,
          [this](const DrawablePtr& surface) { explorer_->show_until_mesh(surface); });
  connect(mode, &Mode::scan_wanted, this, [this] {
    show_mode("scanner");
    scanner_->play_when_listed();
  });
  connect(mode, &Mode::recording_made, this, [this](const QString& folder, bool reconstruct) {
    show_mode("explorer");
    explorer_->take_recording(folder, reconstruct);
  });
  connect(mode, &Mode::recording_broken_off, this,
          [this](const QString& folder) { explorer_->take_recording(folder, false); });
}

void MainWindow::show_mode(const QString& name) {
  for (std::size_t i = 0; i < mode_buttons_.size(); ++i) {
    if (mode_buttons_[i].first != name) continue;
    mode_buttons_[i].second->setChecked(true);
    stack_->setCurrentIndex(int(i));
    QSettings().setValue("window/mode", name);
  }
  update_undo();
}

Mode& MainWindow::mode() const { return *static_cast<Mode*>(stack_->currentWidget()); }

void MainWindow::say(const QString& text) {
  status_->setText(text);
  messages().add(text, false);
}

void MainWindow::open(const QString& path) {
  show_mode("explorer");
  explorer_->open_file(path);
}

void MainWindow::screenshot(const QString& path) {
  const QImage picture = mode().view().screenshot();
  const auto no = [this](const QString& text) { say(text); };
  jobs_->start(
      tr("Save screenshot"), this,
      [this, picture, path](const RunContext&) -> Result<Finish> {
        QByteArray png;
        QBuffer buffer(&png);
        if (!picture.save(&buffer, "PNG"))
          return fail_at(path.toStdString(), ErrorCode::kIo, "the picture cannot be packed");
        TURNSCAN_TRY(write_file_atomically(path.toStdString(), png.toStdString()));
        return Finish([this, path] { say(tr("Wrote %1").arg(shown_path(path))); });
      },
      no);
}

void MainWindow::add_recent(const QString& path) {
  QSettings settings;
  QStringList recent = settings.value("files/recent").toStringList();
  const QString full = QFileInfo(path).absoluteFilePath();
  recent.removeAll(full);
  recent.prepend(full);
  while (recent.size() > kRecentFiles) recent.removeLast();
  settings.setValue("files/recent", recent);
}

void MainWindow::fill_recent() {
  menu_.recent->clear();
  for (const QString& path : QSettings().value("files/recent").toStringList())
    menu_.recent->addAction(shown_path(path), this, [this, path] { open(path); });
  if (menu_.recent->isEmpty()) menu_.recent->addAction(tr("No files yet"))->setEnabled(false);
}

void MainWindow::apply_settings() {
  menu_.dark->setChecked(settings_->dark());
  // A new style sheet lays out every widget again: only if the theme changed.
  if (property("theme").toInt() == (settings_->dark() ? 2 : 1)) return;
  setProperty("theme", settings_->dark() ? 2 : 1);
  apply_theme(*static_cast<QApplication*>(QApplication::instance()), settings_->theme());
}

void MainWindow::update_undo() {
  const QString undo = mode().undo_text(), redo = mode().redo_text();
  menu_.undo->setEnabled(!undo.isEmpty());
  menu_.redo->setEnabled(!redo.isEmpty());
  menu_.undo->setText(tr("Undo %1").arg(undo));
  menu_.redo->setText(tr("Redo %1").arg(redo));
}

void MainWindow::restore_window() {
  const QSettings settings;
  resize(1440, 900);
  // Including its frame, whose size is not known before it is shown.
  constexpr int kFrame = 48;
  if (const QScreen* on = screen())
    resize(size().boundedTo(on->availableSize() - QSize(kFrame / 3, kFrame)));
  restoreGeometry(settings.value("window/geometry").toByteArray());
  const QString last = settings.value("window/mode").toString();  // before a mode is stored
  show_mode("explorer");
  show_mode(last);
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  for (const QUrl& url : event->mimeData()->urls())
    if (url.isLocalFile() && !mode().open_file(url.toLocalFile())) open(url.toLocalFile());
}

/// What closing the window would interrupt or lose.
QStringList MainWindow::at_stake() const {
  QStringList out;
  const QStringList models = explorer_->store().unsaved();
  // They are offered by the next start.
  if (!explorer_->session().set_stays(!models.isEmpty()))
    out << tr("%n model(s) cannot be kept for the next start and are in no file: %1", nullptr,
              int(models.size()))
               .arg(models.join(", "));
  if (scanner_->is_recording()) out << tr("A recording runs; it ends, and what it has is kept");
  return out;
}

void MainWindow::offer_lost_session() {
  const auto lost = SessionKeeper::find_lost(SessionKeeper::default_root());
  if (!lost) return;
  QStringList names;
  for (const KeptModel& model : lost->models()) names << model.name;
  QMessageBox question(QMessageBox::Question, tr("Restore the last session?"),
                       tr("The last session had these models:\n%1").arg(names.join(", ")),
                       QMessageBox::NoButton, this);
  const auto* restore = question.addButton(tr("Restore"), QMessageBox::AcceptRole);
  const auto* discard = question.addButton(tr("Discard"), QMessageBox::DestructiveRole);
  question.addButton(tr("Ask again later"), QMessageBox::RejectRole);
  question.exec();
  if (question.clickedButton() == discard) SessionKeeper::discard(*lost);
  if (question.clickedButton() != restore) return;
  show_mode("explorer");
  explorer_->restore_session(*lost);
}

void MainWindow::offer_unfinished_recording() {
  const QString folder = RecordPanel::unfinished();
  if (folder.isEmpty()) return;
  const auto recording = Recording::open(folder.toStdString());
  if (!recording) return;  // it was ended before there was anything to go on with
  const int frames = int(recording->frames().size());
  QMessageBox question(
      QMessageBox::Question, tr("Go on with the recording?"),
      tr("The last session ended while it recorded. %1 has %n frame(s).", nullptr, frames)
          .arg(shown_path(folder)),
      QMessageBox::NoButton, this);
  const auto* go_on = question.addButton(tr("Go on"), QMessageBox::AcceptRole);
  const auto* leave = question.addButton(tr("Leave it"), QMessageBox::DestructiveRole);
  question.addButton(tr("Ask again later"), QMessageBox::RejectRole);
  question.exec();
  if (question.clickedButton() == leave) RecordPanel::leave_unfinished();
  if (question.clickedButton() != go_on) return;
  show_mode("scanner");
  scanner_->resume_recording(folder);
}

void MainWindow::closeEvent(QCloseEvent* event) {
  const QStringList stake = at_stake();
  if (!stake.isEmpty() && !ask_to_close_(stake)) {
    event->ignore();
    return;
  }
  QSettings().setValue("window/geometry", saveGeometry());
  for (int i = 0; i < stack_->count(); ++i) static_cast<Mode*>(stack_->widget(i))->shut_down();
  jobs_->cancel();
  event->accept();
}

}  // namespace turnscan::studio
