#pragma once

#include <QWidget>
#include <memory>
#include <set>
#include <turnscan/core/frame.hpp>

class QLabel;

namespace turnscan::studio {

class FrameSlider;
class JobRunner;
class PictureBox;

/// The frames of a recording, one at a time: depth and colour as pictures, number, time, angle.
class FramePanel : public QWidget {
  Q_OBJECT
 public:
  explicit FramePanel(QWidget* parent = nullptr);
  ~FramePanel() override;

  /// nullptr: nothing is shown. left_out: positions of frames that a run did not use; those that
  /// were lost while it was recorded are known anyway. Begins with the first of a pass.
  void show_recording(const std::shared_ptr<const FrameSequence>& recording,
                      const std::set<std::size_t>& left_out, std::uint32_t pass = 0);
  /// Position of the frame whose pictures are shown; -1: there are none yet.
  int pictured() const { return pictured_; }

 private:
  void show_frame();
  void decode();
  QString text_of(std::size_t position) const;

  std::shared_ptr<const FrameSequence> recording_;
  std::set<std::size_t> left_out_;
  std::uint32_t pass_ = 0;
  JobRunner* decoder_;  ///< of its own, so that a long job does not keep pictures back
  bool again_ = false;  ///< another frame is wanted by now
  int pictured_ = -1;
  PictureBox *depth_, *color_;
  FrameSlider* slider_;
  QLabel *text_, *range_;
};

}  // namespace turnscan::studio
