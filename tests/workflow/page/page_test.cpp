#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <turnscan/workflow/page/encoding.hpp>
#include <turnscan/workflow/page/page.hpp>
#include <turnscan/workflow/page/page_output.hpp>
#include <turnscan/workflow/page/page_plots.hpp>
#include <turnscan/workflow/page/report_facts.hpp>
#include <turnscan/workflow/page/svg_plot.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

PageInput ball_input() {
  PageInput input;
  input.title = "ball";
  input.picture_px = 32;  // a large one takes longer than all else
  input.objects.push_back({});
  input.objects[0].mesh = test::sphere(0.03, 3);
  return input;
}

/// A page is too long to be printed when a test fails.
MATCHER_P(Holds, text, "holds \"" + std::string(text) + "\"") {
  *result_listener << "a page of " << arg.size() << " bytes";
  return arg.find(text) != std::string::npos;
}

std::string page_of(const PageInput& input) {
  const auto page = make_page(input, RunContext());
  if (!page) {
    ADD_FAILURE() << page.error().text();
    return "";
  }
  return page->html;
}

TEST(Encoding, EscapesWhatHtmlWouldRead) {
  EXPECT_EQ(page::escaped("a<b>&\"'"), "a&lt;b&gt;&amp;&quot;&#39;");
  EXPECT_EQ(page::escaped("\xc3\xa9 \xf0\x9f\x90\xbb"), "\xc3\xa9 \xf0\x9f\x90\xbb");
  for (const char* bad : {"\xff", "\xc0\xaf", "\xed\xa0\x80", "\xf5\x80\x80\x80", "\x01", "\x7f"})
    EXPECT_THAT(page::escaped(bad), testing::StartsWith("\xef\xbf\xbd")) << bad;
  EXPECT_EQ(page::in_script("{\"a\":\"</script>\"}"), "{\"a\":\"\\u003c/script>\"}");
}

TEST(Encoding, HashesAndBase64AreThoseOfTheStandards) {
  EXPECT_EQ(page::base64(""), "");
  EXPECT_EQ(page::base64("f"), "Zg==");
  EXPECT_EQ(page::base64("fo"), "Zm8=");
  EXPECT_EQ(page::base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(page::csp_hash("abc"), "sha256-ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0=");
  EXPECT_EQ(page::csp_hash(std::string(1000, 'a')),
            "sha256-Qe3s5C1j6Nm/UVqbppMuHCDLyfWl0TRkWttdsblzfqM=");
}

TEST(SvgPlot, TicksAreRoundNumbersThatHoldTheRange) {
  EXPECT_THAT(page::ticks(0.0, 1.0, 5),
              ElementsAre(0.0, 0.2, 0.4, testing::DoubleEq(0.6), 0.8, 1.0));
  EXPECT_THAT(page::ticks(-3.0, 12.0, 5), ElementsAre(-5.0, 0.0, 5.0, 10.0, 15.0));
  for (const double scale : {1e-9, 3e-4, 7.0, 1e12}) {
    const auto ticks = page::ticks(-0.3 * scale, scale, 5);
    EXPECT_LE(ticks.front(), -0.3 * scale);
    EXPECT_GE(ticks.back(), scale * (1.0 - 1e-9));
    EXPECT_LE(ticks.size(), 9u);
  }
}

TEST(SvgPlot, HasATitleADescriptionAndATable) {
  page::Plot plot;
  plot.title = "Error <over> height";
  plot.description = "A & B";
  plot.x = {1.0, 2.0, 3.0};
  plot.series = {{"median", {0.1, std::nan(""), 0.3}}};
  const std::string html = page::svg_figure(plot, "p1");
  EXPECT_THAT(html, HasSubstr("role=\"img\" aria-labelledby=\"p1-t p1-d\""));
  EXPECT_THAT(html, HasSubstr("<title id=\"p1-t\">Error &lt;over&gt; height</title>"));
  EXPECT_THAT(html, HasSubstr("<desc id=\"p1-d\">A &amp; B</desc>"));
  EXPECT_THAT(html, HasSubstr("<td>2</td><td>-</td>")) << "a gap is a gap";
  EXPECT_THAT(html, Not(HasSubstr("nan")));
  plot.series[0].y.assign(3, std::nan(""));
  EXPECT_EQ(page::svg_figure(plot, "p1"), "");
  plot.series[0].y.assign(3, 5.0);
  EXPECT_THAT(page::svg_figure(plot, "p1"), Not(HasSubstr("nan"))) << "a level line";
}

TEST(Page, NoTextBecomesMarkup) {
  const std::string attack = "</script><img src=x onerror=alert(1)>\"'&";
  PageInput input = ball_input();
  input.title = attack;
  input.objects[0].mesh.name = attack;
  const nlohmann::json report = {
      {"version", attack},
      {"notes", {attack}},
      {"parameters", {{{"option", attack}, {"value", attack}, {"reason", attack}}}},
      {"seconds", {{attack, 1.0}}},
      {"options", {{attack, attack}}},
      {"objects",
       {{{"notes", {attack}},
         {"verdict",
          {{"colour", "red"},
           {"sentences",
            {{{"topic", attack},
              {"level", attack},
              {"text", attack},
              {"unit", attack},
              {"value", 1.0}}}}}}}}}};
  input.report = report.dump();
  const std::string html = page_of(input);
  EXPECT_THAT(html, Not(Holds("<img src=x")));
  EXPECT_THAT(html, Holds("&lt;img src=x onerror=alert(1)&gt;&quot;&#39;&amp;"));
}

TEST(Page, OfAReportHasItsVerdictParametersAndNotes) {
  PageInput input = ball_input();
  input.report = R"({"version": "0.0.9", "frames": 120, "notes": ["The platter was found"],
    "parameters": [{"option": "voxel-size", "value": "1.5mm", "reason": "from the noise"}],
    "objects": [{"verdict": {"colour": "amber", "sentences": [
      {"topic": "Turn", "level": "fair", "text": "Seen from 300 degrees", "value": 300,
       "unit": "deg"}]}}]})";
  const std::string html = page_of(input);
  EXPECT_THAT(html, Holds("<span class=\"badge amber\">amber</span>"));
  EXPECT_THAT(html, Holds("Seen from 300 degrees"));
  EXPECT_THAT(html, Holds("class=\"number\">300 deg</td>"));
  EXPECT_THAT(html, Holds("from the noise"));
  EXPECT_THAT(html, Holds("The platter was found"));
  EXPECT_THAT(html, Holds("Reconstructed by turnscan 0.0.9"));
  EXPECT_THAT(page_of(ball_input()), Not(Holds("Verdict"))) << "nothing is said of what is not";
}

TEST(Page, PlotsHowTheFramesAgree) {
  PageInput input = ball_input();
  EXPECT_THAT(page_of(input), Not(Holds("How well the frames agree")));
  input.report = R"({"objects": [{"frame_residuals": {"frame": [3, 4, 9], "off_mm": [0.1, 4.5, 0.1],
    "spread_mm": [0.3, 0.4, 0.3]}}]})";
  const std::string html = page_of(input);
  EXPECT_THAT(html, Holds("How well the frames agree"));
  EXPECT_THAT(html, Holds("<td>4</td><td>4.5</td><td>0.4</td>"));
  input.report = R"({"objects": [{"frame_residuals": {"frame": [3, 4], "off_mm": [0.1],
    "spread_mm": "no"}}]})";
  EXPECT_THAT(page_of(input), Not(Holds("How well the frames agree"))) << "columns do not fit";
}

TEST(Page, NeedsNothingFromOutside) {
  const std::string html = page_of(ball_input());
  EXPECT_THAT(html, Holds("Content-Security-Policy\" content=\"default-src 'none'; "));
  for (const char* outside : {"src=\"http", "href=\"http", "src=\"//", "url(", "@import", "<link"})
    EXPECT_THAT(html, Not(Holds(outside))) << outside;
}

TEST(Page, PlotsWhatIsKnownOfEachVertexAndOfTheTurn) {
  PageInput input = ball_input();
  PageObject& ball = input.objects[0];
  EXPECT_THAT(page_of(input), Not(Holds("<h2 id=\"plots-h\"")));
  for (const Vec3f& v : ball.mesh.vertices) {
    ball.expected_error_m.push_back(v.y() > 0.0f ? 1e-4f : std::nanf(""));
    ball.seen_by.push_back(static_cast<std::uint16_t>(v.y() > 0.0f ? 40 : 0));
  }
  for (int i = 0; i < 50; ++i) input.turn.push_back({0.1 * i, 0.01 * i});
  const std::string html = page_of(input);
  for (const char* title :
       {"Expected error: share of the surface", "Expected error over the height",
        "Expected error around the axis", "Seen by: share of the surface", "Speed over the turn"})
    EXPECT_THAT(html, Holds(title));
  EXPECT_THAT(html, Not(Holds("Deviation")));
}

TEST(Page, ScalesExpectedErrorsByWhatWasMeasured) {
  PageInput input = ball_input();
  PageObject& ball = input.objects[0];
  for (const Vec3f& v : ball.mesh.vertices) {
    ball.invented.push_back(v.y() > 0.0f ? 0 : 1);
    ball.expected_error_m.push_back(v.y() > 0.0f ? 1e-4f : 0.05f);
  }
  const auto fields = page::fields_of(input.objects);
  ASSERT_EQ(fields.at(0).id, "expected_error");
  EXPECT_NEAR(fields[0].to, 0.1, 1e-6) << "mm";
  const auto plots = page::plots_of(input, fields, {});
  for (const double error_mm : plots.at(1).series.at(1).y)
    EXPECT_TRUE(std::isnan(error_mm) || error_mm < 0.11) << error_mm;
}

TEST(Page, OfAComparisonHasSignedDeviations) {
  PageInput input = ball_input();
  EvaluateOptions options;
  options.samples = 20000;
  options.tolerance_m = 1e-3;
  ASSERT_TRUE(compare_with(input, test::sphere(0.0295, 4), options, RunContext()));
  const PageObject& ball = input.objects[0];
  ASSERT_EQ(ball.deviation_m.size(), ball.mesh.vertices.size());
  for (const float d : ball.deviation_m) ASSERT_NEAR(d, 0.5e-3, 0.1e-3);
  ASSERT_TRUE(ball.evaluation && ball.evaluation->tolerance);
  const std::string html = page_of(input);
  EXPECT_THAT(html, Holds("100.0 % within +-1mm"));
  EXPECT_THAT(html, Holds("Deviation over the height"));
}

TEST(Page, OfElementsHasTheirFigures) {
  PageInput input = ball_input();
  EXPECT_THAT(page_of(input), Not(Holds("<h2 id=\"elements-h\">")));
  ElementPlan plan;
  plan.elements.push_back({});
  plan.elements[0].name = "<ball>";
  plan.elements[0].nominal.kind = elements::Kind::kSphere;
  plan.elements[0].nominal.radius_m = 0.03;
  plan.elements[0].within_m = 1e-3;
  auto report = measure_elements(input.objects[0].mesh, plan, RunContext());
  ASSERT_TRUE(report) << report.error().text();
  input.elements = *report;
  const std::string html = page_of(input);
  EXPECT_THAT(html, Holds("<h2 id=\"elements-h\">"));
  EXPECT_THAT(html, Holds("<th scope=\"row\">&lt;ball&gt;</th><td>diameter</td><td>60.0000</td>"));
}

TEST(Page, TakesArraysOfAReportThatFitTheMesh) {
  PageInput input = ball_input();
  const std::size_t n = input.objects[0].mesh.vertices.size();
  nlohmann::json object;
  object["seen_by"] = std::vector<int>(n, 12);
  object["invented"] = std::vector<bool>(n, true);
  object["expected_error_m"] = std::vector<double>(n + 1, 1e-4);  // of another mesh
  input.report = nlohmann::json{{"objects", {object}}}.dump();
  const std::string html = page_of(input);
  EXPECT_THAT(html, Holds("Seen by: share of the surface"));
  EXPECT_THAT(html, Not(Holds("Expected error")));
}

TEST(Page, RefusesWhatItCannotShow) {
  const auto error = [](const PageInput& input) {
    const auto page = make_page(input, RunContext());
    return page ? Error{ErrorCode::kLibrary, "success", ""} : page.error();
  };
  EXPECT_EQ(error({}).code, ErrorCode::kTooFewPoints);
  PageInput input = ball_input();
  input.objects[0].invented.assign(3, 0);
  EXPECT_THAT(error(input).message, HasSubstr("3 values for"));
  input = ball_input();
  input.report = "[1, 2";
  EXPECT_EQ(error(input).code, ErrorCode::kFormat);
  input.report = "{\"options\":" + std::string(100000, '[') + std::string(100000, ']') + "}";
  EXPECT_EQ(error(input).code, ErrorCode::kFormat);
  input.report = R"({"objects": 3, "parameters": "x", "notes": [1, null], "seconds": []})";
  EXPECT_EQ(error(input).message, "success") << "what has another type is left out";
  input = ball_input();
  input.objects[0].mesh.vertices[0].x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(error(input).code, ErrorCode::kFormat);
  const RunContext context;
  context.cancel();
  EXPECT_EQ(make_page(ball_input(), context).error().code, ErrorCode::kCancelled);
}

TEST(PageOutput, InventedAreTheVerticesThatNoMeasuredTriangleTouches) {
  Reconstruction reconstruction;
  ObjectResult object;
  object.mesh = test::tetrahedron();
  object.mesh.vertices.emplace_back(2.0f, 2.0f, 2.0f);
  object.mesh.triangles.push_back({1, 2, 4});
  object.evidence.assign(5, Evidence::kMeasured);
  object.evidence[4] = Evidence::kInvented;
  reconstruction.objects.push_back(object);
  EXPECT_THAT(page_objects(reconstruction).at(0).invented, ElementsAre(0, 0, 0, 0, 1));
  reconstruction.objects[0].evidence.clear();
  EXPECT_TRUE(page_objects(reconstruction).at(0).invented.empty());
}

TEST(PageOutput, ReportsAreToldApartByTheirEndings) {
  const auto both = sort_report_files({"a.html", "b.json"});
  ASSERT_TRUE(both);
  EXPECT_EQ(both->page, "a.html");
  EXPECT_EQ(both->json, "b.json");
  EXPECT_EQ(sort_report_files({"/dev/stdout"})->json, "/dev/stdout");
  EXPECT_EQ(sort_report_files({"a.html", "b.htm"}).error().code, ErrorCode::kInvalidOption);
  EXPECT_EQ(sort_report_files({"a.json", "b.json"}).error().code, ErrorCode::kInvalidOption);
}

}  // namespace
}  // namespace turnscan
