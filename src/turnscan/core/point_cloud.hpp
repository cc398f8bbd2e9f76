#pragma once

#include <cstdint>
#include <turnscan/core/image.hpp>
#include <turnscan/core/pose.hpp>
#include <vector>

namespace turnscan {

/// Points in metres. Every attribute is either empty or as long as points.
struct PointCloud {
  std::vector<Vec3f> points;
  std::vector<Vec3f> normals;  ///< unit length
  std::vector<Rgb> colors;
  std::vector<float> weights;        ///< e.g. how many measurements a candidate stands for
  std::vector<std::uint32_t> frame;  ///< position (not index) of the frame a point comes from

  std::size_t size() const { return points.size(); }
  bool empty() const { return points.empty(); }
};

}  // namespace turnscan
