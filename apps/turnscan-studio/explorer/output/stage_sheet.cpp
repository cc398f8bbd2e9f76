#include "explorer/output/stage_sheet.hpp"

#include <QAbstractButton>
#include <QDialogButtonBox>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QVBoxLayout>
#include <turnscan/simulator/rendering/picture.hpp>
#include <turnscan/workflow/cloud_cubes.hpp>

#include "app/paths.hpp"
#include "explorer/editing/edits.hpp"

namespace turnscan::studio {

namespace {

constexpr int kWidth = 420, kHeight = 520, kCaption = 72;  // pixels of a model
constexpr std::size_t kMostPoints = 200000;

Result<TriangleMesh> shown_of(const ShownStage& stage, const RunContext& context) {
  const ModelData& data = *stage.model.data;
  if (data.kind == ModelKind::kMesh) return data.mesh;
  // Cells have counts; of other points a part shows the same.
  const std::size_t step = data.cloud.weights.empty() ? data.cloud.size() / kMostPoints + 1 : 1;
  if (step == 1) return cubes_of(data.cloud, stage.least, context);
  return cubes_of(points_where(data.cloud, [&](std::size_t i) { return i % step == 0; }), 0.0,
                  context);
}

QImage captioned(const ColorImage& picture, const Model& model) {
  QImage out(picture.width, picture.height + kCaption, QImage::Format_RGB888);
  out.fill(Qt::white);
  QPainter painter(&out);
  painter.drawImage(0, 0,
                    QImage(&picture.pixels.front().r, picture.width, picture.height,
                           3 * picture.width, QImage::Format_RGB888));
  painter.setPen(Qt::black);
  QFont font = painter.font();
  font.setPixelSize(20);  // legible in a sheet that is scaled down to the screen
  painter.setFont(font);
  const QRect below(8, picture.height, picture.width - 16, kCaption);
  const QString name = painter.fontMetrics().elidedText(model.name, Qt::ElideMiddle, below.width());
  painter.drawText(below, Qt::AlignHCenter | Qt::AlignTop, name + "\n" + count_text(*model.data));
  return out;
}

}  // namespace

Result<QImage> stage_sheet(const std::vector<ShownStage>& stages, const RunContext& context) {
  std::vector<QImage> pictures;
  for (const ShownStage& stage : stages) {
    const Model& model = stage.model;
    if (model.data->kind == ModelKind::kRecording) continue;
    TURNSCAN_ASSIGN(const TriangleMesh mesh, shown_of(stage, context));
    PictureOptions options;
    options.width = kWidth;
    options.height = kHeight;
    options.use_colors = model.own_colors;
    options.surface = {std::uint8_t(model.color.red()), std::uint8_t(model.color.green()),
                       std::uint8_t(model.color.blue())};
    TURNSCAN_ASSIGN(const ColorImage picture,
                    render_picture(std::span(&mesh, 1), options, context));
    pictures.push_back(captioned(picture, model));
  }
  if (pictures.empty())
    return fail(ErrorCode::kTooFewPoints,
                "no mesh or cloud is shown; check those in the list that the sheet is to have");
  QImage sheet(kWidth * int(pictures.size()), kHeight + kCaption, QImage::Format_RGB888);
  QPainter painter(&sheet);
  for (std::size_t i = 0; i < pictures.size(); ++i)
    painter.drawImage(kWidth * int(i), 0, pictures[i]);
  return sheet;
}

SheetDialog::SheetDialog(const QImage& sheet, QWidget* parent) : QDialog(parent), sheet_(sheet) {
  setObjectName("stage_sheet");
  setWindowTitle(tr("Stages"));
  setAttribute(Qt::WA_DeleteOnClose);
  auto* layout = new QVBoxLayout(this);
  auto* picture = new QLabel(this);
  const int widest = std::min(sheet.width(), parent->window()->width() - 80);
  picture->setPixmap(QPixmap::fromImage(sheet.scaledToWidth(widest, Qt::SmoothTransformation)));
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Save | QDialogButtonBox::Close, this);
  for (QAbstractButton* each : buttons->buttons()) each->setIcon({});
  layout->addWidget(picture);
  layout->addWidget(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, [this] {
    const QString path =
        ask_save_path(this, tr("Save the stages"), "stages.png", tr("PNG (*.png)"));
    if (!path.isEmpty()) save_as(path);
  });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
}

void SheetDialog::save_as(const QString& path) {
  if (sheet_.save(path, "PNG")) return Q_EMIT saved(path);
  Q_EMIT failed(tr("%1 cannot be written; check the folder and its permissions").arg(path));
}

}  // namespace turnscan::studio
