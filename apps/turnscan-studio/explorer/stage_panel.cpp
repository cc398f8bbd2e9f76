#include "explorer/stage_panel.hpp"

#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSettings>
#include <QVBoxLayout>
#include <deque>
#include <map>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/workflow/config_file.hpp>

#include "app/paths.hpp"
#include "explorer/stage_runs.hpp"
#include "widgets/option_form.hpp"
#include "widgets/section.hpp"
#include "widgets/text.hpp"

namespace turnscan::studio {

namespace {

const std::map<std::string, QString>& titles() {
  static const std::map<std::string, QString> names{{"crop", QObject::tr("Crop")},
                                                    {"outliers", QObject::tr("Statistical filter")},
                                                    {"merge", QObject::tr("Merge")},
                                                    {"voxels", QObject::tr("Voxelisation")},
                                                    {"candidates", QObject::tr("Candidate points")},
                                                    {"components", QObject::tr("Objects")},
                                                    {"normals", QObject::tr("Normals")},
                                                    {"refine", QObject::tr("Refinement")},
                                                    {"base", QObject::tr("Base")},
                                                    {"surface", QObject::tr("Mesh")},
                                                    {"volumetric", QObject::tr("Volumetric mesh")},
                                                    {"finish", QObject::tr("Finish")},
                                                    {"texture", QObject::tr("Texture")}};
  return names;
}

/// Stage of a section -> the clouds that it can make, and the texts of their buttons.
const std::multimap<std::string, std::pair<std::string, QString>>& outputs() {
  static const std::multimap<std::string, std::pair<std::string, QString>> made{
      {"merge", {"merged", QObject::tr("Merge the frames")}},
      {"voxels", {"voxels", QObject::tr("Voxelise")}},
      {"candidates", {"sub-voxels", QObject::tr("Count contributions")}},
      {"candidates", {"candidates", QObject::tr("Find candidates")}},
      {"refine", {"refined", QObject::tr("Refine candidates")}},
      {"base", {"oriented", QObject::tr("Oriented points")}}};
  return made;
}

}  // namespace

StagePanel::StagePanel(QWidget* parent)
    : QWidget(parent),
      options_(std::make_unique<ReconstructOptions>()),
      error_(new MessageLabel(this)),
      notice_(quiet_label({}, this)) {
  notice_->setObjectName("quiet");
  notice_->setTextInteractionFlags(Qt::LinksAccessibleByMouse | Qt::LinksAccessibleByKeyboard);
  connect(notice_, &QLabel::linkActivated, this, &StagePanel::reset);
  build();
  restore();
  show_notice();
}

StagePanel::~StagePanel() = default;

void StagePanel::build() {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  mesh_ = primary_button(tr("Reconstruct"),
                         tr("Run every stage on the selected recording or cloud (Ctrl+R)"), this);
  mesh_->setShortcut(QKeySequence("Ctrl+R"));
  connect(mesh_, &QPushButton::clicked, this,
          [this] { Q_EMIT run(QString::fromStdString(kMeshStage)); });
  auto* top = new QVBoxLayout;
  top->setSpacing(8);
  top->setContentsMargins(0, 2, 0, 6);
  top->addLayout(make_preset_buttons());
  layout->addLayout(top);
  for (OptionGroup& stage : describe_stages(*options_))
    layout->addWidget(make_section(stage.name, std::move(stage.table)));
}

QLayout* StagePanel::make_preset_buttons() {
  auto* row = new QHBoxLayout;
  row->setSpacing(6);
  auto* load = button(tr("Load preset…"), tr("Options from a TOML file"), this);
  auto* save = button(tr("Save preset…"), tr("Options as a TOML file for --config"), this);
  auto* reset = button(tr("Defaults"), tr("Set all options back"), this);
  for (QPushButton* each : {load, save, reset}) row->addWidget(each);
  const QString filter = tr("Presets (*.toml)");
  connect(load, &QPushButton::clicked, this, [this, filter] {
    const QString path = QFileDialog::getOpenFileName(this, tr("Load preset"), {}, filter);
    if (path.isEmpty()) return;
    const auto read = load_preset(path.toStdString());
    show_error(read ? QString() : QString::fromStdString(read.error().text()));
  });
  connect(save, &QPushButton::clicked, this, [this, filter] {
    const QString path = ask_save_path(this, tr("Save preset"), "preset.toml", filter);
    if (!path.isEmpty()) Q_EMIT save_preset(path);
  });
  connect(reset, &QPushButton::clicked, this, &StagePanel::reset);
  return row;
}

void StagePanel::reset() {
  for (const auto& [stage, form] : forms_) form->reset_to_defaults();
  show_error({});
}

/// And the fields of the method that is chosen.
void StagePanel::show_notice() {
  QStringList differing;
  for (const auto& [stage, form] : forms_)
    for (const QString& name : form->values().keys())
      differing << translated_title(name.toStdString()).toHtmlEscaped();
  const SurfaceMethod method = options_->surface.method;
  for (const auto& [stage, form] : forms_) {
    if (stage != "surface") continue;
    form->show_fields("poisson-", method == SurfaceMethod::kPoisson);
    form->show_fields("alpha", method == SurfaceMethod::kConcaveHull);
  }
  notice_->setVisible(!differing.isEmpty());
  notice_->setText(tr("Not at the defaults: %1. <a href=\"reset\">Reset</a>")
                       .arg(differing.mid(0, 4).join(", ") + (differing.size() > 4 ? ", …" : "")));
}

Section* StagePanel::make_section(const std::string& stage, OptionTable table) {
  const auto title = titles().find(stage);
  auto* section = new Section(title == titles().end() ? translated_title(stage) : title->second,
                              false, this, Section::kNested);
  section->setObjectName("stage:" + QString::fromStdString(stage));
  auto* form = new OptionForm(std::move(table), {}, section);
  section->body()->addWidget(form);
  forms_.emplace_back(stage, form);
  connect(form, &OptionForm::changed, this, &StagePanel::store);
  connect(form, &OptionForm::changed, this, &StagePanel::show_notice);
  add_run_button(stage, *section);
  return section;
}

void StagePanel::add_run_button(const std::string& stage, Section& section) {
  if (stage == "outliers") {
    filter_ = button(tr("Filter the cloud"),
                     tr("Drop outliers of the selected cloud; adds a new model"), &section);
    filter_->setObjectName("run:outliers");
    connect(filter_, &QPushButton::clicked, this, &StagePanel::filter);
    section.body()->addWidget(filter_);
  }
  const auto [first, last] = outputs().equal_range(stage);
  for (auto made = first; made != last; ++made) {
    const QString output = QString::fromStdString(made->second.first);
    auto* start =
        button(made->second.second,
               tr("Run the stages up to this one; adds its cloud as a new model"), &section);
    start->setObjectName("run:" + output);
    connect(start, &QPushButton::clicked, this, [this, output] { Q_EMIT run(output); });
    section.body()->addWidget(start);
    run_buttons_.push_back(start);
  }
}

void StagePanel::set_option(const std::string& stage, const QString& name, const QString& value) {
  for (const auto& [of, form] : forms_)
    if (of == stage) form->set_values({{name, value}});
}

void StagePanel::use(const MadeWith& made) {
  reset();
  QMap<QString, QString> values;
  for (const ResolvedParameter& option : made.changed)
    values[QString::fromStdString(option.option)] = QString::fromStdString(option.value);
  for (const auto& [stage, form] : forms_) form->set_values(values);
}

QString StagePanel::first_error() const {
  for (const auto& [stage, form] : forms_)
    if (!form->valid()) return form->first_error();
  return {};
}

void StagePanel::show_used(const std::vector<ResolvedParameter>& choices) {
  for (const ResolvedParameter& choice : choices)
    for (const auto& [stage, form] : forms_)
      form->show_used(QString::fromStdString(choice.option), QString::fromStdString(choice.value),
                      QString::fromStdString(choice.reason));
}

void StagePanel::show_error(const QString& text) { error_->show_text(text); }

void StagePanel::add_error(const QString& text) { error_->add_text(text); }

QWidget* StagePanel::error() const { return error_; }

QWidget* StagePanel::notice() const { return notice_; }

QWidget* StagePanel::action() const { return mesh_; }

void StagePanel::set_target(bool has_input, bool cloud) {
  mesh_->setEnabled(has_input);
  for (QPushButton* start : run_buttons_) start->setEnabled(has_input);
  filter_->setEnabled(cloud);
}

std::string StagePanel::preset_text() const {
  std::string text;
  for (const auto& [stage, form] : forms_) {
    std::string lines;
    const QMap<QString, QString> values = form->values();
    for (auto it = values.begin(); it != values.end(); ++it)
      lines += fmt::format("{} = \"{}\"\n", it.key().toStdString(), it.value().toStdString());
    if (!lines.empty()) text += fmt::format("{}[{}]\n{}", text.empty() ? "" : "\n", stage, lines);
  }
  return text.empty() ? "# all options at their defaults\n" : text;
}

Result<> StagePanel::load_preset(const std::string& path) {
  ReconstructOptions fresh;
  std::deque<OptionGroup> groups;
  for (OptionGroup& stage : describe_stages(fresh)) groups.push_back(std::move(stage));
  TURNSCAN_TRY(read_config_file(path, groups));
  *options_ = fresh;
  for (const auto& [stage, form] : forms_) form->refresh();
  store();
  show_notice();
  return {};
}

void StagePanel::store() const {
  for (const auto& [stage, form] : forms_) form->store("stages/" + QString::fromStdString(stage));
}

/// All are read before the first is set, because a change stores them.
void StagePanel::restore() {
  QSettings settings;
  std::vector<QMap<QString, QString>> stored;
  for (const auto& [stage, form] : forms_) {
    settings.beginGroup("stages/" + QString::fromStdString(stage));
    QMap<QString, QString> values;
    for (const QString& key : settings.childKeys()) values[key] = settings.value(key).toString();
    stored.push_back(values);
    settings.endGroup();
  }
  for (std::size_t i = 0; i < forms_.size(); ++i) forms_[i].second->set_values(stored[i]);
}

}  // namespace turnscan::studio
