#pragma once

#include <cstddef>
#include <functional>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/result.hpp>

namespace turnscan {

/// Returns the frame at a position of a list. Called from several threads at once.
using FrameReader = std::function<Result<Frame>(std::size_t position)>;

}  // namespace turnscan
