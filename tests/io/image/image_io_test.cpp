#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <libdeflate.h>
#include <png.h>

#include <cmath>
#include <turnscan/core/random.hpp>
#include <turnscan/io/image/animated_png.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/image/jpeg_codec.hpp>
#include <turnscan/io/image/png_codec.hpp>

#include "tests/io/scarcity.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using testing::content_of;
using ::testing::HasSubstr;
using testing::TempFolder;

DepthImage some_depth(int width, int height) {
  DepthImage image(width, height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<std::uint16_t>(i * 40503U >> 3);
  image.pixels.front() = kNoReturn;
  image.pixels.back() = kOutsideCrop;
  return image;
}

ColorImage some_color(int width, int height) {
  ColorImage image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.at(x, y) = {static_cast<std::uint8_t>(x * 3), static_cast<std::uint8_t>(y * 5),
                        static_cast<std::uint8_t>(x + y)};
  return image;
}

/// A PNG of any kind, written by libpng itself; rows of zeros unless pixels are given.
std::string png_of(std::uint32_t width, std::uint32_t height, int depth, int type,
                   const std::string& pixels = "", bool interlaced = false,
                   int filters = PNG_ALL_FILTERS, std::size_t chunk = 8192) {
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &bytes,
      [](png_structp p, png_bytep data, std::size_t size) {
        static_cast<std::string*>(png_get_io_ptr(p))
            ->append(reinterpret_cast<const char*>(data), size);
      },
      [](png_structp) {});
  png_set_IHDR(png, info, width, height, depth, type,
               interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, 0, 0);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, filters);
  png_set_compression_buffer_size(png, chunk);
  const png_color palette[2] = {{10, 20, 30}, {200, 100, 50}};
  if (type == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette, 2);
  png_write_info(png, info);
  std::string content = pixels;
  content.resize(height * png_get_rowbytes(png, info));
  std::vector<png_bytep> rows(height);
  for (std::uint32_t y = 0; y < height; ++y)
    rows[y] = reinterpret_cast<png_bytep>(content.data()) + y * png_get_rowbytes(png, info);
  png_write_image(png, rows.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

/// The first bytes of a PNG that claims to have that many pixels.
std::string png_that_claims(std::uint32_t width, std::uint32_t height) {
  std::string bytes = png_of(1, 1, 16, PNG_COLOR_TYPE_GRAY);
  for (std::size_t i = 0; i < 4; ++i) {
    bytes[16 + i] = static_cast<char>(width >> (24 - 8 * i));
    bytes[20 + i] = static_cast<char>(height >> (24 - 8 * i));
  }
  return bytes;
}

TEST(DepthPng, KeepsEveryValue) {
  const TempFolder folder;
  for (const auto& [w, h] : {std::pair{1, 1}, {3, 7}, {640, 480}, {1, 500}}) {
    const DepthImage image = some_depth(w, h);
    ASSERT_TRUE(write_depth_png(folder / "d.png", image));
    const auto back = read_depth_png(folder / "d.png");
    ASSERT_TRUE(back) << back.error().text();
    EXPECT_EQ(back->width, w);
    EXPECT_EQ(back->height, h);
    EXPECT_EQ(back->pixels, image.pixels);
  }
}

TEST(DepthPng, ValuesLieInTheFileInTheOrderOfPng) {
  DepthImage image(1, 1);
  image.pixels[0] = 0x1234;
  const auto as_color = decode_color(encode_depth_png(image).value());
  ASSERT_TRUE(as_color);
  EXPECT_EQ(as_color->pixels[0].r, 0x12);
}

TEST(DepthPng, SameImageGivesTheSameBytes) {
  EXPECT_EQ(encode_depth_png(some_depth(64, 48)).value(),
            encode_depth_png(some_depth(64, 48)).value());
}

TEST(DepthPng, ReadsInterlacedFiles) {
  std::string pixels;
  for (int i = 0; i < 9 * 11 * 2; ++i) pixels += static_cast<char>(i);
  const auto plain = decode_depth_png(png_of(9, 11, 16, PNG_COLOR_TYPE_GRAY, pixels));
  const auto interlaced = decode_depth_png(png_of(9, 11, 16, PNG_COLOR_TYPE_GRAY, pixels, true));
  ASSERT_TRUE(plain);
  ASSERT_TRUE(interlaced);
  EXPECT_EQ(plain->pixels, interlaced->pixels);
  EXPECT_EQ(plain->pixels[1], 0x0203);
}

/// A ball before nothing, with noise, as big-endian values.
std::string noisy_ball(int width, int height, std::vector<std::uint16_t>& values) {
  std::string pixels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool ball = std::hypot(x - width / 2, y - height / 2) < height / 3;
      values.push_back(ball ? std::uint16_t(4400 + 300 * uniform01(hash_key(7, x, y))) : 0);
      pixels += static_cast<char>(values.back() >> 8);
      pixels += static_cast<char>(values.back() & 255);
    }
  }
  return pixels;
}

TEST(DepthPng, ReadsEveryFilterOfLibpngInAnyNumberOfChunks) {
  std::vector<std::uint16_t> values;
  const std::string pixels = noisy_ball(61, 47, values);
  for (const int filters : {PNG_FILTER_NONE, PNG_FILTER_SUB, PNG_FILTER_UP, PNG_FILTER_AVG,
                            PNG_FILTER_PAETH, PNG_ALL_FILTERS}) {
    for (const std::size_t chunk : {std::size_t{64}, std::size_t{100'000}}) {
      const auto image =
          decode_depth_png(png_of(61, 47, 16, PNG_COLOR_TYPE_GRAY, pixels, false, filters, chunk));
      ASSERT_TRUE(image) << image.error().text();
      EXPECT_EQ(image->pixels, values) << filters << ", " << chunk;
    }
  }
}

TEST(DepthPng, IsReadByLibpngAsWritten) {
  DepthImage image(61, 47);
  image.pixels.clear();
  const std::string pixels = noisy_ball(61, 47, image.pixels);
  // libpng's colours are the upper bytes.
  const auto upper = decode_color(encode_depth_png(image).value());
  ASSERT_TRUE(upper) << upper.error().text();
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    EXPECT_NEAR(upper->pixels[i].r, image.pixels[i] / 257.0, 0.51) << i;
}

TEST(DepthPng, RefusesEveryOtherKindOfPng) {
  for (const auto& [depth, type] : {std::pair{8, PNG_COLOR_TYPE_GRAY},
                                    {1, PNG_COLOR_TYPE_GRAY},
                                    {16, PNG_COLOR_TYPE_RGB},
                                    {8, PNG_COLOR_TYPE_PALETTE},
                                    {16, PNG_COLOR_TYPE_GRAY_ALPHA}}) {
    const auto image = decode_depth_png(png_of(4, 4, depth, type));
    ASSERT_FALSE(image);
    EXPECT_EQ(image.error().code, ErrorCode::kUnsupported);
    EXPECT_THAT(image.error().message, HasSubstr("must be a 16-bit grey PNG"));
  }
}

TEST(DepthPng, TruncatedFileIsDamagedWhereverItEnds) {
  const std::string bytes = encode_depth_png(some_depth(20, 20)).value();
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_FALSE(decode_depth_png(bytes.substr(0, length))) << length;
  const auto result = decode_depth_png(bytes.substr(0, bytes.size() / 2));
  EXPECT_EQ(result.error().code, ErrorCode::kFormat);
}

TEST(DepthPng, EveryFlippedByteIsEitherNoticedOrHarmless) {
  const std::string bytes = encode_depth_png(some_depth(20, 20)).value();
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x41);
    const auto image = decode_depth_png(damaged);
    if (image) {
      EXPECT_EQ(image->pixels, some_depth(20, 20).pixels) << i;
    }
  }
}

TEST(DepthPng, HugeClaimsAreRefusedBeforeAnyMemoryIsTaken) {
  EXPECT_EQ(decode_depth_png(png_that_claims(0x7fffffff, 0x7fffffff)).error().code,
            ErrorCode::kResourceLimit);
  EXPECT_EQ(decode_depth_png(png_that_claims(65536, 1)).error().code, ErrorCode::kResourceLimit);
  EXPECT_EQ(decode_depth_png(png_that_claims(8000, 8000)).error().code, ErrorCode::kFormat);
  EXPECT_EQ(decode_depth_png(png_that_claims(0, 10)).error().code, ErrorCode::kFormat);
}

TEST(DepthPng, ErrorNamesTheFile) {
  const TempFolder folder;
  const auto path = folder.put("d.png", "");
  const auto image = read_depth_png(path);
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().code, ErrorCode::kUnsupported);
  EXPECT_EQ(image.error().text(), path.string() + ": not a PNG image");
}

TEST(ColorPng, KeepsEveryPixel) {
  const TempFolder folder;
  const ColorImage image = some_color(37, 23);
  ASSERT_TRUE(write_color_png(folder / "c.png", image));
  const auto back = read_color(folder / "c.png");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->width, 37);
  EXPECT_EQ(back->height, 23);
  EXPECT_EQ(back->pixels, image.pixels);
}

TEST(ColorPng, ReadsEveryKindOfPng) {
  struct Case {
    int depth, type;
    std::string pixels;
    Rgb first, second;
  };
  const std::vector<Case> cases{
      {8, PNG_COLOR_TYPE_GRAY, "\x10\xf0", {16, 16, 16}, {240, 240, 240}},
      {1, PNG_COLOR_TYPE_GRAY, "\x40", {0, 0, 0}, {255, 255, 255}},
      {4, PNG_COLOR_TYPE_GRAY, "\x1f", {17, 17, 17}, {255, 255, 255}},
      {16, PNG_COLOR_TYPE_GRAY, "\x80\x80\xff\xff", {128, 128, 128}, {255, 255, 255}},
      {8,
       PNG_COLOR_TYPE_GRAY_ALPHA,
       std::string("\x10\x00\xf0\xff", 4),
       {16, 16, 16},
       {240, 240, 240}},
      {8, PNG_COLOR_TYPE_RGB, "\x01\x02\x03\x04\x05\x06", {1, 2, 3}, {4, 5, 6}},
      {8,
       PNG_COLOR_TYPE_RGBA,
       std::string("\x01\x02\x03\x00\x04\x05\x06\x80", 8),
       {1, 2, 3},
       {4, 5, 6}},
      {1, PNG_COLOR_TYPE_PALETTE, "\x40", {10, 20, 30}, {200, 100, 50}},
      {16,
       PNG_COLOR_TYPE_RGB,
       std::string("\x01\x01\x02\x02\x03\x03\xff\xff\x80\x80\x00\x00", 12),
       {1, 2, 3},
       {255, 128, 0}}};
  for (const Case& c : cases) {
    const auto image = decode_color(png_of(2, 1, c.depth, c.type, c.pixels));
    ASSERT_TRUE(image) << c.depth << ' ' << c.type << ' ' << image.error().text();
    EXPECT_EQ(image->pixels[0], c.first) << c.depth << ' ' << c.type;
    EXPECT_EQ(image->pixels[1], c.second) << c.depth << ' ' << c.type;
  }
}

TEST(ColorPng, ReadsEveryFilterOfLibpngInAnyNumberOfChunks) {
  const ColorImage image = some_color(61, 47);
  const std::string pixels(reinterpret_cast<const char*>(image.pixels.data()),
                           image.pixels.size() * sizeof(Rgb));
  for (const int filters : {PNG_FILTER_NONE, PNG_FILTER_SUB, PNG_FILTER_UP, PNG_FILTER_AVG,
                            PNG_FILTER_PAETH, PNG_ALL_FILTERS}) {
    for (const std::size_t chunk : {std::size_t(6), std::size_t(1000), std::size_t(1) << 20}) {
      const auto back =
          decode_color(png_of(61, 47, 8, PNG_COLOR_TYPE_RGB, pixels, false, filters, chunk));
      ASSERT_TRUE(back) << filters << ", " << chunk << ": " << back.error().text();
      EXPECT_EQ(back->pixels, image.pixels) << filters << ", " << chunk;
    }
  }
}

TEST(ColorJpeg, StaysNearThePixels) {
  const TempFolder folder;
  const ColorImage image = some_color(40, 30);
  ASSERT_TRUE(write_color_jpeg(folder / "c.jpg", image, 95));
  const auto back = read_color(folder / "c.jpg");
  ASSERT_TRUE(back);
  ASSERT_EQ(back->width, 40);
  ASSERT_EQ(back->height, 30);
  double sum = 0.0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    sum += std::abs(image.pixels[i].g - back->pixels[i].g);
  EXPECT_LT(sum / static_cast<double>(image.pixels.size()), 2.0);
}

TEST(ColorJpeg, LowerQualityGivesFewerBytes) {
  const ColorImage image = some_color(64, 64);
  EXPECT_LT(encode_color_jpeg(image, 20).value().size(),
            encode_color_jpeg(image, 95).value().size());
  EXPECT_THROW((void)encode_color_jpeg(image, 0), std::invalid_argument);
  EXPECT_THROW((void)encode_color_jpeg(image, 101), std::invalid_argument);
}

TEST(ColorJpeg, TruncatedFileIsDamagedWhereverItEnds) {
  const std::string bytes = encode_color_jpeg(some_color(40, 30)).value();
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_FALSE(decode_color(bytes.substr(0, length))) << length;
  EXPECT_EQ(decode_color(bytes.substr(0, bytes.size() / 2)).error().code, ErrorCode::kFormat);
}

TEST(ColorJpeg, AFrameKeepsTheFileThatItsColourCameFrom) {
  const std::string jpeg = encode_color_jpeg(some_color(16, 16)).value();
  Frame frame;
  ASSERT_TRUE(decode_frame_color(jpeg, frame));
  EXPECT_EQ(frame.color_jpeg, jpeg);
  EXPECT_FALSE(decode_frame_color(jpeg.substr(0, 100), frame));
  EXPECT_EQ(frame.color_jpeg, jpeg);
  ASSERT_TRUE(decode_frame_color(encode_color_png(some_color(8, 8)).value(), frame));
  EXPECT_TRUE(frame.color_jpeg.empty());
  EXPECT_EQ(frame.color.width, 8);
}

TEST(ColorJpeg, AStreamWithoutTablesOrWithMoreBehindItsEndIsNoFile) {
  std::string jpeg = encode_color_jpeg(some_color(16, 16)).value();
  EXPECT_TRUE(image::is_jpeg_file(jpeg));
  EXPECT_FALSE(image::is_jpeg_file(jpeg + std::string(3, '\0')));
  for (std::size_t length = 0; length < jpeg.size(); ++length)
    EXPECT_FALSE(image::is_jpeg_file(std::string_view(jpeg).substr(0, length))) << length;
  // Without its Huffman tables, as some cameras send it.
  for (auto at = jpeg.find("\xff\xc4"); at != std::string::npos; at = jpeg.find("\xff\xc4"))
    jpeg.erase(at, 2 + std::size_t(std::uint8_t(jpeg[at + 3])));
  EXPECT_FALSE(image::is_jpeg_file(jpeg));
}

TEST(ColorJpeg, HugeClaimIsRefused) {
  std::string bytes = encode_color_jpeg(some_color(16, 16)).value();
  const auto frame = bytes.find("\xff\xc0");
  ASSERT_NE(frame, std::string::npos);
  bytes.replace(frame + 5, 4, "\xff\x00\xff\x00", 4);
  EXPECT_EQ(decode_color(bytes).error().code, ErrorCode::kResourceLimit);
  bytes.replace(frame + 5, 4, "\x1f\x00\x1f\x00", 4);
  EXPECT_EQ(decode_color(bytes).error().code, ErrorCode::kFormat);
}

TEST(Color, ContentThatIsNoImageIsUnsupported) {
  EXPECT_EQ(decode_color("").error().code, ErrorCode::kUnsupported);
  EXPECT_EQ(decode_color("GIF89a").error().code, ErrorCode::kUnsupported);
}

/// Chunk by chunk: type and content.
std::vector<std::pair<std::string, std::string>> chunks_of(const std::string& png) {
  std::vector<std::pair<std::string, std::string>> out;
  for (std::size_t at = 8; at + 12 <= png.size();) {
    const auto size = std::size_t(image::big_endian_32(png, at));
    out.emplace_back(png.substr(at + 4, 4), png.substr(at + 8, size));
    at += size + 12;
  }
  return out;
}

/// The picture that its header and data make, as libpng reads them without looking at the sums.
ColorImage image_of(const std::string& png, const std::string& header, const std::string& data) {
  std::string plain = png.substr(0, 8);
  for (const auto& [type, content] :
       {std::pair<std::string, std::string>{"IHDR", header}, {"IDAT", data}, {"IEND", ""}}) {
    for (const int shift : {24, 16, 8, 0}) plain.push_back(char(content.size() >> shift & 0xff));
    plain += type + content;
    const std::uint32_t sum =
        libdeflate_crc32(0, plain.data() + plain.size() - content.size() - 4, content.size() + 4);
    for (const int shift : {24, 16, 8, 0}) plain.push_back(char(sum >> shift & 0xff));
  }
  return decode_color(plain).value();
}

TEST(AnimatedPng, HoldsEveryImageAndShowsTheFirstWithoutAnimation) {
  std::vector<ColorImage> images;
  std::vector<std::string> packed;
  for (int i = 0; i < 3; ++i) {
    images.push_back(some_color(40, 30));
    images.back().at(5 + i, 7) = {255, 0, 0};
    packed.push_back(encode_color_png(images.back()).value());
  }
  const std::string png = animated_png(packed, 40).value();
  EXPECT_EQ(decode_color(png)->pixels, images[0].pixels);  // libpng checks the sums
  std::vector<std::string> data(3);
  std::string header;
  std::uint32_t sequence = 0;
  std::size_t frame = 0;
  for (const auto& [type, content] : chunks_of(png)) {
    if (type == "IHDR") header = content;
    if (type == "fcTL" || type == "fdAT") {
      EXPECT_EQ(image::big_endian_32(content, 0), sequence++);
    }
    if (type == "fcTL") {
      ++frame;
      EXPECT_EQ(image::big_endian_32(content, 20), 40u << 16 | 1000u);
    }
    if (type == "IDAT") data[frame - 1] += content;
    if (type == "fdAT") data[frame - 1] += content.substr(4);
  }
  ASSERT_EQ(frame, 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(image_of(png, header, data[i]).pixels, images[i].pixels) << i;
}

TEST(AnimatedPng, RefusesImagesOfSeveralSizes) {
  const std::vector<std::string> packed{encode_color_png(some_color(4, 4)).value(),
                                        encode_color_png(some_color(4, 5)).value()};
  EXPECT_EQ(animated_png(packed, 40).error().code, ErrorCode::kFormat);
  EXPECT_EQ(animated_png({}, 40).error().code, ErrorCode::kFormat);
}

TEST(Images, WritersRefuseAnImageThatDoesNotFitItsSize) {
  DepthImage depth(4, 4);
  depth.pixels.pop_back();
  EXPECT_THROW((void)encode_depth_png(depth), std::invalid_argument);
  EXPECT_THROW((void)encode_color_png(ColorImage()), std::invalid_argument);
  EXPECT_THROW((void)encode_color_jpeg(ColorImage()), std::invalid_argument);
}

TEST(Images, WriterOnAFullDiskLeavesNothing) {
  const TempFolder folder;
  const testing::FullDisk full(100);
  const auto result = write_depth_png(folder / "d.png", some_depth(64, 64));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kIo);
  EXPECT_EQ(folder.count(), 0U);
}

}  // namespace
}  // namespace turnscan
