#pragma once
// The contents of a JSON report that a page shows. Reports come from files, so everything in them
// is validated.

#include <map>
#include <optional>
#include <string>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan::page {

struct VerdictSentence {
  std::string topic, level, text, unit;
  std::optional<double> value;
};
struct Verdict {
  std::string colour;  ///< green, amber or red
  std::vector<VerdictSentence> sentences;
};

/// Fit of the frames to the mesh; each column has one value per frame.
struct FrameColumns {
  std::vector<double> frame, off_mm, spread_mm;
};

struct ReportedObject {
  std::optional<Verdict> verdict;
  std::vector<std::string> notes;
  /// expected_error_m, seen_by, invented: one number per vertex.
  std::map<std::string, std::vector<double>> per_vertex;
  std::optional<FrameColumns> frames;
};

struct Parameter {
  std::string option, value, reason;
};

struct ReportFacts {
  std::string version;
  std::vector<std::pair<std::string, std::string>> figures;  ///< name and value with unit
  std::vector<Parameter> parameters;
  std::vector<std::string> notes;
  std::vector<std::pair<std::string, double>> seconds;  ///< per stage, longest first
  std::string options;  ///< all options as given, as JSON text; empty: not known
  std::vector<ReportedObject> objects;
};

/// Parses the output of report_json() or a scan's report; an empty text gives an empty result.
/// Fields that are missing or of another type are skipped. Fails with kFormat if the text is not a
/// JSON object, or is nested deeper than text::kMaxJsonDepth.
Result<ReportFacts> facts_of(const std::string& report);

}  // namespace turnscan::page
