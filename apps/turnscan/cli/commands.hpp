#pragma once

#include <memory>

#include "cli/command.hpp"

namespace turnscan::cli {

std::unique_ptr<Command> make_import_command();
std::unique_ptr<Command> make_info_command();
std::unique_ptr<Command> make_calibrate_command();
std::unique_ptr<Command> make_reconstruct_command();
std::unique_ptr<Command> make_evaluate_command();
std::unique_ptr<Command> make_report_command();
std::unique_ptr<Command> make_export_command();
std::unique_ptr<Command> make_render_command();
std::unique_ptr<Command> make_simulate_command();
std::unique_ptr<Command> make_demo_command();
std::unique_ptr<Command> make_devices_command();
std::unique_ptr<Command> make_capture_command();
std::unique_ptr<Command> make_scan_command();
std::unique_ptr<Command> make_serve_command();
std::unique_ptr<Command> make_turntable_command();
std::unique_ptr<Command> make_batch_command();
std::unique_ptr<Command> make_plan_command();

}  // namespace turnscan::cli
