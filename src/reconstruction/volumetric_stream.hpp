#pragma once
// The volumetric method while frames come.

#include <turnscan/reconstruction/first_look.hpp>
#include <turnscan/reconstruction/volumetric.hpp>

namespace turnscan {

class VolumetricStream {
 public:
  /// rays: per sensor. header and rays must outlive it.
  static Result<VolumetricStream> create(const SequenceHeader& header,
                                         const ReconstructOptions& options, const FirstLook& look,
                                         const std::vector<RayTable>& rays);

  /// What the method needs of a frame. May be called from several threads at once.
  Result<DepthView> view(const Frame& frame, const Pose& T_table_sensor) const;

  /// Adds what a frame gave, in order.
  Result<> add(DepthView view);

  /// out holds what the frames told, and gets the objects. Fails as reconstruct() does.
  Result<> finish(const StageSink& sink, const RunContext& context, Reconstruction& out);

 private:
  VolumetricStream(const SequenceHeader& header, const ReconstructOptions& options,
                   const std::vector<RayTable>& rays)
      : header_(&header), options_(options), rays_(&rays) {}

  void measure_thickness(Reconstruction& out);

  const SequenceHeader* header_;
  ReconstructOptions options_;
  const std::vector<RayTable>* rays_;
  ViewScale view_scale_;
  VolumetricInput input_;
};

}  // namespace turnscan
