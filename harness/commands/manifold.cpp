// touchstone manifold: runs manifold algorithms on cases, and grades their points.
#include <fmt/format.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/base/table.h"
#include "harness/check/regimes/settled_pairs.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"
#include "harness/files/cases.h"
#include "harness/files/csv.h"
#include "harness/files/text_file.h"
#include "harness/grade/manifold/manifold_tally.h"
#include "harness/kinds/selection.h"
#include "harness/process/isolate.h"
#include "harness/process/queries/solve_manifold.h"

namespace touchstone::commands {
namespace {

struct ManifoldOptions {
  std::string cases, algorithms = "all", out, page;
  std::optional<std::uint64_t> settled;  // the number of pairs of each family
  std::uint64_t seed = 1;
  std::optional<Precision> scalar;
  bool grade = false;
  double time_limit = 5;  // seconds a query
};

// A case, with its family.
struct Asked {
  files::Case pair;
  std::string family;
};

// One algorithm in one scalar.
struct Contestant {
  const ManifoldEntry* entry;
  Precision scalar;
  // One for each case; `unsupported` for kinds that the algorithm lacks.
  std::vector<Manifold> manifolds;

  std::string name() const { return fmt::format("{} {}", entry->info.name, to_string(scalar)); }
};

std::vector<Asked> read_or_make_cases(const ManifoldOptions& options) {
  if (options.cases.empty() == !options.settled) {
    throw base::InputError("found neither or both; expected either CASES or --settled COUNT");
  }
  std::vector<Asked> asked;
  if (!options.settled) {
    for (files::Case& c : files::read_cases(options.cases))
      asked.push_back({std::move(c), "cases"});
    return asked;
  }
  for (const check::SettledFamily& family : check::settled_families()) {
    for (std::uint64_t i = 0; i < *options.settled; ++i) {
      asked.push_back({check::settled_pair(family, options.seed, i), std::string(family.name)});
    }
  }
  return asked;
}

// Runs the algorithm in a child process. Prints the failures.
void ask(Contestant& contestant, const std::vector<Asked>& asked, double time_limit) {
  const ManifoldEntry& entry = *contestant.entry;
  contestant.manifolds.resize(asked.size());
  std::vector<std::size_t> taken;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const files::Case& c = asked[i].pair;
    if (offers(entry, c.shape_a.kind, c.shape_b.kind)) taken.push_back(i);
  }
  const auto solved =
      process::isolated_answers<Manifold>(taken.size(), {.item_seconds = time_limit}, [&] {
        return [&](std::size_t item) {
          return process::solve_manifold(entry, {.scalar = contestant.scalar},
                                         asked[taken[item]].pair);
        };
      });
  for (std::size_t item = 0; item < taken.size(); ++item) {
    contestant.manifolds[taken[item]] = solved.answers[item];
  }
  print_failures(entry.info.name, solved.failures, [&](std::size_t item) {
    return fmt::format("case '{}'", asked[taken[item]].pair.id);
  });
}

void write_points(const std::string& file, const std::vector<Asked>& asked,
                  const std::vector<Contestant>& contestants) {
  files::CsvWriter csv(
      file, {"id", "algorithm", "scalar", "answer", "status", "normal_x", "normal_y", "normal_z",
             "count", "point", "depth", "a_x", "a_y", "a_z", "b_x", "b_y", "b_z", "feature"});
  for (std::size_t i = 0; i < asked.size(); ++i) {
    for (const Contestant& contestant : contestants) {
      const Manifold& manifold = contestant.manifolds[i];
      // A manifold without points has one row too.
      for (int k = 0; k < std::max(1, manifold.count); ++k) {
        csv.field(asked[i].pair.id).field(contestant.entry->info.name);
        csv.field(to_string(contestant.scalar)).field(to_string(manifold.answer));
        csv.field(to_string(manifold.status));
        for (const double x : manifold.normal) csv.field(x);
        csv.field(manifold.count);
        if (manifold.count == 0) {
          csv.field("");
        } else {
          csv.field(k);
        }
        const ContactPoint point = manifold.points[static_cast<std::size_t>(k)];
        csv.field(point.depth);
        for (const Vec3d& v : {point.on_a, point.on_b}) {
          for (const double x : v) csv.field(x);
        }
        csv.field(point.feature == 0 ? std::string() : fmt::format("{:016x}", point.feature));
        csv.end_row();
      }
    }
  }
  csv.close();
}

void print_counts(const std::vector<Contestant>& contestants) {
  base::Table table({"algorithm", "0 points", "1", "2", "3", "4", "not asked"});
  for (const Contestant& contestant : contestants) {
    std::array<std::size_t, 6> counts{};
    for (const Manifold& manifold : contestant.manifolds) {
      const bool asked = manifold.status != Status::unsupported;
      ++counts[asked ? static_cast<std::size_t>(manifold.count) : 5];
    }
    std::vector<std::string> row = {contestant.name()};
    for (const std::size_t count : counts) row.push_back(fmt::format("{}", count));
    table.add(std::move(row));
  }
  fmt::print("{}", table.text(base::page_width()));
}

grade::ManifoldTally grade_all(const std::vector<Asked>& asked,
                               const std::vector<Contestant>& contestants) {
  grade::ManifoldTally tally;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const grade::ManifoldTruth truth = grade::manifold_truth(asked[i].pair);
    for (const Contestant& contestant : contestants) {
      const Manifold& manifold = contestant.manifolds[i];
      if (manifold.status == Status::unsupported) continue;
      tally.add(asked[i].family, contestant.name(), contestant.entry->info, contestant.scalar,
                asked[i].pair, truth, manifold);
    }
  }
  return tally;
}

std::string page_text(const ManifoldOptions& options, const grade::ManifoldTally& tally) {
  std::string text = "# Contact manifolds\n\n";
  std::string command = "touchstone manifold ";
  command += options.settled ? fmt::format("--settled {} --seed {}", *options.settled, options.seed)
                             : options.cases;
  text += fmt::format(
      "Made by `{} --algorithm {} --grade --page FILE`. Every row is the worst of its pairs; "
      "lengths "
      "are parts of the pair's size.\n\n"
      "- *missed*: pairs that overlap and have no point.\n"
      "- *off body*: how far a point is from the body that it is said to be of, by the oracle.\n"
      "- *depth error*: of the deepest point, against the oracle's depth.\n"
      "- *apart*: the gap at a point. Bullet reports places that nearly touch, by design.\n"
      "- *area of best four*: the area between the points, as a part of the greatest that four "
      "corners of the touching area span of which one is the deepest; at most 1. *Area of all*: as "
      "a "
      "part of the whole. The touching area is where the two faces overlap as seen along the "
      "algorithm's normal.\n\n"
      "Peers are given the shapes without the margins that they would add, as their files in "
      "`algorithms/peers` say.\n\n",
      command, options.algorithms);
  if (options.settled) {
    for (const check::SettledFamily& family : check::settled_families()) {
      text += fmt::format("- `{}`: {}\n", family.name, family.what);
    }
    text += '\n';
  }
  return text + tally.table().markdown();
}

int manifold(const ManifoldOptions& options) {
  const auto entries = kinds::select(registry::entries<ManifoldEntry>(),
                                     kinds::split_names(options.algorithms), "contact manifold");
  if (options.out.empty() && !options.grade) {
    throw base::InputError("nothing is asked for; expected --out FILE or --grade, or both");
  }
  if (!options.page.empty() && !options.grade) {
    throw base::InputError("--page was given without --grade; expected both");
  }
  const std::vector<Asked> asked = read_or_make_cases(options);
  files::check_outputs({{"CASES", options.cases}},
                       {{"--out", options.out}, {"--page", options.page}});
  std::vector<Contestant> contestants;
  for (const ManifoldEntry* entry : entries) {
    for (const Precision scalar : {Precision::float64, Precision::float32}) {
      const bool wanted = !options.scalar || *options.scalar == scalar;
      if (wanted && offers(*entry, scalar)) contestants.push_back({entry, scalar, {}});
    }
  }
  for (Contestant& contestant : contestants) ask(contestant, asked, options.time_limit);
  if (!options.out.empty()) write_points(options.out, asked, contestants);
  print_counts(contestants);
  if (!options.grade) return exit_done;
  const grade::ManifoldTally tally = grade_all(asked, contestants);
  fmt::print("\n{}", tally.table().text(base::page_width()));
  if (!options.page.empty()) files::write_text(options.page, page_text(options, tally));
  for (const std::string& line : tally.ours_wrong()) fmt::print("wrong: {}\n", line);
  return tally.ours_wrong().empty() ? exit_done : exit_measured_wrong;
}

}  // namespace

void add_manifold(Arguments command) {
  const auto options = std::make_shared<ManifoldOptions>();
  command.text("CASES", options->cases, "Cases: JSON, one object a line");
  command
      .number("--settled", options->settled,
              "Instead of CASES: so many generated pairs of each family of face contacts")
      .within(1, 1'000'000);
  command.number("--seed", options->seed, "The seed of the generated pairs").show_default();
  command
      .text("--algorithm", options->algorithms,
            "Contact manifolds: names joined by commas, or all, ours, peers")
      .show_default();
  command.one_of("--scalar", options->scalar, scalar_choices(),
                 "What is calculated in; without it, in each that an algorithm has");
  command.flag("--grade", options->grade,
               "Hold the points to the oracle, the bodies and the touching area; exit status 1 "
               "where one of ours is not as good as it promises");
  command.text("--page", options->page, "With --grade: the table as a Markdown page");
  add_time_limit(command, options->time_limit).show_default();
  command.text("--out", options->out, "The CSV file to write, a row for each point");
  command.job([options] { return manifold(*options); });
}

}  // namespace touchstone::commands
