#pragma once
// The methods from points while frames come: each frame's points are added up at once, and only
// the sums are kept.

#include <turnscan/reconstruction/first_look.hpp>
#include <turnscan/reconstruction/point_sums.hpp>

namespace turnscan {

class PointStream {
 public:
  /// profiles: frames are lines of points without neighbours across. options must outlive it.
  PointStream(const ReconstructOptions& options, const FirstLook& look, bool profiles)
      : options_(options), look_(look), profiles_(profiles) {}

  /// What frames gave, in their order. The first ones, those of the first look, choose the size of
  /// the voxels; whole: there will be no others.
  Result<> add(const std::vector<FramePart>& parts, const std::vector<Viewpoint>& viewpoints,
               bool whole, const RunContext& context);

  /// Voxels, candidates, normals, refine, base, surface. out holds what the frames told, and gets
  /// the objects. Fails as reconstruct() does.
  Result<> finish(const StageSink& sink, const RunContext& context, Reconstruction& out);

 private:
  /// The size of voxels, and what it was found from.
  struct Scale {
    double voxel_m = 0.0, noise_m = 0.0, spacing_m = 0.0, pixels_m = 0.0;
    double least_m = 0.0;  ///< profiles lie so far apart
    bool automatic = false;
    std::string reason;
  };

  Result<> filter_cloud(const RunContext& context);
  Result<> begin(bool whole);
  Scale scale_of(const MergedCloud& cloud, bool whole) const;
  Result<> add_up(const MergedCloud& cloud);
  Result<Measurements> measure(const RunContext& context, Reconstruction& out);

  const ReconstructOptions& options_;
  FirstLook look_;
  bool profiles_;
  bool keep_ = options_.keep_points || options_.merge.cloud_outliers;
  std::uint64_t returns_ = 0;
  MergedCloud cloud_;  ///< until the scale is chosen, or all of it where it is asked for
  std::optional<Scale> scale_;
  std::optional<PointSums> sums_;
};

}  // namespace turnscan
