#include <turnscan/io/image/image_io.hpp>
#include <turnscan/simulator/rendering/picture.hpp>

#include <turnscan/workflow/cloud_cubes.hpp>
#include <turnscan/workflow/output_file.hpp>
#include <turnscan/workflow/turning_picture.hpp>
#include "cli/command_line.hpp"
#include "cli/commands.hpp"

namespace turnscan::cli {

namespace {

class RenderCommand : public Command {
 public:
  void declare(CommandLine& line) override {
    line.positionals("MESH...", meshes_,
                     "Meshes to show; or point clouds, as cubes coloured by their counts: the "
                     "stages voxels and sub-voxels of reconstruct --save-stage as their cells");
    line.option("-o,--out", "PICTURE.png", out_, "Picture to write");
    line.option("--turntable", "FILE.mp4|.png", turning_,
                "Write an animation of the turning meshes: .png, which browsers show, or .mp4, "
                "which needs the program ffmpeg");
    line.flag("--side-by-side", side_by_side_, "Show each mesh in a picture of its own, in a row");
    line.allow_config();
    line.group("picture", "Picture", describe(options_));
    line.group(
        "cloud", "Point clouds",
        OptionTable().number("min-points", min_points_, {0, 1e9},
                             "Show only cells in which at least so many points were counted"));
    line.group("turn", "Animation, with --turntable", describe(turn_));
    line.common({"out", "turntable", "side-by-side", "min-points", "picture-width",
                 "picture-height", "picture-azimuth", "picture-elevation", "picture-views",
                 "picture-zoom", "picture-colours", "picture-ground"});
  }

  FileRoles files() const override { return {meshes_, {out_, turning_}}; }

  Result<> run(Session& session) override {
    TURNSCAN_TRY(check(session.context()));
    session.plan(phases());
    std::vector<TriangleMesh> meshes;
    for (const std::string& path : meshes_) {
      TURNSCAN_ASSIGN(TriangleMesh mesh, read_shown(path, min_points_, session.context()));
      meshes.push_back(std::move(mesh));
    }
    if (!out_.empty()) {
      TURNSCAN_ASSIGN(const ColorImage picture, draw(meshes, session.context()));
      TURNSCAN_TRY(write_color_png(out_, picture));
      session.print("Wrote {}\n", out_);
    }
    if (!turning_.empty()) {
      TURNSCAN_TRY(write_turning_picture(turning_, meshes, options_, turn_, session.context()));
      session.print("Wrote {}\n", turning_);
    }
    return {};
  }

 private:
  PhasePlan phases() const {
    const std::size_t pictures = out_.empty() ? 0 : side_by_side_ ? meshes_.size() : 1;
    PhasePlan plan(pictures, {"render picture", 1.0});
    if (!turning_.empty()) plan.push_back({"render turn", double(turn_.frames)});
    return plan;
  }

  Result<> check(const RunContext& context) const {
    if (out_.empty() && turning_.empty())
      return fail(ErrorCode::kInvalidOption,
                  "there is nothing to write; give -o PICTURE.png, --turntable FILE or both");
    TURNSCAN_TRY(check_output_file(out_, ".png"));
    if (turning_.empty()) return {};
    if (side_by_side_ || options_.views != 1)
      return fail(ErrorCode::kInvalidOption,
                  "an animation has one view; leave --side-by-side and --picture-views out, or "
                  "--turntable");
    return check_turning_picture(turning_, context);
  }

  Result<ColorImage> draw(const std::vector<TriangleMesh>& meshes,
                          const RunContext& context) const {
    if (!side_by_side_) return render_picture(meshes, options_, context);
    std::vector<ColorImage> pictures;
    for (const TriangleMesh& mesh : meshes) {
      TURNSCAN_ASSIGN(ColorImage picture, render_picture(std::span(&mesh, 1), options_, context));
      pictures.push_back(std::move(picture));
    }
    return turnscan::side_by_side(pictures, options_.background);
  }

  std::vector<std::string> meshes_;
  std::string out_, turning_;
  int min_points_ = 0;
  bool side_by_side_ = false;
  PictureOptions options_;
  TurnOptions turn_;
};

}  // namespace

std::unique_ptr<Command> make_render_command() { return std::make_unique<RenderCommand>(); }

}  // namespace turnscan::cli
