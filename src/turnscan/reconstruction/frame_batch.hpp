#pragma once
// Frames that are worked on together, each on one core.

#include <span>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/frame_reader.hpp>
#include <utility>
#include <vector>

namespace turnscan {

/// A frame that is to be worked on, and its place.
struct PosedFrame {
  std::size_t position = 0;  ///< for the FrameReader
  FrameInfo info;
  Pose T_table_sensor;
};

/// Of the depth cameras; empty tables for the other sensors.
std::vector<RayTable> ray_tables(const SequenceHeader& header);

/// What work(frame, posed frame) gives for each of the frames, in their order. work is called from
/// several threads at once. Fails with the first frame's error that read or work returns, and with
/// kCancelled.
template <class Part, class Work>
Result<std::vector<Part>> process_frames(std::span<const PosedFrame> frames,
                                         const FrameReader& read, const RunContext& context,
                                         const Work& work) {
  std::vector<Result<Part>> results(frames.size());
  parallel_for(frames.size(), 1, [&](std::size_t i) {
    if (context.cancelled()) return;
    results[i] = read(frames[i].position).and_then([&](const Frame& frame) {
      return work(frame, frames[i]);
    });
    context.advance();
  });
  TURNSCAN_TRY(context.check());
  std::vector<Part> parts;
  parts.reserve(results.size());
  for (Result<Part>& result : results) {
    if (!result) return tl::unexpected<Error>(std::move(result).error());
    parts.push_back(std::move(*result));
  }
  return parts;
}

}  // namespace turnscan
