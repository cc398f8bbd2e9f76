#pragma once
// The virtual doll through libfreenect's own stand-in for the hardware.

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>
#include <turnscan/capture/source/frame_source.hpp>
#include <vector>

#include "tests/capture/fakenect_dump.hpp"
#include "tests/capture/taking.hpp"
#include "tests/support/temp_folder.hpp"

#ifdef TURNSCAN_FAKENECT

namespace turnscan::testing {

/// fakenect in place of libfreenect, for the rest of the process: the loader takes the library that
/// is there already under that name.
inline bool load_fakenect() {
  static void* library = dlopen(TURNSCAN_FAKENECT, RTLD_NOW | RTLD_GLOBAL);
  return library != nullptr;
}

inline constexpr std::uint32_t kFakenectFrames = 24;

/// The doll as a virtual Kinect sees it, and as it comes through libfreenect. Played once, because
/// fakenect goes through one dump in the life of a process.
struct FakenectDoll : ::testing::Test {
  static void SetUpTestSuite() {
    ASSERT_TRUE(load_fakenect()) << dlerror();
    const TempFolder folder;
    const auto sensor =
        opened("virtual:doll?frames=24&turns=1&fps=30&distance=1m&calibration=true&sensor=" +
               kinect_v1_file(folder.path()).string());
    ASSERT_TRUE(sensor);
    rig = sensor->info();
    direct = run(*sensor).frames;
    DumpWriter dump(folder / "dump");
    // The clock of 32 bits runs over between the frames.
    for (std::uint32_t i = 0; i < kFakenectFrames; ++i)
      dump.add(direct[i].depth, 0xffffff00U + 2000000U * i);
    const Variable path("FAKENECT_PATH", (folder / "dump").string());
    const auto source = opened("freenect:0");
    ASSERT_TRUE(source);
    kinect = source->info();
    ASSERT_TRUE(source->start());
    taken = take_all(*source, kFakenectFrames).frames;
    if (const auto gone = source->next(20.0, {}); !gone) ending = gone.error();
  }
  static inline SourceInfo rig, kinect;
  static inline std::vector<Frame> direct, taken;
  static inline std::optional<Error> ending;
};

}  // namespace turnscan::testing

#endif
