#include "view/large_texture.hpp"

#include <vtkOpenGLRenderWindow.h>

#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <algorithm>

namespace turnscan::studio {

namespace {

constexpr int kPiecePixels = 700000;  // about 8 ms on a software renderer

}  // namespace

LargeTexture::LargeTexture(const ColorImage& picture, const std::vector<ColorImage>& halves,
                           vtkOpenGLRenderWindow* window)
    : levels_{&picture} {
  for (const ColorImage& half : halves) levels_.push_back(&half);
  object_->SetContext(window);
}

void LargeTexture::allocate() {
  allocated_ = true;
  object_->SetWrapS(vtkTextureObject::Repeat);
  object_->SetWrapT(vtkTextureObject::Repeat);
  object_->SetMinificationFilter(vtkTextureObject::LinearMipmapLinear);
  object_->SetMagnificationFilter(vtkTextureObject::Linear);
  object_->SetMaxLevel(int(levels_.size()) - 1);
  object_->Allocate2D(unsigned(levels_[0]->width), unsigned(levels_[0]->height), 3,
                      VTK_UNSIGNED_CHAR);
  QOpenGLFunctions& gl = *QOpenGLContext::currentContext()->functions();
  object_->Bind();
  // The number of levels, the first of which was made by Allocate2D(), is set before the first has
  // pixels: a driver that had to guess would move them when the others are added.
  gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, GLint(levels_.size()) - 1);
  const auto format = GLint(object_->GetInternalFormat(VTK_UNSIGNED_CHAR, 3, false));
  for (std::size_t level = 1; level < levels_.size(); ++level)
    gl.glTexImage2D(GL_TEXTURE_2D, GLint(level), format, levels_[level]->width,
                    levels_[level]->height, 0, GL_RGB, GL_UNSIGNED_BYTE, nullptr);
}

void LargeTexture::upload_piece() {
  QOpenGLFunctions& gl = *QOpenGLContext::currentContext()->functions();
  if (!allocated_) allocate();
  object_->Bind();
  GLint alignment = 4;
  gl.glGetIntegerv(GL_UNPACK_ALIGNMENT, &alignment);
  gl.glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (int left = kPiecePixels; left > 0 && !complete();) {
    const ColorImage& from = *levels_[level_];
    const int rows = std::clamp(left / from.width, 1, from.height - row_);
    gl.glTexSubImage2D(GL_TEXTURE_2D, GLint(level_), 0, row_, from.width, rows, GL_RGB,
                       GL_UNSIGNED_BYTE, &from.at(0, row_));
    left -= rows * from.width;
    row_ += rows;
    if (row_ < from.height) continue;
    row_ = 0;
    ++level_;
  }
  gl.glPixelStorei(GL_UNPACK_ALIGNMENT, alignment);
  gl.glBindTexture(GL_TEXTURE_2D, 0);
}

vtkSmartPointer<vtkTexture> LargeTexture::texture() const {
  auto out = vtkSmartPointer<vtkOpenGLTexture>::New();
  out->SetTextureObject(object_);
  out->InterpolateOn();
  out->MipmapOn();
  out->RepeatOn();
  return out;
}

}  // namespace turnscan::studio
