#include "commands/capture_arguments.hpp"

#include <algorithm>
#include <turnscan/capture/source/source_uri.hpp>

#include <turnscan/workflow/text/capture_text.hpp>
#include "cli/command_line.hpp"

namespace turnscan::cli {

namespace {

constexpr std::uint64_t kSteps = 1000;  // of the phase "record"

OptionTable describe_speed(CaptureSetup& setup) {
  OptionTable table;
  table.number("speed", setup.options.speed_rad_s, Quantity::kAngularSpeed, {-100.0, 100.0},
               "Speed of the table: sets the motor (10deg/s unless given), or serves to count "
               "turns. auto: from the frames' angles, the calibration or the motion");
  return table;
}

}  // namespace

void declare_capture(CommandLine& line, CaptureSetup& setup) {
  line.option("--turntable", "FILE.json", setup.turntable_file,
              "Calibration of the turntable: a file saved by turnscan calibrate");
  line.option("--motor", "PORT", setup.motor_port,
              "Turn the table with the motor controller at this serial port, e.g. /dev/ttyUSB0, or "
              "tcp:HOST:PORT (see docs/reference/motor.md)");
  line.allow_config();
  line.group("stops", "Recording at stops, with --motor", describe(setup.options.stops));
  line.group("recorder", "Recorder", describe(setup.options.recorder));
  line.group("motor", "Motor", describe(setup.motor));
}

void declare_scan(CommandLine& line, ScanRequest& request, bool& no_wait) {
  line.flag("--no-wait", no_wait, "Do not wait until something stands on the platter");
  line.flag("--allow-open", request.allow_open, "Write meshes that are not watertight, too");
  declare_capture(line, request.setup);
}

void declare_table(CommandLine& line, CaptureSetup& setup) {
  line.group("table", "Turntable", describe_speed(setup));
  line.group("crop", "Crop", describe(setup.options.crop));
}

std::vector<std::string> with_replayed(const std::vector<std::string>& devices,
                                       const std::string& file) {
  std::vector<std::string> files{file};
  for (const std::string& device : devices) {
    const auto uri = parse_source_uri(device);
    if (uri && uri->scheme == "replay") files.push_back(uri->address);
  }
  return files;
}

std::function<void(const CaptureProgress&)> progress_in(Session& session) {
  return [&session, done = std::uint64_t(0)](const CaptureProgress& progress) mutable {
    session.status().set(progress_text(progress));
    const auto steps = static_cast<std::uint64_t>(progress.fraction * double(kSteps));
    if (steps > done) session.context().advance(steps - done);
    done = std::max(done, steps);
  };
}

}  // namespace turnscan::cli
