// Moving vertices and faces, and moving edges: drawn families, and files of queries.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/random.h"
#include "harness/base/reproducible_math.h"
#include "harness/files/ccd_queries.h"
#include "harness/kinds/feature/feature_grade.h"
#include "harness/kinds/feature/feature_kind.h"
#include "harness/kinds/set_keys.h"

namespace touchstone::kinds {
namespace {

enum class FeatureFamily : std::uint8_t {
  crossing,
  clear_miss,
  at_the_end,
  at_a_corner,
  in_a_plane,
  alike
};
constexpr std::array<std::string_view, 6> feature_family_names = {
    "crossing",     "clear miss",  "contact at the end", "contact at a corner",
    "in one plane", "moving alike"};
constexpr std::array<FeaturePair, 2> feature_pairs = {FeaturePair::vertex_face,
                                                      FeaturePair::edge_edge};

// A point of each feature, by weights of its vertices: the vertex and the triangle, or both edges.
struct Weights {
  std::array<double, 4> of;
};
Weights random_weights(FeaturePair pair, bool corner, base::Random& random) {
  if (pair == FeaturePair::edge_edge) {
    const double s = corner ? 1 : random.unit(), t = random.unit();
    return {{1 - s, s, 1 - t, t}};
  }
  double u = corner ? 1 : random.unit(), v = corner ? 0 : random.unit();
  if (u + v > 1) u = 1 - u, v = 1 - v;
  return {{1, 1 - u - v, u, v}};
}
std::size_t features_of_first(FeaturePair pair) { return pair == FeaturePair::vertex_face ? 1 : 2; }

Vec3d on(const std::array<Vec3d, 4>& at, const Weights& weights, std::size_t from, std::size_t to) {
  Vec3d point = Vec3d::Zero();
  for (std::size_t k = from; k < to; ++k) point += weights.of[k] * at[k];
  return point;
}

CcdQuery draw_feature_query(FeaturePair pair, FeatureFamily family, base::Random& random) {
  CcdQuery query;
  const auto draw_all = [&](std::array<Vec3d, 4>& at) {
    for (Vec3d& v : at) v = random.in_ball();
  };
  draw_all(query.start);
  draw_all(query.end);
  const std::size_t split = features_of_first(pair);
  const auto move_first = [&](std::array<Vec3d, 4>& at, const Vec3d& by) {
    for (std::size_t k = 0; k < split; ++k) at[k] += by;
  };
  switch (family) {
    case FeatureFamily::crossing: break;
    case FeatureFamily::clear_miss: {
      const Vec3d away = 3 * random.on_sphere();
      move_first(query.start, away);
      move_first(query.end, away);
      break;
    }
    case FeatureFamily::at_the_end:
    case FeatureFamily::at_a_corner: {
      // The two points meet at time 1, up to rounding; at a corner of one of the features.
      const Weights weights = random_weights(pair, family == FeatureFamily::at_a_corner, random);
      move_first(query.end, on(query.end, weights, split, 4) - on(query.end, weights, 0, split));
      move_first(query.start, 3 * random.on_sphere());
      break;
    }
    case FeatureFamily::in_a_plane:
      for (std::size_t k = 0; k < 4; ++k) query.start[k].z() = query.end[k].z() = 0.25;
      break;
    case FeatureFamily::alike: {
      const Vec3d by = random.on_sphere();
      for (std::size_t k = 0; k < 4; ++k) query.end[k] = query.start[k] + by;
      break;
    }
  }
  return query;
}

struct CcdInput {
  FeaturePair pair;
  std::vector<CcdQuery> queries;
  std::vector<oracle::ccd::Impact> exact;
};

TimedGrade grade_feature_set(const CcdInput& input, const CcdSettings& settings, bool is_oracle,
                             std::span<const CcdOutcome> outcomes) {
  TimedGrade sum;
  oracle::Oracle oracle;
  const int first_count = input.pair == FeaturePair::vertex_face ? 1 : 2;
  for (std::size_t i = 0; i < input.exact.size(); ++i) {
    const CcdOutcome& found = outcomes[i];
    const oracle::ccd::Impact& right = input.exact[i];
    const FeatureAsked asked = {.query = &input.queries[i],
                                .first_count = first_count,
                                .lengths = {settings.tolerance, settings.separation}};
    sum.add(grade_feature(found, right, asked, is_oracle, oracle), static_cast<std::int64_t>(i));
    // Early is safe; late is a contact that has been passed.
    if (is_meant(found.status) && found.answer == CcdAnswer::hit && right.is_hit) {
      sum.note_error(found.toi - right.contact_by);
    }
  }
  return sum;
}

TimedSet make_feature_set(const std::shared_ptr<CcdInput>& input, const CcdSettings& settings,
                          const std::vector<const CcdEntry*>& entries) {
  const int first_count = input->pair == FeaturePair::vertex_face ? 1 : 2;
  for (const CcdQuery& query : input->queries) {
    input->exact.push_back(impact_of({first_count, query.start, query.end}, settings.separation));
  }
  TimedSet cell;
  cell.queries = cell.graded = std::ssize(input->queries);
  for (const CcdEntry* entry : entries) {
    if (settings.separation > 0 && !entry->separations) {
      cell.left_out.push_back({entry->info.name, entry->info.origin});
      continue;
    }
    const std::shared_ptr<Ccd> solver = entry->make(settings);
    const auto outcomes = std::make_shared<std::vector<CcdOutcome>>(input->queries.size());
    TimedContestant made = contestant_in(*entry);
    made.answer = [=] { solver->solve(input->pair, input->queries, *outcomes); };
    made.grade = [=, is_oracle = entry->info.origin == Origin::oracle] {
      return grade_feature_set(*input, settings, is_oracle, *outcomes);
    };
    made.hash = [=] {
      return hash_of_answers(std::span<const CcdOutcome>(*outcomes), [](const CcdOutcome& one) {
        return hash_of_parts(one.status, one.answer, one.toi, one.free_before, one.contact_by);
      });
    };
    cell.contestants.push_back(std::move(made));
  }
  return cell;
}

// The files as they are told apart: without the folders that all of them are in.
std::vector<std::string> short_names(const std::vector<std::string>& files) {
  std::filesystem::path folder;
  for (const std::string& file : files) {
    const std::filesystem::path parent =
        std::filesystem::path(file).lexically_normal().parent_path();
    if (&file == &files.front()) folder = parent;
    const auto differ = std::ranges::mismatch(folder, parent);
    std::filesystem::path common;
    for (auto part = folder.begin(); part != differ.in1; ++part) common /= *part;
    folder = common;
  }
  std::vector<std::string> names;
  for (const std::string& file : files) {
    names.push_back(
        std::filesystem::path(file).lexically_normal().lexically_relative(folder).generic_string());
  }
  return names;
}

}  // namespace

std::vector<PlannedSet> feature_sets(files::TomlTable& table, const std::filesystem::path& home) {
  const auto count = static_cast<std::size_t>(table.integer("queries", 16, 10'000'000, 4096));
  const auto seed = static_cast<std::uint64_t>(table.integer("seed", 0, 1'000'000'000, 1));
  const double tolerance = table.number("tolerance", files::positive, 1e-6);
  std::vector<double> separations =
      listed_numbers(table, "separations", 0, 1e100, "distances in metres");
  if (separations.empty()) separations.push_back(0);
  const std::vector<std::size_t> families = choices(table, "families", feature_family_names);
  const auto entries = selected(table, registry::entries<CcdEntry>(), "ccd");
  std::vector<PlannedSet> cells;
  const auto add = [&](const std::string& group, const std::string& name, const auto& make_input) {
    for (const double separation : separations) {
      const CcdSettings settings = {.tolerance = tolerance, .separation = separation};
      cells.push_back({group,
                       separation > 0 ? fmt::format("{}, within {}", name, separation) : name,
                       [=] { return make_feature_set(make_input(), settings, entries); }});
    }
  };
  for (const FeaturePair pair : feature_pairs) {
    const std::string group(to_string(pair));
    for (const std::size_t family : families) {
      add(group, std::string(feature_family_names[family]), [=] {
        const auto input = std::make_shared<CcdInput>();
        input->pair = pair;
        base::Random random(seed, family << 1 | static_cast<std::size_t>(pair));
        for (std::size_t i = 0; i < count; ++i)
          input->queries.push_back(
              draw_feature_query(pair, static_cast<FeatureFamily>(family), random));
        return input;
      });
    }
    const std::string key = pair == FeaturePair::vertex_face ? "vertex_face" : "edge_edge";
    const std::vector<std::string> files = table.texts(key, {});
    const std::vector<std::string> names = short_names(files);
    for (std::size_t i = 0; i < files.size(); ++i) {
      try {
        CcdInput input{pair, files::read_ccd_queries(home / files[i]).queries, {}};
        add(group, names[i], [=] { return std::make_shared<CcdInput>(input); });
      } catch (const base::InputError& error) {
        table.fail(key, error.what());
      }
    }
  }
  return cells;
}

}  // namespace touchstone::kinds
