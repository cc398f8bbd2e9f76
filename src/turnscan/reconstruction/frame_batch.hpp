#pragma once
// Processes batches of frames in parallel, one frame per core.

#include <span>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/frame_reader.hpp>
#include <utility>
#include <vector>

namespace turnscan {

/// A frame to be processed, and its pose.
struct PosedFrame {
  std::size_t position = 0;  ///< for the FrameReader
  FrameInfo info;
  Pose T_table_sensor;
};

/// Ray tables of the depth cameras; empty tables for the other sensors.
std::vector<RayTable> ray_tables(const SequenceHeader& header);

/// The results of work(frame, posed frame) for each of the frames, in their order. work is called
/// from several threads at once. Fails with the error of the first frame for which read or work
/// fails, and with kCancelled.
template <class Part, class Work>
Result<std::vector<Part>> process_frames(std::span<const PosedFrame> frames,
                                         const FrameReader& read, const RunContext& context,
                                         const Work& work) {
  std::vector<Part> parts(frames.size());
  TURNSCAN_TRY(parallel_for(frames.size(), 1, context, [&](std::size_t i) -> Result<> {
    TURNSCAN_ASSIGN(const Frame frame, read(frames[i].position));
    TURNSCAN_ASSIGN(parts[i], work(frame, frames[i]));
    context.advance();
    return {};
  }));
  return parts;
}

}  // namespace turnscan
