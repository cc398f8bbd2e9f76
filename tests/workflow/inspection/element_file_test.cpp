#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <turnscan/workflow/inspection/element_file.hpp>
#include <turnscan/workflow/inspection/element_output.hpp>

namespace turnscan::workflow {
namespace {

using testing::HasSubstr;

const std::string kBall = R"({"name": "ball", "type": "sphere", "point_mm": [1, 2, 3],
                             "diameter_mm": 40, "within_mm": 1})";
const std::string kTop = R"({"name": "top", "type": "plane", "point_mm": [0, 9, 0],
                            "direction": [0, 2, 0], "within_mm": 1})";

std::string file(const std::string& elements, const std::string& rest = "") {
  return "{\"elements\": [" + elements + "]" + rest + "}";
}

std::string error_of(const std::string& json) {
  const auto plan = parse_elements(json, RunContext());
  return plan ? "" : plan.error().text();
}

/// The ball with one part of its text replaced.
std::string changed(const std::string& from, const std::string& to) {
  std::string text = kBall;
  return file(text.replace(text.find(from), from.size(), to));
}

TEST(ElementFile, EveryTypeIsReadInMillimetresAndDegrees) {
  const auto plan =
      parse_elements(file(kBall + "," + kTop + R"(,
        {"name": "tip", "type": "cone", "point_mm": [0, 0, 0], "direction": [0, 0, -1],
         "angle_deg": 60, "within_mm": 0.5, "min_mm": [-1, -2, -3], "max_mm": [4, 5, 6]},
        {"name": "rim", "type": "circle", "point_mm": [0, 0, 0], "direction": [0, 1, 0],
         "diameter_mm": 20, "within_mm": 1},
        {"name": "edge", "type": "line", "point_mm": [0, 0, 0], "direction": [1, 0, 0],
         "normal": [0, 1, 0], "within_mm": 1},
        {"name": "corner", "type": "intersection", "of": ["top", "edge"]})",
                          R"(, "relations": [{"name": "r", "type": "angle", "of": ["edge", "top"]}],
              "datum": {"plane": "top", "line": "edge", "point": "ball"})"),
                     RunContext());
  ASSERT_TRUE(plan) << plan.error().text();
  ASSERT_EQ(plan->elements.size(), 6u);
  EXPECT_DOUBLE_EQ(plan->elements[0].nominal.radius_m, 0.020);
  EXPECT_EQ(plan->elements[0].nominal.point, Vec3d(1e-3, 2e-3, 3e-3));
  EXPECT_EQ(plan->elements[1].nominal.direction, Vec3d::UnitY());
  EXPECT_NEAR(plan->elements[2].nominal.half_angle_rad, std::numbers::pi / 6, 1e-12);
  EXPECT_EQ(plan->elements[2].high_m, Vec3d(4e-3, 5e-3, 6e-3));
  EXPECT_EQ(plan->elements[3].nominal.section_normal, Vec3d::UnitY());
  EXPECT_EQ(plan->elements[4].nominal.section_normal, Vec3d::UnitY());
  EXPECT_EQ(*plan->elements[5].of, (std::array<std::size_t, 2>{1, 4}));
  EXPECT_TRUE(plan->relations.at(0).angle);
  EXPECT_EQ(plan->datum->point, 0u);
}

TEST(ElementFile, ErrorsNameTheElementAndWhatIsWrong) {
  EXPECT_THAT(error_of(changed("sphere", "ball")),
              HasSubstr("element 'ball': its type 'ball' is none of sphere, cylinder"));
  EXPECT_THAT(error_of(changed("40", "-40")),
              HasSubstr("elements[0].diameter_mm = -40 is out of range"));
  EXPECT_THAT(error_of(changed("40", "1e999")), HasSubstr("a number is too large"));
  EXPECT_THAT(error_of(changed("40", "NaN")), HasSubstr("not valid JSON: line 2"));
  EXPECT_THAT(error_of(changed("40", "\"40\"")), HasSubstr("element 'ball'"));
  EXPECT_THAT(error_of(changed("within_mm", "withn_mm")),
              HasSubstr("element 'ball': 'withn_mm' is not known here; use"));
  EXPECT_THAT(error_of(changed("\"name\": \"ball\",", "")),
              HasSubstr("elements[0].name is missing"));
  EXPECT_THAT(error_of(changed("\"within_mm\": 1", "\"min_mm\": [0, 0, 0]")),
              HasSubstr("element 'ball': line 1, column 15: elements[0].within_mm is missing"));
  EXPECT_THAT(error_of(changed("1, 2, 3", "1, 2, 1e10")), HasSubstr("farther away"));
  EXPECT_THAT(error_of(file(kBall + "," + kBall)), HasSubstr("element 'ball' is there twice"));
  EXPECT_THAT(error_of(file("")), HasSubstr("elements is empty"));
  EXPECT_THAT(error_of(file(R"({"name": "x", "type": "intersection", "of": ["x", "y"]})")),
              HasSubstr("element 'x': there is no element 'x' before it"));
  const auto relation = [](const std::string& text) {
    return file(kBall + "," + kTop, ", \"relations\": [" + text + "]");
  };
  EXPECT_THAT(error_of(relation(R"({"name": "a", "type": "distance", "of": ["ball", "cup"]})")),
              HasSubstr("relation 'a': there is no element 'cup'"));
  EXPECT_THAT(error_of(relation(R"({"name": "a", "type": "distance", "of": ["ball"]})")),
              HasSubstr("1 names, not 2"));
  EXPECT_THAT(error_of(relation(R"({"name": "a", "type": "near", "of": ["ball", "top"]})")),
              HasSubstr("'near' is neither distance nor angle"));
  EXPECT_THAT(error_of(file(kTop, ", \"datum\": {\"plane\": \"top\"}")),
              HasSubstr("datum: line = '' is no element"));
  std::string plane = kTop;
  EXPECT_THAT(error_of(file(plane.replace(plane.find("[0, 2, 0]"), 9, "[0, 0, 0]"))),
              HasSubstr("direction has no direction"));
  std::string many = kBall;
  for (int i = 0; i < 300; ++i) many += ", {}";
  EXPECT_THAT(error_of(file(many)), HasSubstr("301 entries, more than 256"));
}

ElementReport sphere(const std::string& name, double x_m, std::optional<double> sigma_m) {
  ElementReport report;
  report.elements.push_back({name,
                             elements::Kind::kSphere,
                             12,
                             1e-3,
                             1e-4,
                             {{"x", Quantity::kLength, x_m, sigma_m, 0.0120}}});
  return report;
}

TEST(ElementOutput, NoNameIsAFormulaAndWhatIsNotKnownIsEmpty) {
  const ElementReport report = sphere("=1+1", 0.0123, std::nullopt);
  EXPECT_THAT(elements_csv(report), HasSubstr("\n'=1+1,sphere,12,1.0000000,x,mm,12.3000000,,12.0"));
  EXPECT_THAT(elements_text(report), HasSubstr("not known"));
  EXPECT_THAT(elements_json(report), HasSubstr("\"sigma\": null"));
}

TEST(ElementOutput, FiguresHaveTheDigitsThatSigmaAllows) {
  const ElementReport report = sphere("ball", 0.0123456, 3.2e-5);
  EXPECT_EQ(figure_rows(report).at(1),
            (std::vector<std::string>{"ball", "x", "12.346", "0.032", "12.000", "+0.346", "mm"}));
}

}  // namespace
}  // namespace turnscan::workflow
