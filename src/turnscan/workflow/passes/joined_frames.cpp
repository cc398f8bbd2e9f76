#include <turnscan/workflow/passes/joined_frames.hpp>

#include <map>
#include <set>
#include <turnscan/turntable/rotation.hpp>

namespace turnscan {

std::vector<std::uint32_t> passes_of(const FrameSequence& sequence) {
  std::set<std::uint32_t> passes;
  for (const FrameInfo& frame : sequence.frames())
    if (frame.status == FrameStatus::kOk) passes.insert(frame.pass);
  return {passes.begin(), passes.end()};
}

Result<SequenceView> join_passes(const std::vector<SequencePass>& passes) {
  struct Source {
    std::vector<Pose> T_table_sensor;
    std::uint32_t first_sensor = 0;
  };
  std::map<const FrameSequence*, Source> sources;
  SequenceHeader header;
  for (const SequencePass& pass : passes) {
    if (sources.contains(pass.frames)) continue;
    const SequenceHeader& own = pass.frames->header();
    TURNSCAN_ASSIGN(FramePoses poses, frame_poses(own, pass.frames->frames(), pass.speed_rad_s));
    const auto first_sensor = std::uint32_t(header.sensors.size());
    if (sources.empty())
      header = own;
    else
      header.sensors.insert(header.sensors.end(), own.sensors.begin(), own.sensors.end());
    sources[pass.frames] = {std::move(poses.T_table_sensor), first_sensor};
  }
  SequenceView out(std::move(header));
  for (std::size_t k = 0; k < passes.size(); ++k) {
    const FrameSequence& sequence = *passes[k].frames;
    const Source& source = sources.at(&sequence);
    for (std::size_t i = 0; i < sequence.frames().size(); ++i) {
      FrameInfo info = sequence.frames()[i];
      if (info.pass != passes[k].pass) continue;
      info.pass = std::uint32_t(k);
      info.sensor += source.first_sensor;
      info.T_table_sensor = source.T_table_sensor[i];
      if (sources.size() > 1) info.index = std::uint32_t(out.frames().size());
      out.add(sequence, i, std::move(info));
    }
  }
  return out;
}

}  // namespace turnscan
