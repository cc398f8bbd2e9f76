#pragma once
// Things that go wrong with devices, to be rehearsed with a virtual one.

#include <string_view>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan::source {

struct VirtualFault {
  enum class Kind {
    kMissing,    ///< at opening: kNotFound
    kBusy,       ///< at opening: kDeviceBusy
    kDenied,     ///< at opening: kNoPermission
    kLost,       ///< kDeviceLost from then on
    kStall,      ///< nothing for as long as `length_s`
    kSize,       ///< one frame of another size
    kBackwards,  ///< one frame with a time before that of the frame before it
    kGap         ///< one frame lost
  };
  Kind kind = Kind::kLost;
  double begin_s = 0.0;   ///< sensor's time since the first frame
  double length_s = 0.0;  ///< kStall, kSize, kBackwards, kGap: 0 is one frame
};

/// "busy", or a list such as "gap@1s,stall@2s+5s,lost@3s". Fails with kInvalidOption.
Result<std::vector<VirtualFault>> parse_virtual_faults(std::string_view text);

}  // namespace turnscan::source
