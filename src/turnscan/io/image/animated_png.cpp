#include <libdeflate.h>

#include <string_view>
#include <turnscan/io/image/animated_png.hpp>
#include <turnscan/io/image/png_codec.hpp>
#include <vector>

namespace turnscan {

namespace {

void append_32(std::string& out, std::uint32_t value) {
  for (const int shift : {24, 16, 8, 0}) out.push_back(char(value >> shift & 0xffu));
}

void append_16(std::string& out, std::uint32_t value) {
  for (const int shift : {8, 0}) out.push_back(char(value >> shift & 0xffu));
}

void append_chunk(std::string& out, std::string_view type, std::string_view data) {
  append_32(out, std::uint32_t(data.size()));
  const std::size_t begin = out.size();
  out += type;
  out += data;
  append_32(out, libdeflate_crc32(0, out.data() + begin, out.size() - begin));
}

/// The parts of an image that go into an animation.
struct Parts {
  std::string_view header;             ///< content of its IHDR
  std::vector<std::string_view> data;  ///< contents of its IDATs
};

Result<Parts> parts_of(std::string_view png) {
  TURNSCAN_TRY(image::read_png_info(png));
  Parts out;
  for (std::size_t at = image::kPngSignature.size(); at + 12 <= png.size();) {
    const std::size_t size = image::big_endian_32(png, at);
    if (size > png.size() - at - 12) break;
    const std::string_view type = png.substr(at + 4, 4), content = png.substr(at + 8, size);
    if (type == "IHDR") out.header = content;
    if (type == "IDAT") out.data.push_back(content);
    if (type == "IEND") return out;
    at += size + 12;
  }
  return fail(ErrorCode::kFormat, "damaged PNG image: it has no end");
}

/// Frame control of an image that covers the whole canvas and replaces the previous one.
std::string frame_control(std::uint32_t sequence, std::string_view header, int milliseconds) {
  std::string out;
  append_32(out, sequence);
  out += header.substr(0, 8);  // width, height
  append_32(out, 0);           // its position
  append_32(out, 0);
  append_16(out, std::uint32_t(milliseconds));
  append_16(out, 1000);
  out.append(2, '\0');  // keep the previous image, and overwrite it
  return out;
}

}  // namespace

Result<std::string> animated_png(std::span<const std::string> images, int milliseconds_each) {
  std::string out(image::kPngSignature);
  std::string_view header;
  std::uint32_t sequence = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    TURNSCAN_ASSIGN(const Parts parts, parts_of(images[i]));
    if (i == 0) {
      header = parts.header;
      append_chunk(out, "IHDR", header);
      std::string control;
      append_32(control, std::uint32_t(images.size()));
      append_32(control, 0);
      append_chunk(out, "acTL", control);
    } else if (parts.header != header) {
      return fail(ErrorCode::kFormat, "image {} of an animation has another size or kind", i);
    }
    append_chunk(out, "fcTL", frame_control(sequence++, header, milliseconds_each));
    for (const std::string_view data : parts.data) {
      if (i == 0) {
        append_chunk(out, "IDAT", data);
        continue;
      }
      std::string numbered;
      append_32(numbered, sequence++);
      numbered += data;
      append_chunk(out, "fdAT", numbered);
    }
  }
  if (header.empty()) return fail(ErrorCode::kFormat, "an animation needs images");
  append_chunk(out, "IEND", {});
  return out;
}

}  // namespace turnscan
