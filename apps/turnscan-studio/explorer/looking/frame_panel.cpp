#include "explorer/looking/frame_panel.hpp"

#include <QLabel>
#include <QPainter>
#include <QSignalBlocker>
#include <QSlider>
#include <QVBoxLayout>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <utility>

#include "app/jobs.hpp"
#include "explorer/looking/frame_picture.hpp"
#include "widgets/no_wheel.hpp"
#include "widgets/section.hpp"
#include "widgets/text.hpp"

namespace turnscan::studio {

/// A slider with a mark below each frame that is left out.
class FrameSlider : public QSlider {
 public:
  explicit FrameSlider(QWidget* parent) : QSlider(Qt::Horizontal, parent) { setMinimumHeight(26); }
  void mark(const std::set<std::size_t>& frames) {
    marked_ = frames;
    update();
  }

 protected:
  void paintEvent(QPaintEvent* event) override {
    QSlider::paintEvent(event);
    QPainter painter(this);
    const QColor orange(0xd55e00);  // visible in both themes
    constexpr double kHandle = 14.0;
    const double step = (width() - kHandle) / std::max(1, maximum());
    for (const std::size_t frame : marked_)
      painter.fillRect(QRectF(kHandle / 2 + step * double(frame) - 1, height() - 5, 2, 5), orange);
  }

 private:
  std::set<std::size_t> marked_;
};

/// A picture as wide as the panel.
class PictureBox : public QWidget {
 public:
  explicit PictureBox(QWidget* parent) : QWidget(parent) { setVisible(false); }
  /// A null picture leaves the room as it is, so that what is below does not jump.
  void show_picture(const QImage& picture) {
    picture_ = picture;
    if (!picture.isNull()) share_ = double(picture.height()) / picture.width();
    fit();
    setVisible(share_ > 0.0);
    update();
  }
  void forget() {
    share_ = 0.0;
    show_picture({});
  }

 protected:
  void resizeEvent(QResizeEvent* /*event*/) override { fit(); }
  void paintEvent(QPaintEvent* /*event*/) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.fillRect(rect(), palette().brush(QPalette::AlternateBase));
    if (!picture_.isNull()) painter.drawImage(rect(), picture_);
  }

 private:
  void fit() { setFixedHeight(int(std::lround(share_ * width()))); }

  QImage picture_;
  double share_ = 0.0;  ///< height to width
};

FramePanel::FramePanel(QWidget* parent)
    : QWidget(parent),
      decoder_(new JobRunner(this)),
      depth_(new PictureBox(this)),
      color_(new PictureBox(this)),
      slider_(new FrameSlider(this)),
      text_(quiet_label({}, this)),
      range_(quiet_label({}, this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  slider_->setObjectName("frame");
  slider_->setAccessibleName(tr("Frame of the recording"));
  slider_->setToolTip(tr("Arrow keys step from frame to frame; frames left out are marked"));
  leave_wheel_to_panel(slider_);
  text_->setObjectName("frame_text");
  depth_->setObjectName("frame_depth");
  depth_->setAccessibleName(tr("Depth image"));
  color_->setObjectName("frame_color");
  color_->setAccessibleName(tr("Colour image"));
  for (QWidget* part : std::initializer_list<QWidget*>{slider_, text_, depth_, range_, color_})
    layout->addWidget(part);
  connect(slider_, &QSlider::valueChanged, this, &FramePanel::show_frame);
  connect(decoder_, &JobRunner::finished, this, [this] {
    if (std::exchange(again_, false)) decode();
  });
}

FramePanel::~FramePanel() { delete decoder_; }

void FramePanel::show_recording(const std::shared_ptr<const FrameSequence>& recording,
                                const std::set<std::size_t>& left_out, std::uint32_t pass) {
  left_out_ = left_out;
  if (!recording || recording->frames().empty()) {
    recording_ = nullptr;
    return;
  }
  const std::vector<FrameInfo>& frames = recording->frames();
  std::set<std::size_t> marked = left_out;
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (frames[i].status == FrameStatus::kDropped) marked.insert(i);
  slider_->mark(marked);
  if (recording == recording_ && pass == pass_) return show_frame();
  pass_ = pass;
  if (std::exchange(recording_, recording) != recording)
    for (PictureBox* each : {depth_, color_}) each->forget();
  pictured_ = -1;
  const QSignalBlocker quiet(slider_);
  slider_->setRange(0, int(frames.size()) - 1);
  const auto first = std::find_if(frames.begin(), frames.end(),
                                  [&](const FrameInfo& info) { return info.pass == pass; });
  slider_->setValue(first == frames.end() ? 0 : int(first - frames.begin()));
  show_frame();
}

void FramePanel::show_frame() {
  if (!recording_) return;
  text_->setText(text_of(std::size_t(slider_->value())));
  text_->setToolTip(
      QString::fromStdString(recording_->frames()[std::size_t(slider_->value())].file));
  if (slider_->value() != pictured_) decode();
}

QString FramePanel::text_of(std::size_t position) const {
  const FrameInfo& info = recording_->frames()[position];
  QStringList parts{tr("Frame %1 of %2").arg(position + 1).arg(recording_->frames().size())};
  if (!std::isnan(info.time_s)) parts << QString("%1 s").arg(info.time_s, 0, 'f', 3);
  if (const auto angle = angle_of_frame(*recording_, position))
    parts << QString("%1°").arg(*angle / kRadiansPerDegree, 0, 'f', 1);
  if (recording_->header().sensors.size() > 1) parts << tr("sensor %1").arg(info.sensor);
  if (recording_->frames().back().pass != recording_->frames().front().pass)
    parts << tr("pass %1").arg(info.pass);
  if (info.status == FrameStatus::kDropped) {
    parts << tr("lost while it was recorded");
  } else if (left_out_.count(position) > 0) {
    parts << tr("left out of the mesh, because its pose is not known");
  }
  return parts.join(" · ");
}

/// The latest wanted frame: those that the slider passes while one is read are left out.
void FramePanel::decode() {
  again_ = decoder_->busy();
  if (again_ || !recording_) return;
  const int position = slider_->value();
  if (recording_->frames()[std::size_t(position)].status == FrameStatus::kDropped) {
    for (PictureBox* each : {depth_, color_}) each->show_picture({});
    range_->clear();
    pictured_ = position;
    return;
  }
  const int width_px = int(width() * devicePixelRatioF());
  decoder_->start(
      tr("Frame"), this,
      [this, position, width_px, from = recording_](const RunContext&) -> Result<Finish> {
        TURNSCAN_ASSIGN(const FramePicture made,
                        frame_picture(*from, std::size_t(position), width_px));
        return Finish([this, from, position, made] {
          if (from != recording_) return;
          depth_->show_picture(made.depth);
          color_->show_picture(made.color);
          range_->setText(made.far_m > 0.0 ? tr("Yellow is %1 m from the sensor, violet %2 m")
                                                 .arg(made.near_m, 0, 'f', 3)
                                                 .arg(made.far_m, 0, 'f', 3)
                                           : QString());
          pictured_ = position;
        });
      },
      [this](const QString& text) {
        for (PictureBox* each : {depth_, color_}) each->show_picture({});
        range_->setText(text);
      });
}

}  // namespace turnscan::studio
