#include <cstdlib>
#include <turnscan/core/angles.hpp>
#include <turnscan/sensors/scanner_file.hpp>

#include "tests/simulator/shapes.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using testing::TempFolder;

constexpr const char* kGood =
    "near = '0.3m'\nfar = '2m'\ncolumns = 64\nrows = 48\nvertical-fov = '50deg'\n";

std::string refusal(const TempFolder& folder, const std::string& text) {
  const auto model = read_scanner(folder.put("own.toml", text));
  EXPECT_FALSE(model) << text;
  return model ? "" : model.error().text();
}

TEST(ScannerFile, ReadsEveryPreset) {
  const std::vector<std::string> names = scanner_presets();
  EXPECT_EQ(names,
            (std::vector<std::string>{"azure-kinect", "gocator", "ideal", "iphone-lidar",
                                      "iphone-truedepth", "kinect-v1", "kinect-v2", "orbbec-femto",
                                      "realsense-d405", "realsense-d435", "realsense-d455"}));
  for (const std::string& name : names) {
    const auto model = find_scanner(name);
    ASSERT_TRUE(model) << model.error().text();
    EXPECT_EQ(model->name, name);
    EXPECT_EQ(model->two_eyed(), name != "ideal");
  }
}

TEST(ScannerFile, HoldsTheKinectAsMeasured) {
  const ScannerModel model = *find_scanner("kinect-v2");
  EXPECT_EQ(model.camera.width, 512);
  EXPECT_EQ(model.camera.height, 424);
  EXPECT_EQ(model.camera.fx, 365.5);
  EXPECT_EQ(model.camera.cx, 255.5);
  EXPECT_EQ(model.sensing, Sensing::kTimeOfFlight);
  // Fankhauser et al. 2015: 1.5 - 0.5 z + 0.3 z^2 mm.
  for (const double z : {0.8, 2.0})
    EXPECT_NEAR(axial_sigma_m(model.noise, z, 0.0) * 1e3, 1.5 - 0.5 * z + 0.3 * z * z, 1e-6);
}

TEST(ScannerFile, IsWrittenWithOtherValuesAndNothingElseChanged) {
  const TempFolder folder;
  const auto text = scanner_toml("kinect-v2", {{"name", "short"}, {"far", "2m"}, {"bias", "1mm"}});
  ASSERT_TRUE(text) << text.error().text();
  const auto made = read_scanner(folder.put("short.toml", *text));
  ASSERT_TRUE(made) << made.error().text();
  const ScannerModel preset = *find_scanner("kinect-v2");
  EXPECT_EQ(made->name, "short");
  EXPECT_EQ(made->far_m, 2.0);
  EXPECT_EQ(made->noise.bias_m, 0.001);
  EXPECT_EQ(made->near_m, preset.near_m);
  // More digits than are shown.
  EXPECT_EQ(made->noise.axial_constant_m, preset.noise.axial_constant_m);
  EXPECT_FALSE(scanner_toml("kinect-v2", {{"near", "9m"}}));
  EXPECT_FALSE(scanner_toml("kinect-v2", {{"distance", "9m"}}));
}

TEST(ScannerFile, HoldsTheKinectV1AsPublished) {
  const ScannerModel model = *find_scanner("kinect-v1");
  // Nguyen, Izadi, Lovell 2012.
  EXPECT_NEAR(axial_sigma_m(model.noise, 1.4, 0.5), 0.0012 + 0.0019, 1e-9);
  EXPECT_NEAR(model.emitter_m.x(), 0.075, 1e-12);
}

TEST(ScannerFile, HoldsALineScannerThatSeesWhatItsDataSheetSays) {
  const ScannerModel model = *find_scanner("gocator");
  EXPECT_EQ(model.kind, ScannerKind::kLine);
  const double slope = -model.camera.ray(0, -0.5).y();
  EXPECT_NEAR(2.0 * slope * model.near_m, 0.158, 0.001);
  EXPECT_NEAR(2.0 * slope * model.far_m, 0.365, 0.005);
}

TEST(ScannerFile, TakesACopyThatSomebodyChanged) {
  const TempFolder folder;
  const auto model = find_scanner(
      folder.put("own.toml", std::string(kGood) + "k1 = 0.1\n[noise]\nbias = '-20mm'\n").string());
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->name, "own");
  EXPECT_EQ(model->near_m, 0.3);
  EXPECT_EQ(model->camera.distortion[0], 0.1);
  EXPECT_NEAR(model->camera.fy, 24.0 / std::tan(25.0 * kRadiansPerDegree), 1e-9);
  EXPECT_DOUBLE_EQ(model->noise.bias_m, -0.02);
}

TEST(ScannerFile, NamesFileAndLineOfWhatItCannotUse) {
  const TempFolder folder;
  std::string says = refusal(folder, std::string(kGood) + "colour = 1\n");
  EXPECT_NE(says.find("own.toml:6: "), std::string::npos) << says;
  EXPECT_NE(says.find("colour"), std::string::npos) << says;
  says = refusal(folder, std::string(kGood) + "baseline = 80\n");
  EXPECT_NE(says.find("own.toml:6: baseline"), std::string::npos) << says;
  says = refusal(folder, std::string(kGood) + "kind = ['line']\n");
  EXPECT_NE(says.find("own.toml:6: kind"), std::string::npos) << says;
  says = refusal(folder, std::string(kGood) + "[noise]\nhum = 1\n");
  EXPECT_NE(says.find("own.toml:7: "), std::string::npos) << says;
  says = refusal(folder, "noise = 3\n");
  EXPECT_NE(says.find("own.toml:1: noise"), std::string::npos) << says;
  says = refusal(folder, "near = = 2\n");
  EXPECT_NE(says.find("own.toml:1: not TOML"), std::string::npos) << says;
}

TEST(ScannerFile, NamesTheFileWhenTheScannerCannotBe) {
  const TempFolder folder;
  std::string says = refusal(folder, "near = '3m'\nfar = '2m'\nrows = 4\ncolumns = 4\nfy = 3\n");
  EXPECT_NE(says.find("own.toml"), std::string::npos) << says;
  EXPECT_NE(says.find("near = 3000mm is not below far = 2000mm"), std::string::npos) << says;
  says = refusal(folder, "");
  EXPECT_NE(says.find("0 x 0 samples"), std::string::npos) << says;
}

TEST(ScannerFile, RefusesWhatIsNoSuchFile) {
  const TempFolder folder;
  EXPECT_EQ(read_scanner(folder / "none.toml").error().code, ErrorCode::kNotFound);
  EXPECT_EQ(read_scanner(folder.path()).error().code, ErrorCode::kInvalidOption);
  EXPECT_EQ(read_scanner(folder.put("big.toml", std::string((1u << 20u) + 1, '#'))).error().code,
            ErrorCode::kInvalidOption);
}

TEST(FindScanner, ListsThePresetsWhenThereIsNoneOfThatName) {
  const auto model = find_scanner("kinect");
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().code, ErrorCode::kNotFound);
  EXPECT_NE(model.error().message.find("kinect-v2"), std::string::npos);
}

TEST(FindScanner, LooksWhereTheVariableSays) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "scanners");
  folder.put("scanners/mine.toml", kGood);
  ASSERT_EQ(::setenv("TURNSCAN_DATA", folder.path().c_str(), 1), 0);
  EXPECT_EQ(scanner_presets(), std::vector<std::string>{"mine"});
  EXPECT_TRUE(find_scanner("mine"));
  ASSERT_EQ(::setenv("TURNSCAN_DATA", (folder / "none").c_str(), 1), 0);
  EXPECT_EQ(find_scanner("mine").error().code, ErrorCode::kNotFound);
  ::unsetenv("TURNSCAN_DATA");
}

}  // namespace
}  // namespace turnscan
