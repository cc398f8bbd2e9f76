#pragma once
// What a page takes from a report's JSON. Reports come from files: everything in them is checked.

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

/// How frames fit the mesh, one value a frame in each column.
struct FrameColumns {
  std::vector<double> frame, off_mm, spread_mm;
};

struct ReportedObject {
  std::optional<Verdict> verdict;
  std::vector<std::string> notes;
  /// expected_error_m, seen_by, invented: one number a vertex.
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
  std::vector<std::pair<std::string, double>> seconds;  ///< of each stage, longest first
  std::string options;  ///< all options as they were given, as JSON text; empty: not known
  std::vector<ReportedObject> objects;
};

/// Of report_json() or of a scan's report; of an empty text nothing. Fields that are missing or of
/// another type are left out. Fails with kFormat when the text is no JSON object, or nested deeper
/// than text::kMaxJsonDepth.
Result<ReportFacts> facts_of(const std::string& report);

}  // namespace turnscan::page
