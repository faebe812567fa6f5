// Forms of queries of continuous collision, and the lengths that they are asked with.
#include "harness/kinds/feature/feature_kind.h"

#include <algorithm>
#include <array>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "algorithms/oracle/solid.h"
#include "harness/families/ccd_families.h"

namespace touchstone::kinds {
namespace {

CcdQuery with_order(const CcdQuery& query, const std::array<std::size_t, 4>& order) {
  CcdQuery other;
  for (std::size_t k = 0; k < 4; ++k) {
    other.start[k] = query.start[order[k]];
    other.end[k] = query.end[order[k]];
  }
  return other;
}

std::optional<CcdQuery> moved(const CcdQuery& query, const Vec3d& shift,
                              const FormNumbers& numbers) {
  CcdQuery other;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto start = exact_sum(numbers.turn(query.start[k]), shift);
    const auto end = exact_sum(numbers.turn(query.end[k]), shift);
    if (!start || !end) return std::nullopt;
    other.start[k] = *start;
    other.end[k] = *end;
  }
  return other;
}

oracle::Solid solid_hull(std::vector<Vec3d> vertices) {
  Hull hull;
  hull.vertices = std::move(vertices);
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = std::make_shared<const Hull>(std::move(hull));
  return oracle::Solid(shape);
}

// The distance of the features at a time, whose places are rounded, and the greatest coordinate.
struct MeasuredAt {
  oracle::Measure measure;
  double reach;
};
MeasuredAt measured_at(const CcdQuery& query, int first_count, double time,
                       oracle::Oracle& oracle) {
  std::array<std::vector<Vec3d>, 2> features;
  double reach = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3d &start = query.start[k], &end = query.end[k];
    features[k < static_cast<std::size_t>(first_count) ? 0 : 1].push_back((1 - time) * start +
                                                                          time * end);
    reach = std::max({reach, start.cwiseAbs().maxCoeff(), end.cwiseAbs().maxCoeff()});
  }
  const oracle::Solid a = solid_hull(std::move(features[0])),
                      b = solid_hull(std::move(features[1]));
  return {oracle.measure({a, Pose{}}, {b, Pose{}}), reach};
}

}  // namespace

std::optional<CcdQuery> query_in_form(const CcdQuery& query, int first_count, double scale,
                                      const FormNumbers& numbers, CaseForm form) {
  switch (form) {
    case CaseForm::as_drawn: return query;
    case CaseForm::swapped:
      return with_order(query, first_count == 1 ? std::array<std::size_t, 4>{0, 2, 3, 1}
                                                : std::array<std::size_t, 4>{2, 3, 1, 0});
    case CaseForm::scaled: return families::changed(query, numbers.scale);
    case CaseForm::moved: return moved(query, scale * numbers.shift, numbers);
    case CaseForm::reversed: return CcdQuery{query.end, query.start};
    case CaseForm::split: break;
  }
  return std::nullopt;
}

std::optional<std::array<Vec3d, 4>> vertices_halfway(const CcdQuery& query) {
  std::array<Vec3d, 4> middle;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto sum = exact_sum(query.start[k], query.end[k]);
    if (!sum) return std::nullopt;
    middle[k] = *sum / 2;
  }
  return middle;
}

double distance_at(const CcdQuery& query, int first_count, double time, oracle::Oracle& oracle) {
  return std::max(0.0, measured_at(query, first_count, time, oracle).measure.middle());
}

int side_of_distance(const CcdQuery& query, int first_count, double time, double distance,
                     oracle::Oracle& oracle) {
  const auto [measure, reach] = measured_at(query, first_count, time, oracle);
  const double doubt = 0x1p-36 * reach;
  return measure.lower > distance + doubt ? 1 : measure.upper < distance - doubt ? -1 : 0;
}

bool are_further_apart(const CcdQuery& query, int first_count, double time, double distance,
                       oracle::Oracle& oracle) {
  const auto [measure, reach] = measured_at(query, first_count, time, oracle);
  return measure.lower > distance + 64 * 0x1p-52 * reach;
}

namespace {

// A distance of the features (metres) that is less than those shortly before and after.
double least_distance(const CcdQuery& query, int first_count, oracle::Oracle& oracle) {
  constexpr int looks = 16, sections = 40;
  const auto distance = [&](double time) { return distance_at(query, first_count, time, oracle); };
  int nearest = 0;
  double least = distance(0);
  for (int look = 1; look <= looks; ++look) {
    const double found = distance(1.0 * look / looks);
    if (found < least) {
      least = found;
      nearest = look;
    }
  }
  double begin = std::max(nearest - 1, 0) / (1.0 * looks);
  double end = std::min(nearest + 1, looks) / (1.0 * looks);
  for (int k = 0; k < sections; ++k) {
    const double part = (end - begin) / std::numbers::phi;
    const double at_first = distance(end - part), at_second = distance(begin + part);
    least = std::min({least, at_first, at_second});
    (at_first < at_second ? end : begin) = at_first < at_second ? begin + part : end - part;
  }
  return least;
}

}  // namespace

CcdSize ccd_size(std::uint64_t index) {
  constexpr std::array<CcdSize, 6> sizes = {
      {{1, 1e-6}, {0x1p-20, 0x1p-40}, {0x1p20, 1}, {0x1p-7, 1e-10}, {0x1p10, 0}, {1e-2, 1e-8}}};
  return sizes[index / queries_of_a_call % sizes.size()];
}

Lengths separated_lengths(std::uint64_t index, const CcdQuery& query, int first_count,
                          oracle::Oracle& oracle) {
  constexpr std::array<double, 5> separations = {0x1p-3, 1e-3, 0x1p-20, 1, 1e-9};
  constexpr std::uint64_t close = 16;
  const CcdSize size = ccd_size(index);
  if (index % close == 0) {
    const double half = (index / close % 2 == 0 ? 0.5 : -0.5) * size.tolerance;
    const double separation = least_distance(query, first_count, oracle) + half;
    if (separation > 0) return {size.tolerance, separation};
  }
  return {size.tolerance, size.scale * separations[index / queries_of_a_call % separations.size()]};
}

}  // namespace touchstone::kinds
