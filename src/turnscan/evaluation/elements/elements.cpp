#include <turnscan/evaluation/elements/elements.hpp>

#include <algorithm>
#include <cmath>
#include <turnscan/evaluation/elements/select.hpp>

namespace turnscan {

namespace {

using elements::Kind;
using elements::Shape;
using Shapes = std::vector<Shape>;

/// Adds the intersections to the fitted shapes.
Result<> construct(const ElementPlan& plan, Shapes& shapes) {
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const ElementRequest& request = plan.elements[i];
    if (!request.of) continue;
    const auto [a, b] = *request.of;
    const auto crossing = elements::intersection(shapes[a], shapes[b]);
    if (!crossing)
      return fail(ErrorCode::kInvalidOption,
                  "element '{}': '{}' and '{}' do not cross; a plane crosses another plane, or a "
                  "line, cylinder or cone that is not parallel to it",
                  request.name, plan.elements[a].name, plan.elements[b].name);
    shapes[i] = *crossing;
  }
  return {};
}

tl::unexpected<Error> no_frame(const char* role, const ElementRequest& element, const char* why) {
  return fail(ErrorCode::kInvalidOption, "datum: '{}' cannot be its {}: {}; choose another",
              element.name, role, why);
}

/// T_datum_mesh; identity without a datum.
Result<Pose> datum_frame(const ElementPlan& plan, const Shapes& shapes) {
  if (!plan.datum) return Pose::Identity();
  constexpr double kLeast = 1e-6;  // a sine: then the direction is lost in single precision
  const auto [a, b, c] = *plan.datum;
  const Shape& plane = shapes[a];
  if (plane.kind != Kind::kPlane) return no_frame("plane", plan.elements[a], "it is none");
  const bool trace = shapes[b].kind == Kind::kPlane;
  const auto line = trace ? elements::intersection(plane, shapes[b]) : shapes[b];
  if (!line || !elements::is_axis(line->kind))
    return no_frame("line", plan.elements[b], "it is no line, axis or plane across the first");
  const Vec3d z = plane.direction;
  Vec3d x = line->direction - z.dot(line->direction) * z;
  if (!(x.norm() > kLeast))
    return no_frame("line", plan.elements[b], "it is perpendicular to the plane");
  x.normalize();
  const Vec3d y = z.cross(x);
  Vec3d origin = z.dot(plane.point) * z + y.dot(line->point) * y;
  const Shape& end = shapes[c];
  if (end.kind == Kind::kPlane) {
    const double towards = end.direction.dot(x);
    if (!(std::abs(towards) > kLeast))
      return no_frame("point", plan.elements[c], "it is parallel to the line");
    origin += end.direction.dot(end.point - origin) / towards * x;
  } else if (elements::is_axis(end.kind) && end.kind != Kind::kCone) {
    return no_frame("point", plan.elements[c], "it is a line");
  } else {
    origin += x.dot(end.point) * x;
  }
  Pose T_mesh_datum = Pose::Identity();
  T_mesh_datum.linear() << x, y, z;
  T_mesh_datum.translation() = origin;
  return T_mesh_datum.inverse(Eigen::Isometry);
}

void add_figures(const Shape& s, std::vector<ElementFigure>& out) {
  const auto add = [&](const char* name, Quantity quantity, double value) {
    out.push_back({name, quantity, value, std::nullopt, 0.0});
  };
  add("x", Quantity::kLength, s.point.x());
  add("y", Quantity::kLength, s.point.y());
  add("z", Quantity::kLength, s.point.z());
  // The direction of a circle is that of its nominal plane, and not measured.
  if (elements::has_direction(s.kind) && s.kind != Kind::kCircle) {
    add("direction x", Quantity::kNone, s.direction.x());
    add("direction y", Quantity::kNone, s.direction.y());
    add("direction z", Quantity::kNone, s.direction.z());
  }
  if (elements::has_radius(s.kind)) add("diameter", Quantity::kLength, 2.0 * s.radius_m);
  if (s.kind == Kind::kCone) add("angle", Quantity::kAngle, 2.0 * s.half_angle_rad);
}

Result<> check_relation(const RelationRequest& relation, const ElementPlan& plan,
                        const Shapes& shapes) {
  for (const std::size_t i : relation.of)
    if (relation.angle && !elements::has_direction(shapes[i].kind))
      return fail(ErrorCode::kInvalidOption,
                  "relation '{}': '{}' is a {}, which has no direction; choose other elements",
                  relation.name, plan.elements[i].name, elements::name_of(shapes[i].kind));
  return {};
}

/// All values of a report for given shapes, in one order: those of the elements, in the datum
/// frame, and of the relations.
Result<std::vector<double>> values_of(const ElementPlan& plan, Shapes shapes) {
  TURNSCAN_TRY(construct(plan, shapes));
  TURNSCAN_ASSIGN(const Pose T_datum_mesh, datum_frame(plan, shapes));
  std::vector<ElementFigure> figures;
  for (const Shape& shape : shapes) add_figures(transformed(shape, T_datum_mesh), figures);
  std::vector<double> out;
  for (const ElementFigure& figure : figures) out.push_back(figure.value);
  for (const RelationRequest& r : plan.relations) {
    TURNSCAN_TRY(check_relation(r, plan, shapes));
    const auto [a, b] = r.of;
    out.push_back(r.angle ? elements::angle_between(shapes[a], shapes[b])
                          : elements::distance_between(shapes[a], shapes[b]));
  }
  return out;
}

/// Variances of all values, NaN where not known. Each column of each element's spread is one
/// standard deviation in a direction independent of the others. The mean square of the changes to
/// either side is also right at the end of a range, such as at an angle of 0.
Result<std::vector<double>> variances_of(const ElementPlan& plan, const Shapes& shapes,
                                         const std::vector<elements::Fit>& fits,
                                         const std::vector<double>& values) {
  std::vector<double> out(values.size(), 0.0);
  for (std::size_t e = 0; e < shapes.size(); ++e) {
    if (plan.elements[e].of) continue;
    for (int column = 0; column < fits[e].spread.cols(); ++column) {
      for (const double sign : {-1.0, 1.0}) {
        Shapes other = shapes;
        other[e] = elements::changed(shapes[e], sign * fits[e].spread.col(column));
        TURNSCAN_ASSIGN(const std::vector<double> moved, values_of(plan, std::move(other)));
        for (std::size_t i = 0; i < values.size(); ++i) {
          const double change = moved[i] - values[i];
          if (!fits[e].known && change != 0.0) out[i] = std::nan("");
          out[i] += 0.5 * change * change;
        }
      }
    }
  }
  return out;
}

/// The nominal shapes. A point that may be anywhere on a shape is where the measured one is, so
/// that the two can be compared.
Result<Shapes> nominals_of(const ElementPlan& plan, const Shapes& shapes,
                           const Pose& T_datum_mesh) {
  Shapes out;
  for (const ElementRequest& request : plan.elements) out.push_back(request.nominal);
  TURNSCAN_TRY(construct(plan, out));
  TURNSCAN_ASSIGN(const Pose T_datum_nominal, datum_frame(plan, out));
  const Pose T_nominal_mesh = T_datum_nominal.inverse(Eigen::Isometry) * T_datum_mesh;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (plan.elements[i].of) continue;
    out[i] = elements::moved_along(out[i], T_nominal_mesh * shapes[i].point);
  }
  return out;
}

}  // namespace

Result<ElementReport> measure_elements(const TriangleMesh& mesh, const ElementPlan& plan,
                                       const RunContext& context) {
  context.begin_phase("elements", plan.elements.size());
  TURNSCAN_ASSIGN(const elements::Surface surface, elements::Surface::of(mesh));
  ElementReport report;
  Shapes shapes;
  std::vector<elements::Fit> fits;
  for (const ElementRequest& request : plan.elements) {
    elements::Surface::Fitted fitted;
    if (!request.of) {
      TURNSCAN_ASSIGN(fitted, surface.fit(request, context));
    }
    report.elements.push_back({request.name,
                               fitted.fit.shape.kind,
                               fitted.points,
                               fitted.fit.form_m,
                               fitted.fit.rms_m,
                               {}});
    shapes.push_back(fitted.fit.shape);
    fits.push_back(fitted.fit);
    context.advance();
  }
  TURNSCAN_TRY(construct(plan, shapes));
  TURNSCAN_ASSIGN(const Pose T_datum_mesh, datum_frame(plan, shapes));
  if (plan.datum) report.T_datum_mesh = T_datum_mesh;
  TURNSCAN_ASSIGN(const std::vector<double> values, values_of(plan, shapes));
  TURNSCAN_ASSIGN(const std::vector<double> variances, variances_of(plan, shapes, fits, values));
  TURNSCAN_ASSIGN(Shapes nominals, nominals_of(plan, shapes, T_datum_mesh));
  TURNSCAN_ASSIGN(const std::vector<double> nominal, values_of(plan, std::move(nominals)));
  std::size_t next = 0;
  const auto fill = [&](ElementFigure& figure) {
    figure.value = values[next];
    if (!std::isnan(variances[next])) figure.sigma = std::sqrt(variances[next]);
    figure.nominal = nominal[next++];
  };
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    report.elements[i].kind = shapes[i].kind;
    add_figures(shapes[i], report.elements[i].figures);
    for (ElementFigure& figure : report.elements[i].figures) fill(figure);
  }
  for (const RelationRequest& r : plan.relations) {
    MeasuredRelation relation;
    relation.of = {plan.elements[r.of[0]].name, plan.elements[r.of[1]].name};
    relation.angle = r.angle;
    relation.figure.name = r.name;
    relation.figure.quantity = r.angle ? Quantity::kAngle : Quantity::kLength;
    fill(relation.figure);
    report.relations.push_back(std::move(relation));
  }
  return report;
}

}  // namespace turnscan
