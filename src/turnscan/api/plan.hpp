#pragma once
// Where to put which sensors: what `turnscan plan` does.

#include <string>
#include <turnscan/api/options.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan {

/// Looks for the placements of sensors, and for the poses of the object, with which a scan covers
/// most of its surface; docs/reference/plan.md describes the model. Returns JSON text, whose fields
/// that page lists: the plans, the one that covers most first.
///
/// objects: mesh files or "builtin:NAME", at least one; what is to be scanned, or stands for it.
/// The options are those of `turnscan plan`. `scanner` is repeatable, and needed at least once:
/// presets or files, each of which the rig may have several times. `out` names a folder for scenes
/// and pictures; without it no files are written, and trials run in this process.
///
/// Fails with kInvalidOption, kNotFound, kFormat (a mesh file), kAlreadyExists (the folder holds
/// something else) and kCancelled.
Result<std::string> plan_rig(const std::vector<std::string>& objects, const Options& options,
                             const RunContext& context = {});

/// The options of plan_rig().
std::vector<OptionDescription> plan_options();

}  // namespace turnscan
