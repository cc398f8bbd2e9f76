#include <turnscan/core/version.hpp>

#include "serve/routes.hpp"

namespace turnscan::serve {

namespace {

/// What the names of Route::body and Route::answer mean.
constexpr const char* kSchemas = R"json({
  "Error": {"type": "object", "required": ["error"], "properties": {"error": {
    "type": "object", "required": ["code", "message"], "properties": {
      "code": {"type": "string"}, "message": {"type": "string"}}}}},
  "State": {"type": "object", "required": ["job", "operator"], "properties": {
    "operator": {"type": "boolean", "description": "somebody operates the rig"},
    "job": {"oneOf": [{"type": "null"}, {"$ref": "#/components/schemas/Job"}]}}},
  "Job": {"type": "object",
    "required": ["id", "kind", "state", "phase", "fraction", "seconds_left", "frames", "picture",
                 "question", "error", "code", "text", "notes"],
    "properties": {
      "id": {"type": "string", "description": "of the scan"},
      "kind": {"enum": ["scan", "record", "reconstruct"]},
      "state": {"enum": ["running", "asking", "done", "failed", "cancelled"]},
      "phase": {"type": "string"},
      "fraction": {"type": ["number", "null"], "description": "of the whole; null: not known"},
      "seconds_left": {"type": ["number", "null"]},
      "frames": {"type": "integer", "description": "recorded"},
      "picture": {"type": ["integer", "null"], "description": "number of the picture that can be had"},
      "question": {"oneOf": [{"type": "null"}, {"type": "object", "required": ["advice", "pass"],
        "properties": {
          "advice": {"type": "string", "description": "how to lay the object; see also advice.png"},
          "pass": {"type": "integer", "description": "that would follow, counted from 0"}}}]},
      "error": {"type": ["string", "null"],
        "description": "why it failed; of a scan that is done: what did not fit"},
      "code": {"type": ["string", "null"], "description": "of the error"},
      "text": {"type": ["string", "null"], "description": "what was made, for people"},
      "notes": {"type": "array", "items": {"type": "string"}}}},
  "Surface": {"type": "object", "required": ["number", "frames", "model"], "properties": {
    "number": {"type": "integer", "description": "of this mesh; 0: there is none"},
    "frames": {"type": "integer"},
    "model": {"type": ["object", "null"], "description": "as web/packed_model.js unpacks it"}}},
  "Devices": {"type": "object", "required": ["devices"], "properties": {"devices": {
    "type": "array", "items": {"type": "object", "required": ["uri", "model", "kind"],
      "properties": {"uri": {"type": "string"}, "model": {"type": "string"},
        "kind": {"enum": ["given", "sensor", "virtual"]}}}}}},
  "Operator": {"type": "object", "required": ["key", "seconds"], "properties": {
    "key": {"type": "string", "description": "to send as Turnscan-Operator"},
    "seconds": {"type": "integer", "description": "that it is kept after its last use"}}},
  "NewScan": {"type": "object", "required": ["device"], "properties": {
    "device": {"type": "string", "description": "a uri of /api/v1/devices"},
    "passes": {"type": "integer", "minimum": 1, "maximum": 100,
      "description": "left out: the job asks after each pass"},
    "record_only": {"type": "boolean",
      "description": "records one pass and makes no mesh; excludes passes"}}},
  "Started": {"type": "object", "required": ["id"], "properties": {"id": {"type": "string"}}},
  "Answer": {"type": "object", "required": ["another_side"], "properties": {
    "another_side": {"type": "boolean"}}},
  "Scans": {"type": "object", "required": ["scans"], "properties": {"scans": {
    "type": "array", "items": {"type": "object", "required": ["id", "state"], "properties": {
      "id": {"type": "string"}, "state": {"$ref": "#/components/schemas/ScanState"}}}}}},
  "ScanState": {"enum": ["running", "unfinished", "recorded", "done", "damaged"]},
  "Scan": {"type": "object", "required": ["id", "state", "bytes", "files"], "properties": {
    "id": {"type": "string"}, "state": {"$ref": "#/components/schemas/ScanState"},
    "started_at": {"type": ["string", "null"]}, "device": {"type": "string"},
    "frames": {"type": "integer"}, "bytes": {"type": "integer"}, "error": {"type": "string"},
    "files": {"type": "array", "items": {"type": "object", "required": ["name", "bytes", "type"],
      "properties": {"name": {"type": "string"}, "bytes": {"type": "integer"},
        "type": {"type": "string"}}}}}},
  "Files": {"type": "object", "required": ["files"], "properties": {"files": {
    "type": "array", "items": {"type": "object", "required": ["name", "bytes"],
      "properties": {"name": {"type": "string"}, "bytes": {"type": "integer"}}}}}},
  "Verdict": {"type": "object", "required": ["objects", "next_pass"], "properties": {
    "next_pass": {"type": ["object", "null"]},
    "objects": {"type": "array", "items": {"type": "object", "required": ["name", "verdict"],
      "properties": {"name": {"type": ["string", "null"]},
        "verdict": {"type": ["object", "null"], "properties": {
          "colour": {"enum": ["green", "amber", "red"]},
          "sentences": {"type": "array", "items": {"type": "object"}}}}}}}}}
})json";

Json content_of(const std::string& what) {
  if (what.find('/') != std::string::npos) return {{what, Json::object()}};
  return {{"application/json", {{"schema", {{"$ref", "#/components/schemas/" + what}}}}}};
}

Json operation_of(const Route& route) {
  Json out{{"operationId", route.operation}, {"summary", route.summary}};
  out["parameters"] = Json::array();
  for (const char* name : {"id", "folder", "name"})
    if (std::string(route.path).find(fmt::format("{{{}}}", name)) != std::string::npos)
      out["parameters"].push_back(
          {{"name", name}, {"in", "path"}, {"required", true}, {"schema", {{"type", "string"}}}});
  if (*route.query != '\0')
    out["parameters"].push_back(
        {{"name", route.query}, {"in", "query"}, {"schema", {{"type", "string"}}}});
  if (route.of_operator)
    out["parameters"].push_back({{"name", "Turnscan-Operator"},
                                 {"in", "header"},
                                 {"required", true},
                                 {"schema", {{"type", "string"}}}});
  if (*route.body != '\0')
    out["requestBody"] = {{"required", true}, {"content", content_of(route.body)}};
  Json succeeds{{"description", "done"}};
  if (*route.answer != '\0') succeeds["content"] = content_of(route.answer);
  out["responses"] = {
      {std::to_string(route.status), std::move(succeeds)},
      {"default", {{"description", "refused or failed"}, {"content", content_of("Error")}}}};
  return out;
}

}  // namespace

Json openapi() {
  Json out{{"openapi", "3.1.0"}};
  out["info"] = {{"title", "turnscan serve"},
                 {"version", version()},
                 {"license", {{"name", "Apache-2.0"}, {"identifier", "Apache-2.0"}}}};
  out["security"] = Json::array({Json::object(), {{"token", Json::array()}}});
  out["paths"] = Json::object();
  for (const Route& route : routes()) {
    std::string method = route.method;
    for (char& c : method) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    out["paths"][route.path][method] = operation_of(route);
  }
  out["components"] = {{"schemas", Json::parse(kSchemas)},
                       {"securitySchemes", {{"token", {{"type", "http"}, {"scheme", "bearer"}}}}}};
  return out;
}

}  // namespace turnscan::serve
