#pragma once
// What the tests' sensor for OpenNI 2 shows: a file of frames, and who may see the next one.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

namespace turnscan::testing {

/// Begins the file. Then, frame by frame: the depths in steps of 0.1 mm, 16 bits each, row by row,
/// and with colour red, green and blue of each pixel.
struct FilmHeader {
  std::int32_t width = 0, height = 0, fps = 30, count = 0;
  float hfov_rad = 1.0F, vfov_rad = 0.8F;
  std::int32_t color = 0;
  std::int32_t unplugged_after = -1;  ///< frames; -1: never

  std::size_t pixels() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
};

struct Film {
  FilmHeader header;
  std::vector<std::vector<std::uint16_t>> depth;
  std::vector<std::vector<std::uint8_t>> color;

  void write(const std::filesystem::path& file) {
    header.count = static_cast<std::int32_t>(depth.size());
    std::ofstream out(file, std::ios::binary);
    const auto put = [&](const void* data, std::size_t size) {
      out.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
    };
    put(&header, sizeof header);
    for (std::size_t i = 0; i < depth.size(); ++i) {
      put(depth[i].data(), depth[i].size() * sizeof(std::uint16_t));
      if (header.color != 0) put(color[i].data(), color[i].size());
    }
  }

  static Film read(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    Film film;
    const auto get = [&](void* data, std::size_t size) {
      in.read(static_cast<char*>(data), static_cast<std::streamsize>(size));
    };
    get(&film.header, sizeof film.header);
    for (std::int32_t i = 0; in && i < film.header.count; ++i) {
      film.depth.emplace_back(film.header.pixels());
      get(film.depth.back().data(), film.header.pixels() * sizeof(std::uint16_t));
      if (film.header.color == 0) continue;
      film.color.emplace_back(3 * film.header.pixels());
      get(film.color.back().data(), 3 * film.header.pixels());
    }
    if (!in) film.depth.clear();
    return film;
  }
};

/// The driver's function of that name lets the sensor show so many more frames; a sensor that was
/// just opened shows none. So no frame comes before the one before it was taken.
inline constexpr const char* kAllowFrames = "turnscan_test_allow_frames";
using AllowFrames = void (*)(int);

}  // namespace turnscan::testing
