#pragma once
// Uploads a large image to the graphics card piece by piece: uploading it at once would cause a
// noticeable pause, and so would the mipmap levels if the card generated them.

#include <vtkNew.h>
#include <vtkOpenGLTexture.h>
#include <vtkSmartPointer.h>
#include <vtkTextureObject.h>

#include <memory>
#include <turnscan/core/image.hpp>
#include <vector>

namespace turnscan::studio {

/// Images with more pixels are uploaded in pieces.
inline constexpr std::size_t kPictureAtOnce = 1200000;

class LargeTexture {
 public:
  /// The image and halves_of() it, which must outlive this.
  LargeTexture(const ColorImage& picture, const std::vector<ColorImage>& halves,
               vtkOpenGLRenderWindow* window);

  /// Uploads one more piece, until it is complete. The window's context must be current.
  void upload_piece();
  bool complete() const { return level_ == levels_.size(); }
  /// Valid once it is complete.
  vtkSmartPointer<vtkTexture> texture() const;

 private:
  void allocate();

  std::vector<const ColorImage*> levels_;
  vtkNew<vtkTextureObject> object_;
  bool allocated_ = false;
  std::size_t level_ = 0;
  int row_ = 0;
};

}  // namespace turnscan::studio
