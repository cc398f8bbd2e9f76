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

class LargeTexture {
 public:
  /// The picture and halves_of() it, which have to live as long.
  LargeTexture(const ColorImage& picture, const std::vector<ColorImage>& halves,
               vtkOpenGLRenderWindow* window);

  /// One piece more, until it is complete. The window's context must be current.
  void upload_piece();
  bool complete() const { return level_ == levels_.size(); }
  /// Once it is complete.
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
