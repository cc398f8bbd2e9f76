#pragma once
// One writer per layout.

#include <turnscan/io/export/posed_images.hpp>

namespace turnscan::exporters {

/// The distinct cameras of images, in the order of their first ones.
class Cameras {
 public:
  explicit Cameras(const std::vector<PosedImage>& images);
  const std::vector<CameraIntrinsics>& list() const { return cameras_; }
  /// Position in the list; its size if it is not there.
  std::size_t number_of(const CameraIntrinsics& camera) const;

 private:
  std::vector<CameraIntrinsics> cameras_;
};

/// Creates a folder in the export's folder, with parents.
Result<> make_folder(const std::filesystem::path& folder);

// depth_only: the images are those without colour beside others with colour.
Result<> write_colmap(const std::filesystem::path& folder, const std::vector<PosedImage>& images,
                      const TriangleMesh* mesh, bool depth_only);
Result<> write_nerfstudio(const std::filesystem::path& folder,
                          const std::vector<PosedImage>& images, const TriangleMesh* mesh,
                          bool depth_only);
Result<> write_bop(const std::filesystem::path& folder, const std::vector<PosedImage>& images,
                   const TriangleMesh* mesh);
Result<> write_tum(const std::filesystem::path& folder, const std::vector<PosedImage>& images);
Result<> write_meshroom(const std::filesystem::path& folder, const std::vector<PosedImage>& images);

}  // namespace turnscan::exporters
