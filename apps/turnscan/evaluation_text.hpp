#pragma once

#include <string>
#include <turnscan/core/frame.hpp>
#include <turnscan/evaluation/evaluate.hpp>
#include <turnscan/simulator/scene.hpp>

namespace turnscan::cli {

/// The figures as a table for people, in mm and percent.
std::string evaluation_text(const Evaluation& evaluation);

/// Judges over what the frames of the sequence see of the scene. Refers to its arguments.
SeenTest seen_by(const Scene& scene, const FrameSequence& sequence, const RunContext& context);

}  // namespace turnscan::cli
