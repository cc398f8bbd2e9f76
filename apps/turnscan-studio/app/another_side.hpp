#pragma once
// What is missing of an object after a pass, as one mode tells it to another.

#include <QString>
#include <optional>
#include <turnscan/core/pose.hpp>

namespace turnscan::studio {

/// How a source that can lay its object itself is to do it; see FrameSource::lay_object().
struct ObjectTurn {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  double time_s = 0.0;
};

struct AnotherSide {
  QString recording;  ///< folder, to which the next pass is added
  QString advice;     ///< what is missing, and how to lay the object
  std::optional<ObjectTurn> turn;
};

}  // namespace turnscan::studio
