#pragma once
// Reconstruction of frames as they arrive: from a device, or from any program that has them one by
// one.

#include <memory>
#include <span>
#include <turnscan/api/options.hpp>
#include <turnscan/api/reconstruct.hpp>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

/// Each frame is integrated when it is added; only the surface extraction remains for the end. One
/// thread adds frames and finishes; other threads may call preview() meanwhile.
class Stream {
 public:
  /// header: the sensors, and the turntable (without one, every frame must have a pose of its own).
  /// The options are those of reconstruct(), without `calibration`, `turntable` and `allow-open`.
  /// Fails with kInvalidOption.
  static Result<Stream> create(const SequenceHeader& header, const Options& options = {});
  Stream(Stream&&) noexcept;
  Stream& operator=(Stream&&) noexcept;
  ~Stream();

  /// Adds frames in the order in which they were taken. Each needs its pose (T_table_sensor), its
  /// angle, or a time together with the turntable's speed. The first 32 frames or so are held back
  /// until they have shown the scale of the scan. A frame that fails is not added, nor are those
  /// after it in the same call.
  /// Fails with kMissingData (the position of the platter at that frame is not known), kFormat (the
  /// frame does not match its sensor) and kCancelled.
  Result<> add(const Frame& frame, const RunContext& context = {});
  Result<> add(std::span<const Frame> frames, const RunContext& context = {});

  /// A coarse closed mesh of the frames so far (metres, table frame), in bounded time; empty until
  /// the scale is known. Fails with kInvalidOption unless the method is volumetric, the default,
  /// and with kCancelled.
  Result<TriangleMesh> preview(const RunContext& context = {}) const;

  /// The meshes of all frames. May be called once; afterwards the stream is empty. Fails as
  /// reconstruct() does.
  Result<ReconstructedScan> finish(const RunContext& context = {});

 private:
  struct Impl;
  explicit Stream(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace turnscan
