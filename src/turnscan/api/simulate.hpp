#pragma once
// Virtual scans of known objects: what `turnscan simulate` does.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <turnscan/api/options.hpp>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/evaluation/evaluation.hpp>
#include <vector>

namespace turnscan {

/// A scan by virtual sensors, with the truth that no real scan has. Copies share it.
class SimulatedScan {
 public:
  /// The frames, each rendered when it is read: the same bytes every time, and on any thread.
  const FrameSequence& frames() const;

  /// Number of passes with an object; 0 for the empty turntable.
  std::size_t passes() const;
  /// The object as it stands on the turntable in a pass (metres, table frame, angle 0). Throws
  /// std::out_of_range for pass >= passes().
  const TriangleMesh& truth(std::size_t pass = 0) const;

  /// Writes the frames as a recording, and the truth into its folder `truth`. The folder must not
  /// exist or be empty; if writing fails, nothing of it remains. Fails with kAlreadyExists, kIo and
  /// kCancelled.
  Result<> record(const std::filesystem::path& folder, const RunContext& context = {}) const;

  /// Compares a mesh (metres, table frame) with the truth of the first pass, as evaluate() does;
  /// completeness counts only what the frames saw. Fails as evaluate() does, with kTooFewPoints
  /// for the empty turntable, and with kMissingData where the option `calibration` is false: the
  /// frames then do not tell where their sensor stood.
  Result<Evaluation> evaluate(const TriangleMesh& mesh, const Options& options = {},
                              const RunContext& context = {}) const;

  struct Impl;
  explicit SimulatedScan(std::shared_ptr<const Impl> impl);

 private:
  std::shared_ptr<const Impl> impl_;
};

/// object: a mesh file, "builtin:NAME" (doll, cylinder, letter-a, ball, ...), or "builtin:empty"
/// for the turntable alone; empty where the option `scene` names a file that says it.
///
/// The options are those of `turnscan simulate`. `scanner` (a preset such as "kinect-v2", or a
/// file) and `next-pass` are repeatable. A `scene` file is read before the other options are set.
///
/// Fails with kNotFound, kInvalidOption, kFormat (the mesh file), kResourceLimit and kCancelled.
Result<SimulatedScan> simulate(const std::string& object, const Options& options = {},
                               const RunContext& context = {});

/// The options of simulate().
std::vector<OptionDescription> simulate_options();

}  // namespace turnscan
