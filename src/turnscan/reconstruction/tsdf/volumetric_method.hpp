#pragma once
// The volumetric method: signed distances of all frames in one truncated field, with the free space
// along each ray.

#include <turnscan/reconstruction/method.hpp>

namespace turnscan::tsdf {

MethodEntry volumetric_method();

}  // namespace turnscan::tsdf
