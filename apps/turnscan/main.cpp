#include <turnscan/core/process/process_setup.hpp>

#include "cli/commands.hpp"
#include "cli/program.hpp"

namespace {

int run(int argc, char** argv) {
  using namespace turnscan::cli;
  Program program;
  program.add("import", "Make a recording from range scans or depth images of another program",
              make_import_command());
  program.add("info", "Say what a recording, mesh or point cloud holds", make_info_command());
  program.add("capture", "Record what a sensor sees of the turning table", make_capture_command());
  program.add("scan", "Make a mesh of what stands on the turning table, in one go",
              make_scan_command());
  program.add("turntable", "Turn the table by its motor", make_turntable_command());
  program.add("calibrate", "Find where the turntable stands and how it turns",
              make_calibrate_command());
  program.add("reconstruct", "Make a watertight mesh of each object in a recording",
              make_reconstruct_command());
  program.add("evaluate", "Measure how far a mesh is from a reference", make_evaluate_command());
  program.add("report", "Make a report of a scan, as a page in one file", make_report_command());
  program.add("render", "Draw a picture of meshes or clouds", make_render_command());
  program.add("export", "Write images and their poses for COLMAP, nerfstudio and others",
              make_export_command());
  program.add("devices", "List the sensors that frames can come from", make_devices_command());
  program.add("simulate", "Record an object with virtual scanners", make_simulate_command());
  program.add("demo", "Record a built-in object with a virtual camera, reconstruct and judge it",
              make_demo_command());
  program.add("plan", "Find where to put sensors, and how many passes to make",
              make_plan_command());
  program.add("batch", "Reconstruct or simulate many inputs, here or on a cluster",
              make_batch_command());
  program.add_reference();
  return program.run(argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  turnscan::process::set_up_process();
  return turnscan::cli::run_guarded(run, argc, argv);
}
