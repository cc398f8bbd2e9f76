#pragma once
// Passes that are joined, as one.

#include <span>
#include <turnscan/reconstruction/passes/prepared_pass.hpp>

namespace turnscan::passes {

class MergedPass {
 public:
  /// The surface of all, each part of it once, and what any of them saw to be empty, in the frame
  /// that T_here_pass leads to; one motion a pass.
  MergedPass(std::span<const PreparedPass* const> passes, std::span<const Pose> T_here_pass);

  const PreparedPass& prepared() const { return *prepared_; }

 private:
  void add(const PreparedPass& pass, const Pose& T_here_pass);

  std::unique_ptr<PassSurface> surface_;
  std::unique_ptr<PreparedPass> prepared_;
};

}  // namespace turnscan::passes
