#pragma once
// Reconstruction of frames as they come: from a device, a recording or the simulator. What can be
// done with a frame is done when it arrives; only the surface is left for the end. reconstruct()
// is the same three calls: the result has the same bytes, however the frames were handed over.

#include <memory>
#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/frame_reader.hpp>
#include <turnscan/reconstruction/options.hpp>
#include <turnscan/reconstruction/pass_placement.hpp>
#include <turnscan/reconstruction/result.hpp>

namespace turnscan {

/// One thread adds and finishes; others may ask for previews meanwhile.
class ReconstructionStream {
 public:
  /// Sensors and turntable must be known; the header is copied. passes: of several that are fused,
  /// by FrameInfo::pass; empty: there is one. Their frames come pass after pass, and have poses of
  /// their own (FrameInfo::T_table_sensor) where the table is not the header's. Fails with
  /// kInvalidOption as reconstruct() does.
  static Result<ReconstructionStream> create(const SequenceHeader& header,
                                             const ReconstructOptions& options,
                                             std::vector<PassPlacement> passes = {});
  ReconstructionStream(ReconstructionStream&&) noexcept;
  ReconstructionStream& operator=(ReconstructionStream&&) noexcept;
  ~ReconstructionStream();

  /// Adds frames in the order in which they were taken, working on all cores. Frames whose status
  /// is kDropped only count. The scale (crop, noise, voxels) is found from the first frames, about
  /// 32, which wait in memory until then. A frame that fails is not added, and those after it in
  /// the call are not either: kMissingData when its place on the table is not known, kFormat when
  /// it does not fit its sensor, kCancelled, and what `read` fails with.
  Result<> add(const std::vector<FrameInfo>& infos, const FrameReader& read,
               const RunContext& context);
  Result<> add(const std::vector<Frame>& frames, const RunContext& context = RunContext());

  /// A rough closed mesh of what was added so far, in the table's or the object's frame, in bounded
  /// time (some 1,500 bricks of samples whatever the scan) and without waiting for more than the 16
  /// frames that are being summed. From any thread, while another one adds; not while it finishes.
  /// An empty mesh until the scale is known. Volumetric method only: kInvalidOption with others;
  /// kCancelled.
  Result<TriangleMesh> preview(const RunContext& context = RunContext()) const;

  /// The meshes of what was added. Once; afterwards the stream is empty. Fails as reconstruct().
  Result<Reconstruction> finish(const StageSink& sink, const RunContext& context);

 private:
  class Impl;
  explicit ReconstructionStream(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace turnscan
