#pragma once
// What a stream of frames asks of a reconstruction method. A new method is a pair of files that
// gives its MethodEntry, a name in SurfaceMethod, and a line in method.cpp.

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

/// A pass, and what its first frames told.
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

  /// Works on frames, on all cores, and adds what they give in their order. out gets the counts.
  /// Of a call that fails no frame is added.
  virtual Result<> add(std::span<const PosedFrame> frames, const FrameReader& read,
                       const RunContext& context, Reconstruction& out) = 0;

  /// The frames that follow are of another pass. Of methods that were made with a T_object_table.
  virtual Result<> begin_pass(const PassInput& pass, const RunContext& context) = 0;

  /// The frames that the estimate was made from have been added. Fails with kCancelled.
  virtual Result<> begin(const RunContext&) { return {}; }

  /// A rough mesh of what was added so far, in bounded time; empty before begin(). Of methods that
  /// have previews.
  virtual Result<TriangleMesh> preview(const RunContext& context) const;

  /// Once, at the end. out holds what the frames told, and gets the objects. Fails as
  /// reconstruct() does.
  virtual Result<> finish(const StageSink& sink, const RunContext& context,
                          Reconstruction& out) = 0;
};

/// What a method starts from. The header, the options and the rays outlive it, the others do not.
struct MethodInput {
  const SequenceHeader& header;
  const ReconstructOptions& options;
  const std::vector<RayTable>& rays;  ///< per sensor
  const estimation::ScanEstimate& estimate;
  std::span<const Frame> first_frames;  ///< those of the estimate, which will be added first
  bool whole = false;                   ///< there will be no others
  /// Where there are several passes: of the first. Otherwise all is in the table frame.
  std::optional<Pose> T_object_table;
  const ObjectPartition* share = nullptr;  ///< see PassInput
};

struct MethodEntry {
  SurfaceMethod method = SurfaceMethod::kVolumetric;
  std::vector<std::string> option_stages;  ///< stages all of whose options it uses
  std::vector<std::string> options;        ///< names of those that it uses of other stages
  std::vector<std::string> saveable_stages;
  bool previews = false;
  Result<std::unique_ptr<Method>> (*create)(const MethodInput& input) = nullptr;
};

const std::vector<MethodEntry>& methods();
const MethodEntry& method_entry(SurfaceMethod method);

}  // namespace turnscan
