#include <turnscan/io/export/posed_images.hpp>

#include <algorithm>
#include <system_error>
#include <tuple>
#include <turnscan/io/export/description_writers.hpp>

namespace turnscan::exporters {

namespace fs = std::filesystem;

const std::vector<ExportLayout>& export_layouts() {
  constexpr double kMillimetre = 1e-3, kTumStep = 1.0 / 5000.0;
  static const std::vector<ExportLayout> layouts = {
      {ExportFormat::kColmap, "colmap",
       "COLMAP's sparse model as text (also for splatting programs)", "images", "depth", "masks",
       LensModel::kRational, kMillimetre, false},
      {ExportFormat::kNerfstudio, "nerfstudio", "nerfstudio's transforms.json", "images", "depth",
       "masks", LensModel::kBrown, kMillimetre, false},
      {ExportFormat::kBop, "bop", "a scene of the BOP benchmark of object poses", "test/000001/rgb",
       "test/000001/depth", "test/000001/mask", LensModel::kNone, std::nullopt, true},
      {ExportFormat::kTum, "tum", "a TUM RGB-D folder", "rgb", "depth", "mask", LensModel::kNone,
       kTumStep, true},
      {ExportFormat::kMeshroom, "meshroom", "AliceVision's cameras.sfm", "images", "depth", "masks",
       LensModel::kNone, kMillimetre, false}};
  return layouts;
}

const ExportLayout& layout_of(ExportFormat format) {
  return export_layouts()[static_cast<std::size_t>(format)];
}

std::string image_file(const ExportLayout& layout, std::uint32_t id, bool jpeg) {
  return fmt::format("{}/{:06}.{}", layout.image_folder, id, jpeg ? "jpg" : "png");
}

std::string depth_file(const ExportLayout& layout, std::uint32_t id) {
  return fmt::format("{}/{:06}.png", layout.depth_folder, id);
}

std::string mask_file(const ExportLayout& layout, std::uint32_t id, bool jpeg) {
  switch (layout.format) {
    case ExportFormat::kColmap:  // the image's name, and .png
      return fmt::format("{}/{:06}.{}.png", layout.mask_folder, id, jpeg ? "jpg" : "png");
    case ExportFormat::kBop:  // image, instance of an object
      return fmt::format("{}/{:06}_000000.png", layout.mask_folder, id);
    default:
      return fmt::format("{}/{:06}.png", layout.mask_folder, id);
  }
}

Cameras::Cameras(const std::vector<PosedImage>& images) {
  for (const PosedImage& image : images)
    if (number_of(image.camera) == cameras_.size()) cameras_.push_back(image.camera);
}

std::size_t Cameras::number_of(const CameraIntrinsics& camera) const {
  const auto values = [](const CameraIntrinsics& c) {
    return std::tie(c.width, c.height, c.fx, c.fy, c.cx, c.cy, c.distortion);
  };
  const auto at = std::find_if(cameras_.begin(), cameras_.end(), [&](const CameraIntrinsics& c) {
    return values(c) == values(camera);
  });
  return std::size_t(at - cameras_.begin());
}

Result<> make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) return {};
  return fail_at(folder.string(), ErrorCode::kIo, "cannot create the folder: {}", error.message());
}

Result<> write_descriptions(const fs::path& folder, const ExportLayout& layout,
                            const std::vector<PosedImage>& images, const TriangleMesh* mesh) {
  if (layout.format == ExportFormat::kBop) return write_bop(folder, images, mesh);
  if (layout.format == ExportFormat::kTum) return write_tum(folder, images);
  if (layout.format == ExportFormat::kMeshroom) return write_meshroom(folder, images);
  const auto write = layout.format == ExportFormat::kColmap ? &write_colmap : &write_nerfstudio;
  std::vector<PosedImage> colored, others;
  for (const PosedImage& image : images) (image.image.empty() ? others : colored).push_back(image);
  const bool apart = !colored.empty() && !others.empty();
  if (apart) TURNSCAN_TRY(write(folder, others, nullptr, true));
  return write(folder, apart ? colored : images, mesh, false);
}

}  // namespace turnscan::exporters
