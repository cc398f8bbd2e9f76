#pragma once
// Checked access to the arrays of a glTF model.

#include <cstdint>
#include <optional>
#include <turnscan/io/mesh/tinygltf.hpp>

namespace turnscan::mesh_io {

/// An array that is entirely within its buffer.
class GlbAccessor {
 public:
  /// nullopt unless the accessor exists, refers to existing bytes, and is neither sparse nor
  /// without data.
  static std::optional<GlbAccessor> open(const tinygltf::Model& model, int index);

  std::size_t count() const { return count_; }
  int components() const { return components_; }
  bool is_floating() const { return component_type_ == TINYGLTF_COMPONENT_TYPE_FLOAT; }
  bool is_unsigned() const;

  /// A component of an item; normalized integers are returned as fractions.
  double at(std::size_t item, int component) const;
  /// The first component of an item of an unsigned type.
  std::uint32_t index_at(std::size_t item) const;

 private:
  const unsigned char* data_ = nullptr;
  std::size_t stride_ = 0;
  std::size_t count_ = 0;
  int components_ = 0;
  int component_type_ = 0;
  int component_bytes_ = 0;
  bool normalized_ = false;
};

}  // namespace turnscan::mesh_io
