// The mesh of a recording that OpenNI's own recorder has made.

#include <gtest/gtest.h>

#ifdef TURNSCAN_OPENNI2

#include <fmt/format.h>
#include <cmath>
#include <fstream>
#include <numbers>

#include "tests/capture/doll_mesh.hpp"
#include "tests/capture/openni2/recorded_film.hpp"
#include "tests/capture/taking.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using testing::Film;
using testing::opened;
using testing::Taken;
using testing::TempFolder;

Film film_of(const std::vector<Frame>& frames, int fps) {
  Film film;
  film.header.width = frames.at(0).depth.width;
  film.header.height = frames[0].depth.height;
  film.header.fps = fps;
  for (const Frame& frame : frames) film.depth.push_back(frame.depth.pixels);
  return film;
}

/// The camera that OpenNI tells of a sensor with these angles of view, as a file of the simulator.
std::filesystem::path scanner_file(const std::filesystem::path& folder, Film& film) {
  constexpr int kWidth = 192, kHeight = 144;
  film.header.hfov_rad = 0.6F;
  film.header.vfov_rad = 0.46F;
  const auto focal = [](int size, float angle) {
    return 0.5 * size / std::tan(0.5 * static_cast<double>(angle));
  };
  std::filesystem::path file = folder / "small.toml";
  std::ofstream(file) << fmt::format(
      "columns = {}\nrows = {}\nfx = {}\nfy = {}\ncx = {:.1f}\ncy = {:.1f}\nnear = \"0.3m\"\n"
      "far = \"4m\"\n",
      kWidth, kHeight, focal(kWidth, film.header.hfov_rad), focal(kHeight, film.header.vfov_rad),
      0.5 * (kWidth - 1), 0.5 * (kHeight - 1));
  return file;
}

TEST(OpenNi2Mesh, OfTheDollFromAnOniFileIsThatOfTheSameFramesTakenDirectly) {
  constexpr double kSpeed_rad_s = 2.0 * std::numbers::pi / 1.2;  // 30 frames a turn
  const TempFolder folder;
  Film film;
  const auto sensor = opened(
      "virtual:doll?frames=30&turns=1&fps=25&distance=0.7m&calibration=true"
      "&sensor=" +
      scanner_file(folder.path(), film).string());
  ASSERT_TRUE(sensor);
  const Taken direct = testing::run(*sensor);
  ASSERT_EQ(direct.frames.size(), 30u);
  const testing::FilmHeader angles = film.header;
  film = film_of(direct.frames, 25);
  film.header.hfov_rad = angles.hfov_rad;
  film.header.vfov_rad = angles.vfov_rad;
  film.write(folder / "film");
  testing::record_oni(folder / "film", 30, folder / "doll.oni");
  const auto source = opened(testing::uri_of((folder / "doll.oni").string()));
  ASSERT_TRUE(source);
  const Taken played = testing::run(*source);
  ASSERT_EQ(played.frames.size(), 30u);
  const SequenceHeader& rig = sensor->info().header;
  const TriangleMesh mesh = testing::mesh_of(direct.frames, rig.sensors[0], rig, kSpeed_rad_s);
  const TriangleMesh same =
      testing::mesh_of(played.frames, source->info().header.sensors[0], rig, kSpeed_rad_s);
  EXPECT_GT(mesh.triangles.size(), 1000u);
  EXPECT_EQ(same.triangles, mesh.triangles);
  ASSERT_EQ(same.vertices.size(), mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    EXPECT_LT((same.vertices[i] - mesh.vertices[i]).norm(), 1e-6f);
}

}  // namespace
}  // namespace turnscan

#endif
