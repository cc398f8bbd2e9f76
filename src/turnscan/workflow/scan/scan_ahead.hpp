#pragma once
// Calibrates and reconstructs a recording while it is still in progress.

#include <memory>
#include <string>
#include <turnscan/core/calibration.hpp>
#include <turnscan/reconstruction/pipeline.hpp>

namespace turnscan {

/// For a turntable of which nothing is known: its axis and the frames' angles are estimated from
/// the object's motion. When most of the recording exists, a thread calibrates from the frames so
/// far and begins to reconstruct them, reading them back from the recording. At the end the
/// calibration is extended to the last frames. If the closure error (one turn after the first
/// views, where frames show this) is small enough, the reconstruction is finished with the last
/// frames; if not, nothing is kept and the caller restarts with all frames.
/// The outcome is a deterministic function of the recording and of the number of frames it began
/// with.
class ScanAhead {
 public:
  /// recording: the folder being written, of one sensor. Begins once this share of it, in (0, 1),
  /// exists.
  ScanAhead(std::string recording, const ReconstructOptions& options, double share,
            const RunContext& context);
  ~ScanAhead();  ///< cancels unfinished work
  ScanAhead(const ScanAhead&) = delete;
  ScanAhead& operator=(const ScanAhead&) = delete;

  /// Call for each recorded frame, in order, from the recording thread.
  void frame_came();
  /// Sets the share of the recording, in [0, 1], that exists after that frame.
  void progress(double fraction);

  struct Outcome {
    std::size_t frames_ahead = 0;  ///< with which the calibration began; 0: it never began
    bool kept = false;             ///< calibration and reconstruction cover the whole scan
    double closure_m = 0.0;        ///< see measure_closure(); 0 if it was not measured
    double closure_limit_m = 0.0;  ///< nothing is kept above it
    std::string note;              ///< one sentence for the user
    Calibration calibration;
    Reconstruction reconstruction;
  };
  /// Call when the recording is complete. Fails with kCancelled, and as reconstruct() does; a
  /// calibration that is not good enough is an outcome, not an error.
  Result<Outcome> finish(const RunContext& context);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace turnscan
