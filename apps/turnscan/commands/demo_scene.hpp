#pragma once
// One scene of the demo: a virtual camera records it, the recording is reconstructed, and every
// object is compared with the ground truth.

#include <filesystem>
#include <string>
#include <turnscan/evaluation/evaluate.hpp>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/simulator/virtual_scan.hpp>
#include <turnscan/workflow/progress/overall_progress.hpp>
#include <vector>

namespace turnscan::cli {

/// One scanner in front of one turntable.
struct DemoScanOptions {
  DemoScanOptions();
  std::string scanner = "kinect-v2";
  ScannerPlacement placement;
  MotionOptions motion;
  PlatterOptions platter;
  MeasureOptions measure;
  bool color = false;
};

OptionTable describe(DemoScanOptions& options);

struct DemoSceneOptions {
  DemoScanOptions scan;
  ReconstructOptions reconstruct;
  EvaluateOptions evaluate;
  int picture_size_px = 560;  ///< of each of the picture's three views
};

struct DemoFigures {
  std::string scene;
  std::string object;
  std::size_t frames = 0;
  MeshReport check;
  Evaluation evaluation;
  double f_at_1mm = 0.0;
  double seconds = 0.0;  ///< for the scene, from the first frame to the mesh
};

/// Expands "all" to every scene. Fails with kInvalidOption for an unknown name.
Result<std::vector<std::string>> scene_names(const std::string& object);

/// Phases of run_demo_scene().
PhasePlan demo_phases(const std::string& name, const DemoSceneOptions& options);

/// Writes into `folder`: recording/, per object OBJECT.ply, OBJECT.stl, OBJECT-reference.ply,
/// OBJECT-errors.ply and OBJECT.png (reference, reconstruction, errors), report.json. Reconstructed
/// pieces are assigned to the nearest reference.
Result<std::vector<DemoFigures>> run_demo_scene(const std::string& name,
                                                const std::filesystem::path& folder,
                                                const DemoSceneOptions& options,
                                                const RunContext& context);

}  // namespace turnscan::cli
