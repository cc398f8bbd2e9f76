#include <turnscan/core/parallel.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/rendering/picture.hpp>
#include <turnscan/simulator/rendering/turning_picture.hpp>

#include "tests/simulator/shapes.hpp"

namespace turnscan {
namespace {

PictureOptions small() {
  PictureOptions o;
  o.width = 120;
  o.height = 100;
  o.ambient_samples = 4;
  o.ground = false;
  return o;
}

ColorImage picture_of(const std::vector<TriangleMesh>& meshes, const PictureOptions& options) {
  auto image = render_picture(meshes, options);
  EXPECT_TRUE(image) << (image ? "" : image.error().text());
  return image ? *image : ColorImage();
}

/// Rows and columns of what is not background.
struct Extent {
  int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
};

Extent extent_of(const ColorImage& image, int from = 0, int to = 1 << 20) {
  Extent e;
  for (int y = 0; y < image.height; ++y) {
    for (int x = from; x < std::min(to, image.width); ++x) {
      if (image.at(x, y) == Rgb{255, 255, 255}) continue;
      e.left = std::min(e.left, x), e.right = std::max(e.right, x);
      e.top = std::min(e.top, y), e.bottom = std::max(e.bottom, y);
    }
  }
  return e;
}

void expect_framed(const Extent& e, int left, int right, int height) {
  const int width = right - left;
  ASSERT_GE(e.right, e.left);
  EXPECT_NEAR(e.left - left, right - 1 - e.right, 2);
  EXPECT_NEAR(e.top, height - 1 - e.bottom, 2);
  const double fill =
      std::max(double(e.right - e.left + 1) / width, double(e.bottom - e.top + 1) / height);
  EXPECT_GT(fill, 0.85);
  EXPECT_LT(fill, 0.99);
}

TEST(Picture, FramesTheObjectInTheMiddle) {
  for (const double scale : {1e-6, 1.0, 1e3}) {
    TriangleMesh mesh = *builtin_object("letter-a");
    for (Vec3f& p : mesh.vertices) p = float(scale) * (p + Vec3f(3.0f, -2.0f, 1.0f));
    expect_framed(extent_of(picture_of({mesh}, small())), 0, 120, 100);
  }
}

TEST(Picture, FramesAllObjectsTogether) {
  const TriangleMesh a = test::sphere_mesh({0, 0, 0}, 0.1, 20);
  const TriangleMesh b = test::sphere_mesh({0.6, 0.2, 0}, 0.1, 20);
  const Extent e = extent_of(picture_of({a, b}, small()));
  expect_framed(e, 0, 120, 100);
}

TEST(Picture, PutsViewsSideBySide) {
  PictureOptions o = small();
  o.views = 3;
  const ColorImage image = picture_of({*builtin_object("letter-a")}, o);
  ASSERT_EQ(image.width, 360);
  for (int v = 0; v < 3; ++v)
    expect_framed(extent_of(image, 120 * v, 120 * (v + 1)), 120 * v, 120 * (v + 1), 100);
}

std::vector<ColorImage> turn_of(const std::vector<TriangleMesh>& meshes,
                                const PictureOptions& options, int frames) {
  std::vector<ColorImage> out;
  const auto take = [&](ColorImage image) -> Result<> {
    out.push_back(std::move(image));
    return {};
  };
  EXPECT_TRUE(render_turn(meshes, options, {frames, 1.0}, take));
  return out;
}

TEST(TurningPicture, KeepsTheCameraWhereItIsAndAllOfTheObjectInThePicture) {
  TriangleMesh mesh = *builtin_object("plate");
  for (Vec3f& p : mesh.vertices) p += Vec3f(3.0f, -2.0f, 1.0f);
  int widest = 0, narrowest = 1000, tallest = 0, lowest = 1000;
  for (const ColorImage& image : turn_of({mesh}, small(), 8)) {
    const Extent e = extent_of(image);
    EXPECT_GT(e.left, 0);
    EXPECT_LT(e.right, 119);
    EXPECT_GT(e.top, 0);
    EXPECT_LT(e.bottom, 99);
    widest = std::max(widest, e.right - e.left);
    narrowest = std::min(narrowest, e.right - e.left);
    tallest = std::max(tallest, e.bottom - e.top);
    lowest = std::min(lowest, e.bottom - e.top);
  }
  EXPECT_GT(widest, 3 * narrowest);  // from its edge
  EXPECT_LT(tallest, lowest * 1.3);  // which a camera that came nearer would fill the picture with
}

TEST(TurningPicture, TurnsCounterClockwiseSeenFromAbove) {
  PictureOptions o = small();
  o.azimuth_rad = 0.0;
  // What is in front, towards +Z, goes to the right.
  const TriangleMesh body = test::sphere_mesh({0, 0, 0}, 0.3, 12);
  TriangleMesh mark = test::sphere_mesh({0, 0.0, 0.4}, 0.1, 12);
  mark.colors.assign(mark.vertices.size(), Rgb{200, 0, 0});
  std::vector<double> columns;
  for (const ColorImage& image : turn_of({body, mark}, o, 6)) {
    double sum = 0.0, n = 0.0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const Rgb c = image.at(x, y);
        if (c.r > 2 * c.g + 20) sum += x, n += 1.0;
      }
    columns.push_back(n > 0.0 ? sum / n : 0.0);
  }
  EXPECT_NEAR(columns[0], 60.0, 2.0);
  EXPECT_GT(columns[1], columns[0] + 5.0);
  EXPECT_LT(columns[5], columns[0] - 5.0);
}

TEST(TurningPicture, EndsWhenItsTakerFails) {
  int taken = 0;
  const auto take = [&](const ColorImage&) -> Result<> {
    if (++taken == 2) return fail(ErrorCode::kIo, "full");
    return {};
  };
  const auto done = render_turn({}, small(), {8, 1.0}, take);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::kIo);
  EXPECT_EQ(taken, 2);
  PictureOptions two = small();
  two.views = 2;
  EXPECT_EQ(render_turn({}, two, {8, 1.0}, take).error().code, ErrorCode::kInvalidOption);
}

TEST(Picture, LooksAtTheFrontFromAzimuthZero) {
  TriangleMesh box = test::box_mesh({-1, -1, -1}, {1, 1, 1});
  PictureOptions o = small();
  o.azimuth_rad = 0.0;
  o.elevation_rad = 0.0;
  // Left of the picture is -X.
  for (std::size_t i = 0; i < 8; ++i)
    box.colors.push_back(box.vertices[i].x() < 0 ? Rgb{0, 0, 255} : Rgb{0, 255, 0});
  const ColorImage image = picture_of({box}, o);
  const Rgb left = image.at(20, 50), right = image.at(100, 50);
  EXPECT_GT(left.b, left.g);
  EXPECT_GT(right.g, right.b);
}

TEST(Picture, OfNothingIsTheBackground) {
  PictureOptions o = small();
  o.background = {9, 8, 7};
  for (const auto& meshes : {std::vector<TriangleMesh>{}, std::vector<TriangleMesh>(2)}) {
    const ColorImage image = picture_of(meshes, o);
    ASSERT_EQ(image.pixels.size(), 12000u);
    for (const Rgb& c : image.pixels) ASSERT_EQ(c, (Rgb{9, 8, 7}));
  }
}

TEST(Picture, ShowsTheInsideOfAMeshInRed) {
  TriangleMesh mesh = test::sphere_mesh(Vec3d::Zero(), 0.1, 20);
  const Rgb outside = picture_of({mesh}, small()).at(60, 50);
  EXPECT_LT(outside.r, 1.3 * outside.g);
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  const Rgb inside = picture_of({mesh}, small()).at(60, 50);
  EXPECT_GT(inside.r, 2.0 * inside.g);
}

TEST(Picture, DarkensTheGroundBesideAnObject) {
  PictureOptions o = small();
  o.ground = true;
  const ColorImage image = picture_of({test::box_mesh({-1, 0, -1}, {1, 1, 1})}, o);
  std::size_t grey = 0;
  for (const Rgb& c : image.pixels) grey += c.r == c.g && c.g == c.b && c.r < 230 ? 1 : 0;
  EXPECT_GT(grey, 100u);
}

TEST(Picture, SmoothsFacetsButNotEdges) {
  const auto tones = [](const TriangleMesh& mesh, bool smooth) {
    PictureOptions o = small();
    o.ambient_samples = 0;
    o.smooth = smooth;
    std::vector<int> reds;
    for (const Rgb& c : picture_of({mesh}, o).pixels) reds.push_back(c.r);
    std::sort(reds.begin(), reds.end());
    reds.erase(std::unique(reds.begin(), reds.end()), reds.end());
    return reds;
  };
  const TriangleMesh coarse_ball = test::sphere_mesh(Vec3d::Zero(), 0.1, 8);
  EXPECT_NE(tones(coarse_ball, true), tones(coarse_ball, false));
  const TriangleMesh box = test::box_mesh({-1, -1, -1}, {1, 1, 1});
  EXPECT_EQ(tones(box, true), tones(box, false));
}

TEST(Picture, IsTheSameForEveryNumberOfThreads) {
  PictureOptions o = small();
  o.ground = true;
  const TriangleMesh mesh = *builtin_object("letter-a");
  set_thread_count(1);
  const ColorImage one = picture_of({mesh}, o);
  set_thread_count(4);
  const ColorImage four = picture_of({mesh}, o);
  set_thread_count(0);
  EXPECT_EQ(one.pixels, four.pixels);
}

TEST(Picture, CanBeCancelled) {
  const TriangleMesh mesh = *builtin_object("letter-a");
  RunContext context;
  context.cancel();
  const auto image = render_picture({&mesh, 1}, small(), context);
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().code, ErrorCode::kCancelled);
}

TEST(Picture, RefusesSizesOutsideTheirRange) {
  PictureOptions o = small();
  o.width = 0;
  const auto image = render_picture({}, o);
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().code, ErrorCode::kInvalidOption);
}

TEST(SideBySide, PutsImagesInARowAndFillsTheRest) {
  const std::vector<ColorImage> images{ColorImage(2, 1, {1, 1, 1}), ColorImage(1, 2, {2, 2, 2})};
  const ColorImage row = side_by_side(images, {3, 3, 3});
  ASSERT_EQ(row.width, 3);
  ASSERT_EQ(row.height, 2);
  EXPECT_EQ(row.at(1, 0), (Rgb{1, 1, 1}));
  EXPECT_EQ(row.at(1, 1), (Rgb{3, 3, 3}));
  EXPECT_EQ(row.at(2, 1), (Rgb{2, 2, 2}));
}

}  // namespace
}  // namespace turnscan
