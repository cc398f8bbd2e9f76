#include <algorithm>
#include <functional>
#include <map>
#include <turnscan/core/median.hpp>
#include <turnscan/workflow/verdict/frame_agreement.hpp>

namespace turnscan {

namespace {

constexpr double kApart_m = 0.001, kApartRatio = 4.0, kMax = 0.95;
constexpr std::size_t kNamed = 3;

using Motion = Eigen::Vector4d;

Motion motion_of(const FrameResidual& r) {
  Motion out;
  out << r.shift_m, r.turn_m;
  return out;
}

bool same_source(const FrameResidual& a, const FrameResidual& b) {
  return a.sensor == b.sensor && a.pass == b.pass;
}

std::optional<double> median_of(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  return median(values);
}

/// The next frame of the same sensor and pass for each frame; its own position if there is none.
std::vector<std::size_t> next_of_each(const std::vector<FrameResidual>& residuals) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> last;
  std::vector<std::size_t> next(residuals.size());
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    next[i] = i;
    const auto key = std::pair(residuals[i].sensor, residuals[i].pass);
    if (const auto before = last.find(key); before != last.end()) next[before->second] = i;
    last[key] = i;
  }
  return next;
}

/// For frames that view from the same direction as an earlier one of the same sensor and pass, with
/// more than half a turn in between.
std::optional<double> turn_apart(const std::vector<FrameResidual>& residuals,
                                 const std::vector<std::size_t>& next) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    double farthest = 0.0, step = 0.0;
    for (std::size_t j = i; next[j] != j; j = next[j]) {
      const FrameResidual &a = residuals[j], &b = residuals[next[j]];
      step = std::max(step, (a.seen_from - b.seen_from).norm());
      const double away = (b.seen_from - residuals[i].seen_from).norm();
      farthest = std::max(farthest, away);
      if (away > 0.5 * step || !(farthest > 4.0 * step)) continue;
      differences.push_back((motion_of(residuals[i]) - motion_of(b)).norm());
      break;
    }
  }
  return median_of(std::move(differences));
}

/// Difference between the two groups whose medians differ most.
std::optional<double> groups_apart(
    const std::vector<FrameResidual>& residuals,
    const std::function<std::uint32_t(const FrameResidual&)>& group_of) {
  std::map<std::uint32_t, std::vector<Motion>> groups;
  for (const FrameResidual& r : residuals) groups[group_of(r)].push_back(motion_of(r));
  if (groups.size() < 2) return std::nullopt;
  std::vector<Motion> middles;
  for (const auto& [number, motions] : groups) {
    Motion middle;
    for (int k = 0; k < 4; ++k) {
      std::vector<double> values;
      for (const Motion& m : motions) values.push_back(m[k]);
      middle[k] = median(values);
    }
    middles.push_back(middle);
  }
  double most = 0.0;
  for (const Motion& a : middles)
    for (const Motion& b : middles) most = std::max(most, (a - b).norm());
  return most;
}

std::vector<FramesApart> frames_apart(const std::vector<FrameResidual>& residuals, double usual_m) {
  std::vector<FramesApart> out;
  const double limit = std::max(kApart_m, kApartRatio * usual_m);
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const double off = residuals[i].off_m();
    if (!(off > std::max(limit, residuals[i].spread_m))) continue;
    if (!out.empty() && out.back().last + 1 == i && same_source(residuals[i - 1], residuals[i])) {
      out.back().last = i;
      out.back().off_m = std::max(out.back().off_m, off);
    } else {
      out.push_back({i, i, off});
    }
  }
  return out;
}

}  // namespace

FrameAgreement frame_agreement(const std::vector<FrameResidual>& residuals) {
  FrameAgreement out;
  out.frames = residuals.size();
  if (residuals.empty()) return out;
  std::vector<double> off, spread, steps;
  for (const FrameResidual& r : residuals) {
    off.push_back(r.off_m());
    spread.push_back(r.spread_m);
  }
  std::sort(off.begin(), off.end());
  out.most_m = off[std::size_t(kMax * double(off.size() - 1))];
  out.usual_m = median(off);
  out.spread_m = median(spread);
  const auto next = next_of_each(residuals);
  for (std::size_t i = 0; i < residuals.size(); ++i)
    if (next[i] != i)
      steps.push_back((motion_of(residuals[i]) - motion_of(residuals[next[i]])).norm());
  out.neighbours_m = median_of(std::move(steps));
  out.turn_apart_m = turn_apart(residuals, next);
  out.sensors_m = groups_apart(residuals, [](const FrameResidual& r) { return r.sensor; });
  out.passes_m = groups_apart(residuals, [](const FrameResidual& r) { return r.pass; });
  out.apart = frames_apart(residuals, out.usual_m);
  return out;
}

std::string frames_apart_text(const FrameAgreement& agreement,
                              const std::vector<FrameResidual>& residuals) {
  std::vector<FramesApart> largest = agreement.apart;
  std::stable_sort(largest.begin(), largest.end(),
                   [](const FramesApart& a, const FramesApart& b) { return a.off_m > b.off_m; });
  largest.resize(std::min(largest.size(), kNamed));
  std::sort(largest.begin(), largest.end(),
            [](const FramesApart& a, const FramesApart& b) { return a.first < b.first; });
  std::vector<std::string> texts;
  for (const FramesApart& apart : largest) {
    const FrameResidual &a = residuals[apart.first], &b = residuals[apart.last];
    const bool one = apart.first == apart.last;
    const std::string when = !std::isfinite(a.time_s) ? ""
                             : one                    ? fmt::format(" at {:.1f} s", a.time_s)
                                   : fmt::format(" at {:.1f} to {:.1f} s", a.time_s, b.time_s);
    texts.push_back(one ? fmt::format("frame {}{} ({:.1f} mm)", a.frame, when, apart.off_m * 1e3)
                        : fmt::format("frames {} to {}{} ({:.1f} mm)", a.frame, b.frame, when,
                                      apart.off_m * 1e3));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace turnscan
