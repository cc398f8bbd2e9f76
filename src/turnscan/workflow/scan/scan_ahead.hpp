#pragma once
// Calibrates and reconstructs a recording while it is being made.

#include <memory>
#include <string>
#include <turnscan/core/calibration.hpp>
#include <turnscan/reconstruction/pipeline.hpp>

namespace turnscan {

/// For a turntable of which nothing is known: its place and the frames' angles come from the
/// object's motion. When most of the recording is there, a thread calibrates from the frames so far
/// and begins to reconstruct them, read back from the recording. At the end the calibration is
/// continued to the last frames. If the object then lies, one turn after its first views, where
/// these show it (closure), the reconstruction is finished with the last frames; if not, nothing is
/// kept and the caller begins anew with all frames.
/// The outcome is a function of the recording and of the number of frames it began with.
class ScanAhead {
 public:
  /// recording: the folder that is being written, of one sensor. Begins when this share of it,
  /// in (0, 1), is there.
  ScanAhead(std::string recording, const ReconstructOptions& options, double share);
  ~ScanAhead();  ///< cancels what is not finished
  ScanAhead(const ScanAhead&) = delete;
  ScanAhead& operator=(const ScanAhead&) = delete;

  /// To be called for each frame that is recorded, in order, from the thread that records.
  void frame_came();
  /// How much of the recording, in [0, 1], is there after that frame.
  void progress(double fraction);

  struct Outcome {
    std::size_t frames_ahead = 0;  ///< that the calibration began with; 0: it never began
    bool kept = false;             ///< calibration and reconstruction are those of the whole scan
    double closure_m = 0.0;        ///< see measure_closure(); 0 where it did not come to that
    double closure_limit_m = 0.0;  ///< above which nothing is kept
    std::string note;              ///< one sentence for people
    Calibration calibration;
    Reconstruction reconstruction;
  };
  /// The recording is complete. Fails with kCancelled, and as reconstruct() does; that the
  /// calibration is not good is an outcome.
  Result<Outcome> finish(const RunContext& context);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace turnscan
