#include <turnscan/core/process/process_setup.hpp>

#include "cli/commands.hpp"
#include "cli/program.hpp"

namespace {

int run(int argc, char** argv) {
  using namespace turnscan::cli;
  Program program;
  program.add("import", "Make a recording from range scans or depth images of another program",
              "docs/how-to/import.md", make_import_command());
  program.add("info", "Say what a recording, mesh or point cloud holds",
              "docs/reference/command-line.md", make_info_command());
  program.add("capture", "Record what a sensor sees of the turning table",
              "docs/reference/capture.md", make_capture_command());
  program.add("scan", "Make a mesh of what stands on the turning table, in one go",
              "docs/tutorials/kinect.md", make_scan_command());
#ifdef TURNSCAN_WITH_SERVE
  program.add("serve", "Serve a page for a phone beside the turntable, and its interface",
              "docs/how-to/serve.md", make_serve_command());
#endif
  program.add("turntable", "Turn the table by its motor", "docs/how-to/motor.md",
              make_turntable_command());
  program.add("calibrate", "Find where the turntable stands and how it turns",
              "docs/how-to/calibrate.md", make_calibrate_command());
  program.add("reconstruct", "Make a watertight mesh of each object in a recording",
              "docs/tutorials/bear.md", make_reconstruct_command());
  program.add("evaluate", "Measure how far a mesh is from a reference", "docs/how-to/inspect.md",
              make_evaluate_command());
  program.add("report", "Make a report of a scan, as a page in one file", "docs/how-to/report.md",
              make_report_command());
  program.add("render", "Draw a picture of meshes or clouds", "docs/reference/command-line.md",
              make_render_command());
  program.add("export", "Write images and their poses for COLMAP, nerfstudio and others",
              "docs/reference/exporting.md", make_export_command());
  program.add("devices", "List the sensors that frames can come from",
              "docs/how-to/connect-a-sensor.md", make_devices_command());
  program.add("simulate", "Record an object with virtual scanners", "docs/reference/simulator.md",
              make_simulate_command());
  program.add("demo", "Record a built-in object with a virtual camera, reconstruct and judge it",
              "docs/tutorials/first-scan.md", make_demo_command());
  program.add("plan", "Find where to put sensors, and how many passes to make",
              "docs/tutorials/plan-a-rig.md", make_plan_command());
  program.add("batch", "Reconstruct or simulate many inputs, here or on a cluster",
              "docs/how-to/many-scans.md", make_batch_command());
  program.add_reference();
  return program.run(argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  turnscan::process::set_up_process();
  return turnscan::cli::run_guarded(run, argc, argv);
}
