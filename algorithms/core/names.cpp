// The written names of the core's enumerations.
#include "algorithms/core/cast_outcome.h"
#include "algorithms/core/outcome.h"
#include "algorithms/core/shape.h"

namespace touchstone {

std::string_view to_string(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::sphere: return "sphere";
    case ShapeKind::capsule: return "capsule";
    case ShapeKind::box: return "box";
    case ShapeKind::cylinder: return "cylinder";
    case ShapeKind::cone: return "cone";
    case ShapeKind::ellipsoid: return "ellipsoid";
    case ShapeKind::hull: return "hull";
    case ShapeKind::halfspace: return "halfspace";
  }
  return "?";
}

std::string_view to_string(Task task) {
  switch (task) {
    case Task::intersect: return "intersect";
    case Task::distance: return "distance";
    case Task::penetration: return "penetration";
    case Task::signed_distance: return "signed";
  }
  return "?";
}

std::string_view to_string(Answer answer) {
  switch (answer) {
    case Answer::separated: return "separated";
    case Answer::touching: return "touching";
    case Answer::overlapping: return "overlapping";
    case Answer::unknown: return "unknown";
  }
  return "?";
}

std::string_view to_string(Status status) {
  switch (status) {
    case Status::ok: return "ok";
    case Status::not_converged: return "not_converged";
    case Status::degenerate: return "degenerate";
    case Status::capacity: return "capacity";
    case Status::unsupported: return "unsupported";
    case Status::not_reported: return "not_reported";
    case Status::crashed: return "crashed";
    case Status::timed_out: return "timed_out";
    case Status::garbage: return "garbage";
  }
  return "?";
}

std::string_view to_string(CastAnswer answer) {
  switch (answer) {
    case CastAnswer::hit: return "hit";
    case CastAnswer::miss: return "miss";
    case CastAnswer::unknown: return "unknown";
  }
  return "?";
}

std::string_view to_string(Precision scalar) {
  return scalar == Precision::float32 ? "float" : "double";
}

}  // namespace touchstone
