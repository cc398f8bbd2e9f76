#pragma once
// The volumetric method while frames come.

#include <mutex>
#include <turnscan/reconstruction/first_look.hpp>
#include <turnscan/reconstruction/volumetric.hpp>

namespace turnscan {

/// Views spread evenly over a scan: every one, or every 2nd, 4th, ... of each sensor, so that
/// memory does not grow with the scan.
class ViewStore {
 public:
  static constexpr std::size_t kMostViews = 1024, kFewViews = 64;
  static constexpr std::size_t kMostBytes = std::size_t(256) << 20;

  void add(DepthView view, std::uint32_t sensor);
  const std::vector<DepthView>& views() const { return views_; }
  /// How many of the scan's views one of these stands for.
  std::uint32_t stride() const { return stride_; }
  std::vector<DepthView> take() { return std::move(views_); }

 private:
  void thin();

  std::vector<DepthView> views_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>>
      key_;                          ///< per view: sensor, its number there
  std::vector<std::uint32_t> seen_;  ///< per sensor
  std::uint32_t stride_ = 1;
  std::size_t bytes_ = 0;
};

/// One thread adds and finishes; preview() may be called from others meanwhile.
class VolumetricStream {
 public:
  /// rays: per sensor. header and rays must outlive it.
  static Result<std::unique_ptr<VolumetricStream>> create(const SequenceHeader& header,
                                                          const ReconstructOptions& options,
                                                          const FirstLook& look,
                                                          const std::vector<RayTable>& rays);

  /// What the method needs of a frame. May be called from several threads at once.
  Result<DepthView> view(const Frame& frame, const Pose& T_table_sensor) const;

  /// The same of a line scanner's profiles.
  DepthView view(std::span<const Profile> group, const LightSheet& sheet) const {
    return view_of_profiles(group, sheet, view_scale_);
  }

  /// Adds what a frame of this sensor gave, in order.
  Result<> add(DepthView view, std::uint32_t sensor);

  /// The frames of the first look are there: chooses the scale from them.
  Result<> begin();

  /// A rough mesh of what was added so far, in bounded time; empty before begin().
  Result<TriangleMesh> preview(const RunContext& context) const;

  /// out holds what the frames told, and gets the objects. Fails as reconstruct() does.
  Result<> finish(const StageSink& sink, const RunContext& context, Reconstruction& out);

 private:
  VolumetricStream(const SequenceHeader& header, const ReconstructOptions& options,
                   const std::vector<RayTable>& rays)
      : header_(&header), options_(options), rays_(&rays) {}

  Result<> accumulate(bool all);
  Result<> correct_noise(Reconstruction& out);

  const SequenceHeader* header_;
  ReconstructOptions options_;
  const std::vector<RayTable>* rays_;
  ViewScale view_scale_;
  VolumetricInput input_;  ///< its views only at the end
  double sensor_noise_m_ = 0.0;
  bool are_images_ = false;  ///< depth images, all of them
  bool begun_ = false;
  std::vector<DepthView> pending_;
  std::vector<std::uint32_t> pending_sensor_;
  ViewStore kept_;
  VolumetricScale scale_;
  mutable std::mutex mutex_;  ///< guards sums_
  FieldSums sums_;
};

}  // namespace turnscan
