#pragma once
// Incremental reconstruction of frames from a device, a recording or the simulator. Each frame is
// processed as far as possible when it arrives; only the surface is left for the end. reconstruct()
// makes the same three calls: the result is byte-identical, however the frames are grouped.

#include <memory>
#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/frame_reader.hpp>
#include <turnscan/reconstruction/options.hpp>
#include <turnscan/reconstruction/pass_placement.hpp>
#include <turnscan/reconstruction/result.hpp>

namespace turnscan {

/// One thread adds and finishes; others may request previews meanwhile.
class ReconstructionStream {
 public:
  /// Sensors and turntable must be known; the header is copied. passes: those to be fused, indexed
  /// by FrameInfo::pass; empty: there is one. Their frames come pass after pass, and have poses of
  /// their own (FrameInfo::T_table_sensor) if the table is not the header's. Fails with
  /// kInvalidOption as reconstruct() does.
  static Result<ReconstructionStream> create(const SequenceHeader& header,
                                             const ReconstructOptions& options,
                                             std::vector<PassPlacement> passes = {});
  ReconstructionStream(ReconstructionStream&&) noexcept;
  ReconstructionStream& operator=(ReconstructionStream&&) noexcept;
  ~ReconstructionStream();

  /// Adds frames in the order in which they were taken, using all cores. Frames whose status is
  /// kDropped are only counted. The scale (crop, noise, voxels) is estimated from the first frames,
  /// about 32, which are held in memory until then. A frame that fails is not added, nor are those
  /// after it in the call: kMissingData if its pose on the table is not known, kFormat if it does
  /// not match its sensor, kCancelled, and the errors of `read`.
  Result<> add(const std::vector<FrameInfo>& infos, const FrameReader& read,
               const RunContext& context);
  Result<> add(const std::vector<Frame>& frames, const RunContext& context = RunContext());
  /// Reads and adds the frames of a sequence from position `first` on.
  Result<> add(const FrameSequence& sequence, std::size_t first, const RunContext& context);

  /// A coarse closed mesh of what was added so far, in the table's or the object's frame, in
  /// bounded time (some 1,500 bricks of samples for any scan) and without waiting for more than the
  /// 16 frames that are being summed. May be called from any thread while another one adds; not
  /// while it finishes. Returns an empty mesh until the scale is known. Volumetric method only:
  /// kInvalidOption with others; kCancelled.
  Result<TriangleMesh> preview(const RunContext& context = RunContext()) const;

  /// The meshes of what was added. May be called once; afterwards the stream is empty. Fails as
  /// reconstruct() does.
  Result<Reconstruction> finish(const StageSink& sink, const RunContext& context);

 private:
  class Impl;
  explicit ReconstructionStream(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace turnscan
