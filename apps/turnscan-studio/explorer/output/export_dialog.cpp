#include "explorer/output/export_dialog.hpp"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QIntValidator>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSettings>
#include <QSignalBlocker>
#include <QStandardItemModel>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>

#include "explorer/output/doubtful_unit.hpp"
#include "widgets/section.hpp"
#include "widgets/text.hpp"

namespace turnscan::studio {

namespace {

QComboBox* combo(const QString& object_name, QWidget* parent) {
  auto* made = new QComboBox(parent);
  made->setObjectName(object_name);
  return made;
}

void choose(QComboBox& box, const QVariant& value) {
  const int at = box.findData(value);
  if (at >= 0) box.setCurrentIndex(at);
}

void set_entry_enabled(const QComboBox& box, int at, bool on) {
  if (auto* entries = qobject_cast<QStandardItemModel*>(box.model()))
    entries->item(at)->setEnabled(on);
}

}  // namespace

ExportDialog::ExportDialog(const ModelData& model, const QString& name, QWidget* parent)
    : QDialog(parent),
      kind_(model.kind),
      colored_(kind_ == ModelKind::kMesh ? !model.mesh.colors.empty()
                                         : !model.cloud.colors.empty()),
      textured_(kind_ == ModelKind::kMesh && has_texture(model.mesh)),
      all_triangles_(model.mesh.triangles.size()),
      format_(combo("export_format", this)),
      unit_(combo("export_unit", this)),
      up_(combo("export_up", this)),
      colors_(combo("export_colors", this)),
      triangles_(new QLineEdit(this)),
      note_(quiet_label({}, this)) {
  setWindowTitle(tr("Export %1").arg(name));
  format_->addItem(tr("PLY"), ".ply");
  if (kind_ == ModelKind::kMesh) {
    format_->addItem(tr("STL, for printing"), ".stl");
    format_->addItem(tr("3MF, for printing, with colours"), ".3mf");
    format_->addItem(tr("OBJ"), ".obj");
    format_->addItem(tr("GLB, for the web"), ".glb");
  }
  const QString units[] = {tr("Millimetres"), tr("Centimetres"), tr("Inches"), tr("Metres")};
  for (int i = 0; i < 4; ++i) unit_->addItem(units[i], kFileUnits_m[i]);
  up_->addItem(tr("Usual for the format: Z in STL and 3MF, else Y"), int(UpAxis::kFormat));
  up_->addItem(tr("Y, as in the view"), int(UpAxis::kY));
  up_->addItem(tr("Z, as slicers and CAD have it"), int(UpAxis::kZ));
  colors_->addItem(tr("Texture"), int(ExportColors::kTexture));
  colors_->addItem(tr("Colours of the vertices"), int(ExportColors::kVertices));
  colors_->addItem(tr("None"), int(ExportColors::kNone));
  triangles_->setObjectName("export_triangles");
  triangles_->setPlaceholderText(tr("all %1").arg(grouped(all_triangles_)));
  triangles_->setValidator(new QIntValidator(4, 1000000000, triangles_));
  triangles_->setEnabled(kind_ == ModelKind::kMesh);
  auto* form = new QFormLayout(this);
  form->addRow(tr("Format"), format_);
  form->addRow(tr("Unit"), unit_);
  form->addRow(tr("Up"), up_);
  form->addRow(tr("Triangles, at most"), triangles_);
  form->addRow(tr("Colours"), colors_);
  form->addRow(note_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
  auto* go = buttons->addButton(tr("Export…"), QDialogButtonBox::AcceptRole);
  go->setObjectName("primary");
  form->addRow(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, &ExportDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  const QSettings settings;
  choose(*format_, settings.value("export/format", textured_ ? ".glb" : ".ply"));
  choose(*up_, settings.value("export/up", int(UpAxis::kFormat)));
  connect(format_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] {
    choose(*unit_, unit_of_format(ending().toStdString()));
    colors_->setCurrentIndex(0);  // the best that the format supports; follow() finds it
    follow();
  });
  connect(triangles_, &QLineEdit::textChanged, this, &ExportDialog::follow);
  choose(*unit_, unit_of_format(ending().toStdString()));
  if (const double unit = settings.value("export/unit" + ending()).toDouble(); unit > 0.0)
    choose(*unit_, unit);
  follow();
}

QString ExportDialog::ending() const { return format_->currentData().toString(); }

std::size_t ExportDialog::triangles() const {
  return kind_ == ModelKind::kMesh ? triangles_->text().toULongLong() : 0;
}

/// Disables what the format cannot store; the note gives the reason.
void ExportDialog::follow() {
  const std::string to = ending().toStdString();
  const bool free = units_are_free(to), glb = to == ".glb";
  const QSignalBlocker quiet_unit(unit_), quiet_up(up_), quiet_colors(colors_);
  if (!free) choose(*unit_, unit_of_format(to));
  unit_->setEnabled(free);
  if (glb) choose(*up_, int(UpAxis::kFormat));
  up_->setEnabled(!glb);
  const bool fewer = triangles() > 0 && triangles() < all_triangles_;
  const bool texture = textured_ && holds_textures("mesh" + to) && !fewer;
  const bool vertices = (textured_ || colored_) && to != ".stl";
  set_entry_enabled(*colors_, 0, texture);
  set_entry_enabled(*colors_, 1, vertices);
  const int now = colors_->currentIndex();
  if ((now == 0 && !texture) || (now == 1 && !vertices))
    colors_->setCurrentIndex(texture ? 0 : vertices ? 1 : 2);
  QStringList notes;
  if (!free) notes << tr("The format says its unit: %1.").arg(unit_->currentText().toLower());
  if (glb) notes << tr("GLB is always Y up.");
  if (textured_ && !texture)
    notes << (fewer ? tr("With fewer triangles the texture becomes colours of the vertices.")
                    : tr("This format keeps no texture."));
  if (to == ".stl" && (textured_ || colored_)) notes << tr("STL keeps no colours.");
  note_->setText(notes.join(" "));
}

ExportOptions ExportDialog::options() const {
  ExportOptions out;
  out.metres_per_unit = unit_->currentData().toDouble();
  out.up = UpAxis(up_->currentData().toInt());
  out.triangles = triangles();
  out.colors = ExportColors(colors_->currentData().toInt());
  return out;
}

void ExportDialog::accept() {
  QSettings settings;
  settings.setValue("export/format", ending());
  settings.setValue("export/up", int(options().up));
  settings.setValue("export/unit" + ending(), options().metres_per_unit);
  QDialog::accept();
}

}  // namespace turnscan::studio
