#include <turnscan/workflow/passes/joined_frames.hpp>

#include <algorithm>
#include <set>
#include <turnscan/turntable/rotation.hpp>

namespace turnscan {

std::vector<std::uint32_t> passes_of(const FrameSequence& sequence) {
  std::set<std::uint32_t> passes;
  for (const FrameInfo& frame : sequence.frames())
    if (frame.status == FrameStatus::kOk) passes.insert(frame.pass);
  return {passes.begin(), passes.end()};
}

Result<JoinedFrames> JoinedFrames::create(const std::vector<SequencePass>& passes) {
  JoinedFrames out;
  for (const SequencePass& pass : passes) TURNSCAN_TRY(out.add_sequence(pass));
  for (std::size_t k = 0; k < passes.size(); ++k) out.add_pass(passes[k], std::uint32_t(k));
  return out;
}

Result<> JoinedFrames::add_sequence(const SequencePass& pass) {
  const FrameSequence& sequence = *pass.frames;
  if (std::any_of(sequences_.begin(), sequences_.end(),
                  [&](const Sequence& s) { return s.frames == &sequence; }))
    return {};
  TURNSCAN_ASSIGN(FramePoses poses,
                  frame_poses(sequence.header(), sequence.frames(), pass.speed_rad_s));
  sequences_.push_back(
      {&sequence, std::move(poses.T_table_sensor), std::uint32_t(header_.sensors.size())});
  const SequenceHeader& header = sequence.header();
  if (sequences_.size() == 1)
    header_ = header;
  else
    header_.sensors.insert(header_.sensors.end(), header.sensors.begin(), header.sensors.end());
  return {};
}

void JoinedFrames::add_pass(const SequencePass& pass, std::uint32_t number) {
  const auto sequence = std::find_if(sequences_.begin(), sequences_.end(),
                                     [&](const Sequence& s) { return s.frames == pass.frames; });
  for (std::size_t i = 0; i < pass.frames->frames().size(); ++i) {
    FrameInfo info = pass.frames->frames()[i];
    if (info.pass != pass.pass) continue;
    info.pass = number;
    info.sensor += sequence->first_sensor;
    info.T_table_sensor = sequence->T_table_sensor[i];
    if (sequences_.size() > 1) info.index = std::uint32_t(infos_.size());
    infos_.push_back(std::move(info));
    sources_.push_back({pass.frames, i});
  }
}

Result<Frame> JoinedFrames::read(std::size_t position) const {
  const Source& source = sources_.at(position);
  TURNSCAN_ASSIGN(Frame frame, source.frames->read(source.position));
  frame.info = infos_[position];
  return frame;
}

}  // namespace turnscan
