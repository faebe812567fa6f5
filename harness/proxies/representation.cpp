// Names, parses and makes the collision proxies of a body.
#include "harness/proxies/representation.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "algorithms/hull/convex_hull.h"
#include "harness/base/error.h"
#include "harness/proxies/decomposition.h"
#include "harness/proxies/fits.h"
#include "harness/proxies/placed_solid.h"

namespace touchstone::proxies {
namespace {

constexpr std::array<std::pair<Form, std::string_view>, 13> names = {{
    {Form::as_given, "as-given"},
    {Form::sphere, "sphere"},
    {Form::box, "box"},
    {Form::oriented_box, "oriented-box"},
    {Form::dop14, "dop-14"},
    {Form::dop18, "dop-18"},
    {Form::dop26, "dop-26"},
    {Form::capsule, "capsule"},
    {Form::reduced_hull, "hull-"},
    {Form::hull, "hull"},
    {Form::parts, "parts"},
    {Form::mesh, "mesh"},
    {Form::icosphere, "icosphere-"},
}};
constexpr std::string_view sides[] = {"", " inner", " nearest"};
constexpr std::string_view expected =
    "expected as-given, sphere, box, oriented-box, dop-14, dop-18, dop-26, capsule, hull-K (K "
    "vertices, 8 to 10000), hull, parts, parts-K (1 to 1000), mesh or icosphere-L (0 to 5), with "
    "\" inner\" or \" nearest\" behind it where it is not the outer one";

bool has_sides(Form form) { return form != Form::as_given && form != Form::mesh; }

bool is_round(const Shape& shape) {
  return shape.kind != ShapeKind::box && shape.kind != ShapeKind::hull;
}

Part outer_part(const LocalBody& body, const Representation& r) {
  switch (r.form) {
    case Form::sphere: return outer_sphere(body);
    case Form::box: return outer_box(body);
    case Form::oriented_box: return outer_oriented_box(body);
    case Form::dop14: return outer_dop(body, 14);
    case Form::dop18: return outer_dop(body, 18);
    case Form::dop26: return outer_dop(body, 26);
    case Form::capsule: return outer_capsule(body);
    case Form::reduced_hull: return outer_reduced_hull(body, r.detail);
    case Form::icosphere: return outer_icosphere(body, r.detail);
    default: return outer_hull(body);
  }
}

Part inner_part(const LocalBody& body, const Representation& r) {
  switch (r.form) {
    case Form::sphere: return inner_sphere(body);
    case Form::box: return inner_box(body);
    case Form::oriented_box: return inner_oriented_box(body);
    case Form::dop14: return inner_dop(body, 14);
    case Form::dop18: return inner_dop(body, 18);
    case Form::dop26: return inner_dop(body, 26);
    case Form::capsule: return inner_capsule(body);
    case Form::reduced_hull: return inner_reduced_hull(body, r.detail);
    case Form::icosphere: return inner_icosphere(body, r.detail);
    default: return {body.shape, {}};
  }
}

std::vector<Part> inner_parts_of_mesh(const LocalBody& body, const Representation& r) {
  const MeshInside inside(body);
  switch (r.form) {
    case Form::sphere: return {inside.sphere()};
    case Form::capsule: return {inside.capsule(fitting_axes(body))};
    case Form::parts: return inside.copies(decompose(body, r.detail));
    default: return {inside.copy(outer_part(body, r))};
  }
}

// Scales a proxy around its middle to the body's volume.
Part nearest_part(const LocalBody& body, Representation r) {
  const double volume = WholeBody(body, fitting_axes(body).transpose()).volume();
  if (!(volume > 0)) {
    throw base::InputError(
        "a body without volume has no nearest representation; expected an outer one");
  }
  Part part = r.form == Form::icosphere ? inner_part(body, r) : outer_part(body, r);
  const double factor = std::cbrt(volume / PlacedSolid(part.shape, part.pose).volume());
  Shape& s = part.shape;
  s.radius *= factor;
  s.half_length *= factor;
  s.half_extents *= factor;
  s.radii *= factor;
  if (s.hull != nullptr) {
    auto hull = std::make_shared<Hull>(*s.hull);
    Vec3d middle = Vec3d::Zero();
    for (const Vec3d& v : hull->vertices) middle += v / static_cast<double>(hull->vertices.size());
    for (Vec3d& v : hull->vertices) v = middle + factor * (v - middle);
    s.hull = std::move(hull);
  }
  return part;
}

void check(const Shape& shape, const geometry::Mesh* mesh, const Representation& r) {
  if (shape.kind == ShapeKind::halfspace && r.form != Form::as_given) {
    throw base::InputError(fmt::format("a half-space has no {}; expected as-given", to_string(r)));
  }
  if (!has_sides(r.form) && r.side != Side::outer) {
    throw base::InputError(fmt::format("{}: a body's own shape is on no side of it; expected {}",
                                       to_string(r), to_string({r.form, Side::outer, 0})));
  }
  if (r.form == Form::mesh && (mesh == nullptr || mesh->triangles.empty())) {
    throw base::InputError(
        "a body without a mesh cannot be represented by it; expected another form");
  }
}

std::vector<Part> triangles_as_parts(const LocalBody& body) {
  std::vector<Part> parts;
  for (const auto& [a, b, c] : body.mesh.triangles) {
    Part part;
    part.shape.kind = ShapeKind::hull;
    const std::vector<Vec3d>& v = body.mesh.vertices;
    part.shape.hull = make_hull({v[a], v[b], v[c]});
    parts.push_back(std::move(part));
  }
  return parts;
}

std::vector<Part> represent_local(const LocalBody& body, const Representation& r) {
  const bool own_hull = r.form == Form::hull || r.form == Form::parts ||
                        (r.form == Form::icosphere && !is_round(body.shape));
  if (!body.has_mesh && own_hull) return {{body.shape, {}}};
  if (r.form == Form::mesh) return triangles_as_parts(body);
  switch (r.side) {
    case Side::outer:
      if (r.form == Form::parts) return decompose(body, r.detail);
      if (own_hull) return {outer_hull(body)};
      return {outer_part(body, r)};
    case Side::inner:
      if (body.has_mesh) return inner_parts_of_mesh(body, r);
      return {inner_part(body, r)};
    case Side::nearest: break;
  }
  if (r.form == Form::parts) {
    throw base::InputError(
        "several parts are not scaled to a body's volume; expected outer or inner ones");
  }
  return {nearest_part(body, own_hull ? Representation{Form::hull, r.side, 0} : r)};
}

}  // namespace

std::string to_string(const Representation& r) {
  std::string text;
  for (const auto& [form, name] : names) {
    if (form == r.form) text = name;
  }
  if (text.back() == '-') text += std::to_string(r.detail);
  if (r.form == Form::parts && r.detail > 0) text += "-" + std::to_string(r.detail);
  return text += sides[static_cast<std::size_t>(r.side)];
}

Representation parse_representation(std::string_view text) {
  const std::string whole(text);
  const auto fail = [&]() -> Representation {
    throw base::InputError(fmt::format("representation '{}': {}", whole, expected));
  };
  Representation r;
  for (Side side : {Side::inner, Side::nearest}) {
    const std::string_view ending = sides[static_cast<std::size_t>(side)];
    if (!text.ends_with(ending)) continue;
    r.side = side;
    text.remove_suffix(ending.size());
  }
  for (const auto& [form, name] : names) {
    if (text != name || name.ends_with('-')) continue;
    r.form = form;
    return has_sides(form) || r.side == Side::outer ? r : fail();
  }
  struct Numbered {
    std::string_view prefix;
    Form form;
    int least, most;
  };
  for (const Numbered& n :
       {Numbered{"hull-", Form::reduced_hull, 8, 10000}, Numbered{"parts-", Form::parts, 1, 1000},
        Numbered{"icosphere-", Form::icosphere, 0, 5}}) {
    if (!text.starts_with(n.prefix)) continue;
    const std::string_view digits = text.substr(n.prefix.size());
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), r.detail);
    if (error != std::errc() || end != digits.data() + digits.size()) return fail();
    if (r.detail < n.least || r.detail > n.most) return fail();
    r.form = n.form;
    return r;
  }
  return fail();
}

std::vector<Part> represent(const Shape& shape, const geometry::Mesh* mesh,
                            const Representation& r) {
  check(shape, mesh, r);
  if (r.form == Form::as_given) return {{shape, {}}};
  const LocalBody body(shape, mesh);
  std::vector<Part> parts = represent_local(body, r);
  for (Part& part : parts) part = body.placed(std::move(part));
  return parts;
}

}  // namespace touchstone::proxies
