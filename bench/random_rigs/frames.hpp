#pragma once
// The frames of a simulated bench, rendered once.

#include <turnscan/core/parallel.hpp>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/simulator/virtual_scan.hpp>

#include "tests/support/memory_sequence.hpp"

namespace turnscan::rigs {

inline testing::MemorySequence rendered(const FrameSequence& scan) {
  testing::MemorySequence out;
  out.header_value = scan.header();
  out.infos = scan.frames();
  out.data.resize(out.infos.size());
  parallel_for(out.data.size(), 1, [&](std::size_t i) { out.data[i] = *scan.read(i); });
  return out;
}

/// frames must outlive the view.
inline SequenceView at_true_poses(const FrameSequence& frames, const VirtualScan& truth) {
  auto infos = frames.frames();
  for (std::size_t i = 0; i < infos.size(); ++i) infos[i].T_table_sensor = truth.T_table_sensor(i);
  SequenceHeader header = frames.header();
  header.turntable = truth.turntable();
  SequenceView out(frames);
  out.set_header(std::move(header));
  out.set_frames(std::move(infos));
  return out;
}

}  // namespace turnscan::rigs
