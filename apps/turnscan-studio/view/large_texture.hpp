#pragma once
// A large picture on its way to the graphics card, piece by piece: at once it would be a pause that
// shows, and so would the smaller levels of it, which the card would make by itself.

#include <vtkNew.h>
#include <vtkOpenGLTexture.h>
#include <vtkSmartPointer.h>
#include <vtkTextureObject.h>

#include <memory>
#include <turnscan/core/image.hpp>
#include <vector>

namespace turnscan::studio {

/// Pictures of more pixels are brought there in pieces.
inline constexpr std::size_t kPictureAtOnce = 1200000;

/// Halves of a picture, their halves, and so on, down to one pixel. Each pixel is the mean of those
/// that it stands for.
std::vector<ColorImage> halves_of(const ColorImage& picture);

class LargeTexture {
 public:
  /// The picture and halves_of() it, which have to live as long.
  LargeTexture(const ColorImage& picture, const std::vector<ColorImage>& halves,
               vtkOpenGLRenderWindow* window);

  /// One piece more; true when all is there. The window's context must be current.
  bool upload_piece();
  /// Once all is there.
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
