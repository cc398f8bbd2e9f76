#pragma once
// Images with their cameras and poses, written as other programs read them.
// docs/reference/exporting.md describes the layouts.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <turnscan/core/camera.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

enum class ExportFormat { kColmap, kNerfstudio, kBop, kTum, kMeshroom };

namespace exporters {

/// What the images of a camera may still be distorted by.
enum class LensModel { kNone, kBrown, kRational };

/// How a program names and stores images.
struct ExportLayout {
  ExportFormat format;
  std::string_view name;  ///< as `turnscan export --to` takes it
  std::string_view help;
  std::string_view image_folder, depth_folder, mask_folder;
  LensModel lens;
  std::optional<double> depth_unit_m;  ///< metres per step by its definition; nullopt: any
  /// Colour shares the pixels of depth; else it may have a camera of its own.
  bool one_camera;
};
const std::vector<ExportLayout>& export_layouts();
const ExportLayout& layout_of(ExportFormat format);

/// Files are relative to the export's folder; empty: none.
struct PosedImage {
  std::uint32_t id = 0;  ///< of its frame
  double time_s = 0.0;
  std::string image, depth, mask;
  CameraIntrinsics camera;  ///< of all three; its lens is one that the layout has
  double depth_unit_m = 0.0;
  Pose T_world_camera = Pose::Identity();  ///< world: +Y up
};

/// File names of the image with this id.
std::string image_file(const ExportLayout& layout, std::uint32_t id, bool jpeg);
std::string depth_file(const ExportLayout& layout, std::uint32_t id);
std::string mask_file(const ExportLayout& layout, std::uint32_t id, bool jpeg);

/// Writes what accompanies the images in the folder: cameras, poses and, of the mesh (nullptr:
/// none), points or a model. Images without colour are described in files of their own if others
/// have colour and the layout wants colour. Fails as write_file_atomically() and write_mesh(), and
/// with kUnsupported if the layout cannot describe the images (TUM: several cameras; Meshroom: no
/// colour).
Result<> write_descriptions(const std::filesystem::path& folder, const ExportLayout& layout,
                            const std::vector<PosedImage>& images, const TriangleMesh* mesh);

}  // namespace exporters
}  // namespace turnscan
