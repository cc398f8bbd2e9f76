#include <turnscan/api/calibrate.hpp>
#include <turnscan/api/named_options.hpp>
#include <turnscan/workflow/calibration/calibrate_run.hpp>

namespace turnscan {

namespace {

constexpr const char* kCameraFolder = "iai-kinect2";

struct NamedCalibration {
  CalibrateRequest request;
  bool detect = false, from_motion = false;
};

OptionTable describe(NamedCalibration& named) {
  CalibrateRequest& request = named.request;
  OptionTable table;
  table.flag("detect", named.detect, "Fit the platter's surface and rim in the averaged frames")
      .flag("from-motion", named.from_motion,
            "Determine axis, speed and angles from the motion of the object")
      .text("points", request.points, "File of points picked on the platter's rim (.csv)")
      .flag("depth-bias", request.depth_bias,
            "First determine the offset of each sensor's depth, from platter-radius or gauge-ball")
      .text("depth-also", request.depth_also,
            "With depth-bias: a recording of the same at another distance, for the scale of depth");
  table.append(describe(request.average))
      .append(describe(request.detect))
      .append(describe(request.ball))
      .append(describe(request.motion));
  return table;
}

}  // namespace

Result<Calibration> calibrate(const FrameSequence& frames, const Options& options,
                              const RunContext& context) {
  NamedCalibration named;
  Options fields = options;
  named.request.iai_folders = api::take(fields, kCameraFolder);
  TURNSCAN_TRY(api::set_fields(describe(named), fields));
  TURNSCAN_ASSIGN(named.request.way,
                  calibration_way(!named.request.points.empty(), named.detect, named.from_motion));
  return run_calibration(frames, named.request, context);
}

std::vector<OptionDescription> calibrate_options() {
  NamedCalibration named;
  return api::describe_fields(
      describe(named),
      {{kCameraFolder,
        "Folder of a Kinect v2 calibration by iai_kinect2; one for each sensor, in their order"}});
}

}  // namespace turnscan
