#include "simulator/scanner_editor.hpp"

#include <QComboBox>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/sensors/scanner_file.hpp>

#include "app/paths.hpp"
#include "widgets/no_wheel.hpp"
#include "widgets/option_form.hpp"
#include "widgets/section.hpp"

namespace turnscan::studio {

namespace {

/// The fields of `now` that differ from `before`.
std::vector<std::pair<std::string, std::string>> differences(const OptionTable& now,
                                                             const OptionTable& before) {
  std::vector<std::pair<std::string, std::string>> out;
  for (std::size_t i = 0; i < now.fields().size(); ++i) {
    const std::string value = now.fields()[i].get();
    if (value != before.fields()[i].get()) out.emplace_back(now.fields()[i].name, value);
  }
  return out;
}

}  // namespace

ScannerEditor::ScannerEditor(const ScannerEntry& entry, ScannerParameters base, ScannerSetup setup,
                             QWidget* parent)
    : QWidget(parent),
      name_(QString::fromStdString(entry.model)),
      base_(std::move(base)),
      before_(setup.parameters),
      setup_(std::make_unique<ScannerSetup>(std::move(setup))),
      model_(scanner_model(setup_->parameters).value_or(ScannerModel())) {
  build();
}

ScannerEditor::~ScannerEditor() {
  for (OptionForm* form : forms_) delete form;  // before what they refer to
}

void ScannerEditor::build() {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  auto* scanner = new Section(tr("What it is"), false, this, Section::kNested);
  auto* place = new Section(tr("Where it stands"), true, this, Section::kNested);
  auto* noise = new Section(tr("Its noise"), false, scanner, Section::kNested);
  auto* row = new QHBoxLayout;
  auto* presets = new QComboBox(scanner);
  presets->setObjectName("scanner_fill");
  presets->setAccessibleName(tr("Preset to fill the fields from"));
  presets->addItem(tr("Fill from…"));
  for (const std::string& preset : scanner_presets())
    presets->addItem(QString::fromStdString(preset));
  leave_wheel_to_panel(presets);
  presets->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  presets->setMinimumContentsLength(6);
  auto* save = button(tr("Save as scanner…"),
                      tr("These fields as a file for --scanner and for Add scanner"), scanner);
  row->addWidget(presets, 1);
  row->addWidget(save);
  scanner->body()->addLayout(row);
  add_form(describe(setup_->placement), {"distance", "elevation", "azimuth", "pan", "tilt", "roll"},
           place);
  add_form(describe(setup_->parameters),
           {"near", "far", "columns", "rows", "vertical-fov", "fx", "fy", "baseline",
            "baseline-direction", "max-incidence"},
           scanner);
  add_form(describe(setup_->parameters.noise), {}, noise);
  scanner->body()->addWidget(noise);
  layout->addWidget(place);
  layout->addWidget(scanner);
  layout->addStretch();
  connect(presets, qOverload<int>(&QComboBox::activated), this, [this, presets](int index) {
    if (index > 0) fill(presets->itemText(index));
    presets->setCurrentIndex(0);
  });
  connect(save, &QPushButton::clicked, this, &ScannerEditor::save_dialog);
}

OptionForm* ScannerEditor::add_form(OptionTable table, const QStringList& sliders,
                                    QWidget* section) {
  auto* form = new OptionForm(std::move(table), {}, section, sliders);
  static_cast<Section*>(section)->body()->addWidget(form);
  forms_.push_back(form);
  connect(form, &OptionForm::changed, this, &ScannerEditor::take_fields);
  return form;
}

/// Field of view and focal length exclude each other: the one that is set takes the other's place.
void ScannerEditor::take_fields() {
  ScannerParameters& p = setup_->parameters;
  const bool focal = p.fx || p.fy, focal_before = before_.fx || before_.fy;
  if (p.fov_y_rad && focal) {
    if (focal_before) p.fx = p.fy = std::nullopt;
    if (!focal_before) p.fov_y_rad = p.aspect = std::nullopt;
    forms_[1]->refresh();
  }
  before_ = p;
  auto model = scanner_model(p);
  problem_ = model ? QString() : QString::fromStdString(model.error().message);
  if (model) model_ = std::move(*model);
  Q_EMIT changed();
}

QString ScannerEditor::error() const {
  for (const OptionForm* form : forms_)
    if (!form->valid()) return form->first_error();
  return problem_;
}

void ScannerEditor::refresh() {
  for (OptionForm* form : forms_) form->refresh();
}

ScannerEditor::Values ScannerEditor::changed_keys() const {
  ScannerParameters before = base_;
  return differences(describe_all(setup_->parameters), describe_all(before));
}

ScannerEntry ScannerEditor::entry(std::optional<ScannerPlacement> common) const {
  ScannerEntry out{name_.toStdString(), {}};
  if (common) {
    out.options = differences(describe(setup_->placement), describe(*common));
  } else {
    const OptionTable place = describe(setup_->placement);
    for (const auto& field : place.fields()) out.options.emplace_back(field.name, field.get());
  }
  const Values keys = changed_keys();
  out.options.insert(out.options.end(), keys.begin(), keys.end());
  return out;
}

QString ScannerEditor::title() const {
  const QString name = QFileInfo(name_).completeBaseName();
  return changed_keys().empty() ? name : tr("%1, changed").arg(name);
}

void ScannerEditor::fill(const QString& preset_or_file) {
  const auto found = find_scanner_parameters(preset_or_file.toStdString());
  if (!found) return Q_EMIT failed(QString::fromStdString(found.error().text()));
  name_ = preset_or_file;
  base_ = before_ = setup_->parameters = *found;
  refresh();
  take_fields();
}

void ScannerEditor::save_dialog() {
  const QString path =
      ask_save_path(this, tr("Save as scanner"), "scanner.toml", tr("Scanners (*.toml)"));
  if (!path.isEmpty()) save_as(path);
}

void ScannerEditor::save_as(const QString& file) {
  const QString path = file.endsWith(".toml") ? file : file + ".toml";
  Values keys = changed_keys();
  const bool named =
      std::any_of(keys.begin(), keys.end(), [](const auto& key) { return key.first == "name"; });
  if (!named) keys.emplace_back("name", QFileInfo(path).completeBaseName().toStdString());
  const auto text = error().isEmpty()
                        ? scanner_toml(name_.toStdString(), keys)
                        : fail(ErrorCode::kInvalidOption, "{}", error().toStdString());
  const auto written = text.and_then(
      [&](const std::string& toml) { return write_file_atomically(path.toStdString(), toml); });
  if (!written) return Q_EMIT failed(QString::fromStdString(written.error().text()));
  fill(path);
  Q_EMIT saved(path);
}

}  // namespace turnscan::studio
