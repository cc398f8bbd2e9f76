#include <algorithm>
#include <cstring>
#include <turnscan/io/mesh/glb_accessor.hpp>

namespace turnscan::mesh_io {

namespace {

template <class T>
const T* item(const std::vector<T>& items, int index) {
  return index >= 0 && static_cast<std::size_t>(index) < items.size()
             ? &items[static_cast<std::size_t>(index)]
             : nullptr;
}

template <class T>
double load(const unsigned char* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return static_cast<double>(value);
}

}  // namespace

std::optional<GlbAccessor> GlbAccessor::open(const tinygltf::Model& model, int index) {
  const tinygltf::Accessor* accessor = item(model.accessors, index);
  if (accessor == nullptr || accessor->sparse.isSparse) return std::nullopt;
  const tinygltf::BufferView* view = item(model.bufferViews, accessor->bufferView);
  if (view == nullptr) return std::nullopt;
  const tinygltf::Buffer* buffer = item(model.buffers, view->buffer);
  if (buffer == nullptr) return std::nullopt;
  GlbAccessor opened;
  opened.components_ = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor->type));
  opened.component_type_ = accessor->componentType;
  opened.component_bytes_ =
      tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor->componentType));
  if (opened.components_ < 1 || opened.component_bytes_ < 1 || accessor->count < 1)
    return std::nullopt;
  const auto item_bytes = static_cast<std::size_t>(opened.components_ * opened.component_bytes_);
  opened.stride_ = view->byteStride == 0 ? item_bytes : view->byteStride;
  opened.count_ = accessor->count;
  opened.normalized_ = accessor->normalized;
  const std::size_t buffer_bytes = buffer->data.size();
  if (view->byteOffset > buffer_bytes || view->byteLength > buffer_bytes - view->byteOffset ||
      accessor->byteOffset > view->byteLength)
    return std::nullopt;
  const std::size_t left = view->byteLength - accessor->byteOffset;
  if (opened.stride_ < item_bytes || left < item_bytes ||
      opened.count_ - 1 > (left - item_bytes) / opened.stride_)
    return std::nullopt;
  opened.data_ = buffer->data.data() + view->byteOffset + accessor->byteOffset;
  return opened;
}

bool GlbAccessor::is_unsigned() const {
  return component_type_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
         component_type_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         component_type_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

double GlbAccessor::at(std::size_t item, int component) const {
  const unsigned char* from =
      data_ + item * stride_ + static_cast<std::size_t>(component * component_bytes_);
  const auto scaled = [this](double value, double full) {
    return normalized_ ? std::max(value / full, -1.0) : value;
  };
  switch (component_type_) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return scaled(load<std::int8_t>(from), 127.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return scaled(load<std::uint8_t>(from), 255.0);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return scaled(load<std::int16_t>(from), 32767.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return scaled(load<std::uint16_t>(from), 65535.0);
    case TINYGLTF_COMPONENT_TYPE_INT:
      return load<std::int32_t>(from);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load<std::uint32_t>(from);
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return load<float>(from);
    default:
      return load<double>(from);
  }
}

std::uint32_t GlbAccessor::index_at(std::size_t item) const {
  std::uint32_t value = 0;
  std::memcpy(&value, data_ + item * stride_, static_cast<std::size_t>(component_bytes_));
  return value;
}

}  // namespace turnscan::mesh_io
