#pragma once
// Some frames of a sequence: which they are, and how they are read.

#include <optional>
#include <span>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/parallel.hpp>
#include <type_traits>
#include <utility>
#include <vector>

namespace turnscan {

/// What frames have in common; empty: anything.
struct FrameFilter {
  std::optional<std::uint32_t> sensor = {};
  std::optional<std::uint32_t> pass = {};
};

/// Positions of the frames that were not dropped, ascending.
std::vector<std::size_t> usable_frames(const FrameSequence& sequence,
                                       const FrameFilter& filter = {});

/// Reads the frames at these positions on all cores, and calls use(k, frame) with that at
/// positions[k], from several threads at once. use returns a Result<>. If it takes a Result<Frame>,
/// it decides about frames that cannot be read; if it takes a Frame, these are errors. Fails with
/// the error of the smallest k that has one, and with kCancelled.
template <class Use>
Result<> read_frames(const FrameSequence& sequence, std::span<const std::size_t> positions,
                     const RunContext& context, const Use& use) {
  return parallel_for(positions.size(), 1, context, [&](std::size_t k) -> Result<> {
    Result<Frame> frame = sequence.read(positions[k]);
    if constexpr (std::is_invocable_v<const Use&, std::size_t, Result<Frame>>) {
      return use(k, std::move(frame));
    } else {
      if (!frame) return tl::unexpected<Error>(std::move(frame).error());
      return use(k, std::move(*frame));
    }
  });
}

}  // namespace turnscan
