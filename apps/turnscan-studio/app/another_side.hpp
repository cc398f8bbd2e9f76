#pragma once
// Request for another pass of an object, passed from one mode to another.

#include <QString>
#include <optional>
#include <turnscan/core/pose.hpp>

namespace turnscan::studio {

/// How a source that can reposition its object has to do so; see FrameSource::lay_object().
struct ObjectTurn {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  double time_s = 0.0;
};

struct AnotherSide {
  QString recording;  ///< folder to which the next pass is added
  QString advice;     ///< what is missing, and how to place the object
  std::optional<ObjectTurn> turn;
};

}  // namespace turnscan::studio
