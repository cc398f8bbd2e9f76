#pragma once

#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/tsdf/volume.hpp>

namespace turnscan::tsdf {

/// The harmonic function that continues the known values of a volume, on cells of 4^3 samples (2^3
/// per brick): signs and initial values for unobserved samples. Solved by Gauss-Seidel iteration
/// from coarse to fine.
class HarmonicFill {
 public:
  /// Beyond the volume everything is outside, except under a platter. Unknown cells below one of
  /// the platters of several passes continue the rest, but do not influence it. Fails with
  /// kCancelled.
  static Result<HarmonicFill> solve(const Volume& volume, const VolumeScale& scale,
                                    const RunContext& context);

  /// Value of a cell; beyond the volume that of the nearest one.
  float cell(int i, int j, int k) const;
  /// Trilinear between cell centres, at a sample.
  float at_sample(int i, int j, int k) const;

 private:
  enum class CellState : std::uint8_t { kUnknown, kFixed, kBelowPlatter };
  /// The cells of the finest or of a coarser level.
  struct FillLevel {
    GridIndex cells;
    std::vector<float> value;
    std::vector<CellState> state;

    explicit FillLevel(const GridCoords& size)
        : cells(size), value(cells.count(), 0.0f), state(cells.count(), CellState::kUnknown) {}
    std::size_t at(int i, int j, int k) const { return cells.at({i, j, k}); }
  };

  explicit HarmonicFill(FillLevel finest, float outside, bool on_platter)
      : outside_(outside), on_platter_(on_platter) {
    levels_.push_back(std::move(finest));
  }
  static FillLevel finest_level(const Volume& volume);
  static void mark_below(const Volume& volume, std::span<const Platter> platters, FillLevel& level);
  static FillLevel halved(const FillLevel& fine);
  static void prolong(const FillLevel& coarse, FillLevel& fine);
  void relax(FillLevel& level) const;

  float outside_;
  bool on_platter_;
  std::vector<FillLevel> levels_;  ///< finest first
};

}  // namespace turnscan::tsdf
