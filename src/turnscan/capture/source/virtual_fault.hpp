#pragma once
// Device faults that a virtual device can simulate.

#include <string_view>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan::source {

struct VirtualFault {
  enum class Kind {
    kMissing,    ///< on opening: kNotFound
    kBusy,       ///< on opening: kDeviceBusy
    kDenied,     ///< on opening: kNoPermission
    kLost,       ///< kDeviceLost from then on
    kStall,      ///< no frames for `length_s`
    kSize,       ///< one frame of a different size
    kBackwards,  ///< one frame with a time before that of its predecessor
    kGap         ///< one frame lost
  };
  Kind kind = Kind::kLost;
  double begin_s = 0.0;   ///< sensor time since the first frame
  double length_s = 0.0;  ///< kStall, kSize, kBackwards, kGap: 0 means one frame
};

/// Parses "busy", or a list such as "gap@1s,stall@2s+5s,lost@3s". Fails with kInvalidOption.
Result<std::vector<VirtualFault>> parse_virtual_faults(std::string_view text);

}  // namespace turnscan::source
