// calibrate RECORDING FILE.json: finds the turntable from the motion of the object, and keeps it
// for `turnscan reconstruct --turntable FILE.json`.

#include <cstdio>
#include <turnscan/turnscan.hpp>

turnscan::Result<> run(const std::string& recording, const std::string& file) {
  TURNSCAN_ASSIGN(const auto opened, turnscan::open_frames(recording));
  TURNSCAN_ASSIGN(const turnscan::Calibration calibration,
                  turnscan::calibrate(*opened.frames, {{"from-motion", "true"}}));
  const turnscan::TurntableInfo& table = calibration.table;
  std::printf("axis    %7.4f %7.4f %7.4f\n", table.axis.x(), table.axis.y(), table.axis.z());
  std::printf("centre  %7.4f %7.4f %7.4f m, standard deviation %.2f mm across the axis\n",
              table.center_m.x(), table.center_m.y(), table.center_m.z(),
              1e3 * calibration.center_sigma_m);
  if (table.speed_rad_s) std::printf("speed   %7.4f rad/s\n", *table.speed_rad_s);
  TURNSCAN_TRY(turnscan::write_calibration(file, calibration));
  std::printf("Wrote %s\n", file.c_str());
  return {};
}

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const auto done = run(argv[1], argv[2]);
  if (!done) std::fprintf(stderr, "%s\n", done.error().text().c_str());
  return done ? 0 : 1;
}
