#pragma once
// The levels of the Poisson solver, from coarse to fine.

#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/poisson/poisson_samples.hpp>

namespace turnscan::poisson {

/// The indicator on the faces of the cube: half its step from inside to outside, which is 1. Fields
/// hold the indicator minus this.
inline constexpr double kOutside = 0.5;

struct VectorField {
  Field x, y, z;
  void assign(std::size_t cells) {
    for (Field* f : {&x, &y, &z}) f->assign(cells, 0.0f);
  }
};

struct OctreeLevel {
  explicit OctreeLevel(int depth) : bricks(depth) {}

  SparseBricks bricks;
  /// The bricks that samples of this depth reach come first, and only they are solved; the others
  /// exist because the surface of a coarser level passes through them.
  std::size_t solved = 0;
  VectorField own;      ///< this level's splats, in the bricks that are solved
  Field load;           ///< of these and of all finer levels, also in the solved bricks
  VectorField normals;  ///< own plus those of coarser levels, in all bricks; not for the finest
                        ///< level
  Field indicator;      ///< minus kOutside, in all bricks
};

/// Indexed by depth - kCoarsest.
using OctreeLevels = std::vector<OctreeLevel>;

/// A coefficient of the indicator, from coarser levels if this one has none.
float indicator(const OctreeLevels& levels, std::size_t level, int i, int j, int k);

/// The coefficient of the finest cell that contains this cell of the level: fast, and of the right
/// sign away from the surface.
float indicator_near(const OctreeLevels& levels, std::size_t level, int i, int j, int k);

/// Levels kCoarsest to samples.deepest() with the bricks that the samples reach, their splats and
/// loads.
Result<OctreeLevels> make_levels(const OrientedSamples& samples, const RunContext& context);

/// Fills normals and indicator of a level from the coarser one, whose splats and load are released.
/// Returns the residual of that indicator without the contribution of the points.
Field prolong(OctreeLevels& levels, std::size_t level);

/// Solves one level, its coarser ones being solved. Returns the median indicator at the samples.
Result<double> solve_level(OctreeLevels& levels, std::size_t level, const OrientedSamples& samples,
                           double point_weight, const RunContext& context);

/// Adds to the next level the bricks through which this level's surface passes, and those around.
void add_surface_bricks(OctreeLevels& levels, std::size_t level, double iso);

}  // namespace turnscan::poisson
