#pragma once
// A frame of a recording as pictures. Runs on a worker thread.

#include <QImage>
#include <turnscan/core/frame.hpp>

namespace turnscan::studio {

struct FramePicture {
  QImage depth;  ///< the nearest is yellow, the farthest violet, what was not measured transparent
  QImage color;  ///< null: the frame has none
  double near_m = 0.0, far_m = 0.0;  ///< depths of the first and the last colour
};

/// Both are at most `width_px` wide. The depth picture is null if the frame has points that lie in
/// no grid. Fails as FrameSequence::read() does.
Result<FramePicture> frame_picture(const FrameSequence& sequence, std::size_t position,
                                   int width_px);

/// How far the platter has turned since the first frame; nullopt: not known.
std::optional<double> angle_of_frame(const FrameSequence& sequence, std::size_t position);

}  // namespace turnscan::studio
