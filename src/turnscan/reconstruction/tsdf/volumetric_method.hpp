#pragma once
// The volumetric method: signed distances of all frames in one truncated field, with what each ray
// passed through.

#include <turnscan/reconstruction/method.hpp>

namespace turnscan::tsdf {

MethodEntry volumetric_method();

}  // namespace turnscan::tsdf
