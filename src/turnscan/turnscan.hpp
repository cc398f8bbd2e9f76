#pragma once
// Everything that turnscan offers to a program. docs/reference/library.md has a table of the
// headers, and examples/ short programs.

#include <turnscan/api/batch.hpp>
#include <turnscan/api/calibrate.hpp>
#include <turnscan/api/evaluate.hpp>
#include <turnscan/api/options.hpp>
#include <turnscan/api/plan.hpp>
#include <turnscan/api/reconstruct.hpp>
#include <turnscan/api/recording.hpp>
#include <turnscan/api/simulate.hpp>
#include <turnscan/api/stream.hpp>
#include <turnscan/capture/source/frame_source.hpp>
#include <turnscan/core/calibration.hpp>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/core/units.hpp>
#include <turnscan/core/version.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/recording/calibration_file.hpp>
#include <turnscan/recording/recording.hpp>
