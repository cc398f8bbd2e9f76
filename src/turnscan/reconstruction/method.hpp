#pragma once
// Interface between a stream of frames and a reconstruction method. A new method is a pair of files
// that provides its MethodEntry, a name in SurfaceMethod, and a line in method.cpp.

#include <memory>
#include <span>
#include <string>
#include <turnscan/reconstruction/estimation/scan_estimate.hpp>
#include <turnscan/reconstruction/frame_batch.hpp>
#include <turnscan/reconstruction/object_partition.hpp>
#include <turnscan/reconstruction/options.hpp>
#include <turnscan/reconstruction/result.hpp>
#include <vector>

namespace turnscan {

/// A pass, and the estimate from its first frames.
struct PassInput {
  Pose T_object_table = Pose::Identity();
  const estimation::ScanEstimate& estimate;
  const ObjectPartition* share = nullptr;  ///< outlives the method; nullptr: all of the table
};

/// One thread adds and finishes; preview() may be called from others between begin() and finish().
class Method {
 public:
  Method() = default;
  Method(const Method&) = delete;
  Method& operator=(const Method&) = delete;
  virtual ~Method() = default;

  /// Processes frames on all cores, and adds the results in their order. Updates the counts in out.
  /// If a call fails, none of its frames is added.
  virtual Result<> add(std::span<const PosedFrame> frames, const FrameReader& read,
                       const RunContext& context, Reconstruction& out) = 0;

  /// The frames that follow belong to another pass. Only for methods created with a T_object_table.
  virtual Result<> begin_pass(const PassInput& pass, const RunContext& context) = 0;

  /// Called after the frames of the estimate have been added. Fails with kCancelled.
  virtual Result<> begin(const RunContext&) { return {}; }

  /// A coarse mesh of what was added so far, in bounded time; empty before begin(). Only for
  /// methods with previews.
  virtual Result<TriangleMesh> preview(const RunContext& context) const;

  /// Called once, at the end. out contains the results of the frames and receives the objects.
  /// Fails as reconstruct() does.
  virtual Result<> finish(const StageSink& sink, const RunContext& context,
                          Reconstruction& out) = 0;
};

/// Input for creating a method. The header, the options and the rays outlive it, the others do not.
struct MethodInput {
  const SequenceHeader& header;
  const ReconstructOptions& options;
  const std::vector<RayTable>& rays;  ///< per sensor
  const estimation::ScanEstimate& estimate;
  std::span<const Frame> first_frames;  ///< those of the estimate, which will be added first
  bool whole = false;                   ///< there will be no other frames
  /// With several passes: that of the first. Otherwise everything is in the table frame.
  std::optional<Pose> T_object_table;
  const ObjectPartition* share = nullptr;  ///< see PassInput
};

struct MethodEntry {
  SurfaceMethod method = SurfaceMethod::kVolumetric;
  std::vector<std::string> option_stages;  ///< stages all of whose options it uses
  std::vector<std::string> options;        ///< names of the options of other stages that it uses
  std::vector<std::string> saveable_stages;
  bool previews = false;
  Result<std::unique_ptr<Method>> (*create)(const MethodInput& input) = nullptr;
};

const std::vector<MethodEntry>& methods();
const MethodEntry& method_entry(SurfaceMethod method);

}  // namespace turnscan
