#pragma once
// From frames to watertight meshes: what `turnscan reconstruct` does.

#include <memory>
#include <string>
#include <turnscan/api/options.hpp>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/io/file/up_axis.hpp>
#include <turnscan/reconstruction/result.hpp>
#include <vector>

namespace turnscan {

/// Names of files to write; an empty name is not written.
struct OutputFiles {
  /// Required: .ply, .obj or .glb (metres), .stl or .3mf (millimetres). Several objects go into one
  /// .3mf or .glb file; in other formats each gets a file of its own, numbered before the ending.
  std::string mesh{};
  std::string report{};         ///< .json: counts, parameters with their reasons, times, checks
  std::string page{};           ///< .html: the same to read, with the model in 3D
  UpAxis up = UpAxis::kFormat;  ///< axis that points up in the mesh files
};

/// A finished reconstruction. Copies share it; it does not change.
class ReconstructedScan {
 public:
  /// The objects on the turntable, the largest first, each with its mesh (metres; table frame: +Y
  /// is the rotation axis, the origin lies on the platter, angle 0), and what was measured,
  /// chosen and repaired on the way.
  const Reconstruction& result() const;
  const std::vector<ObjectResult>& objects() const { return result().objects; }

  /// The report as JSON text, as OutputFiles::report has it.
  std::string report() const;

  /// Writes the files and returns their names, the meshes first. Fails with kInvalidOption for an
  /// ending that is not supported, kNotFound or kIo where a folder is missing or cannot be written,
  /// and kCancelled; files that were written before remain.
  Result<std::vector<std::string>> write(const OutputFiles& files,
                                         const RunContext& context = {}) const;

  struct Impl;
  explicit ReconstructedScan(std::shared_ptr<const Impl> impl);

 private:
  std::shared_ptr<const Impl> impl_;
};

/// One of several recordings of an object.
struct NamedFrames {
  std::string name;  ///< appears in notes
  const FrameSequence* frames = nullptr;
};

/// Reconstructs what stands on the turntable. The turntable and the angles of the frames come from
/// the frames or from the option `turntable`, a calibration file. Where they are missing or do not
/// fit, they are determined from the motion of the object (option `calibration`). Passes, in which
/// the object lies differently, become one mesh.
///
/// The options are those of `turnscan reconstruct`. The result is the same, byte for byte, for
/// every number of threads.
///
/// Fails with kInvalidOption, kMissingData (no calibration, and none can be determined; a pass that
/// does not fit the others), kTooFewPoints (nothing is left on the platter), kLibrary (a mesh is
/// not watertight, unless the option `allow-open` is true), kCancelled, and as reading frames does.
Result<ReconstructedScan> reconstruct(const FrameSequence& frames, const Options& options = {},
                                      const RunContext& context = {});

/// The same for several recordings of one object, at least one; each has its own sensors and
/// calibration.
Result<ReconstructedScan> reconstruct(const std::vector<NamedFrames>& recordings,
                                      const Options& options = {}, const RunContext& context = {});

/// The options of reconstruct().
std::vector<OptionDescription> reconstruct_options();

}  // namespace turnscan
