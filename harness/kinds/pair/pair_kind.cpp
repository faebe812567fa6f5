// The kind of pairs: its words, its regimes as families, and its checkers.
#include <algorithm>
#include <memory>

#include "harness/base/error.h"
#include "harness/files/cases.h"
#include "harness/files/packed_files.h"
#include "harness/kinds/grading.h"
#include "harness/kinds/mesh/mesh_kind.h"
#include "harness/kinds/pair/axes/axes.h"
#include "harness/kinds/pair/pair_checkers.h"
#include "harness/kinds/pair/pair_questions.h"

namespace touchstone::kinds {
namespace {

std::vector<Family> pair_families() {
  std::vector<Family> list;
  for (const Regime& regime : regimes()) list.push_back(family_of(regime));
  for (const Regime& regime : regimes_of_axes()) list.push_back(family_of(regime));
  return list;
}

std::unique_ptr<Checker> pair_checker(const CheckRequest& request) {
  switch (request.mode) {
    case CheckMode::cases: break;
    case CheckMode::axes: return std::make_unique<AxisChecker>(request);
    case CheckMode::count: return std::make_unique<CountChecker>(request);
  }
  return std::make_unique<CaseChecker>(request);
}

}  // namespace

PairRequest::PairRequest(const CheckRequest& request) : CheckRequest(request) {
  for (const Contestant& contestant : contestants) {
    if (contestant.kind != &pair_kind()) continue;
    const auto* entry = &contestant.of<NarrowPhaseEntry>();
    const auto at = std::ranges::find(narrow, entry) - narrow.begin();
    if (at == std::ssize(narrow)) narrow.push_back(entry);
    algorithms.push_back({static_cast<std::uint32_t>(at), contestant.scalar});
  }
  for (const Family* family : families) {
    if (family->kind != &pair_kind()) continue;
    regimes.push_back(static_cast<const Regime*>(family->drawn));
  }
}

std::uint32_t PairRequest::regime_of(std::uint32_t family) const {
  const auto at = std::find(regimes.begin(), regimes.end(), families[family]->drawn);
  return static_cast<std::uint32_t>(at - regimes.begin());
}

std::vector<const Axis*> PairRequest::axes() const {
  std::vector<const Axis*> list;
  for (const Regime* regime : regimes) {
    if (list.empty() || list.back() != regime->axis) list.push_back(regime->axis);
  }
  return list;
}

namespace {

// A regime draws by a plain function, so its cases are here.
std::vector<files::Case>& cases_of_file() {
  static std::vector<files::Case> cases;
  return cases;
}

RegimeCase case_of_file(RegimeDraw& draw) {
  const files::Case& c = cases_of_file()[draw.index];
  return {.pair = c, .detail = c.id};
}

}  // namespace

bool PairRequest::is_of_file() const {
  return regimes.size() == 1 && regimes.front()->draw == case_of_file;
}

void take_case_file(const std::filesystem::path& file, CheckRequest& request) {
  static Regime regime;
  static Family family;
  const std::filesystem::path plain = files::is_packed(file) ? file.stem() : file;
  regime.name = plain.stem().string();
  regime.group = regime.name;
  regime.what = "pairs of a file";
  regime.extreme = true;
  regime.draw = case_of_file;
  family = family_of(regime);
  cases_of_file() = files::read_cases(file);
  if (cases_of_file().empty())
    throw base::InputError(file.string(), 0, "has no case; expected one");
  std::erase_if(request.contestants,
                [](const Contestant& one) { return one.kind != &pair_kind(); });
  if (request.contestants.empty()) {
    throw base::InputError("FILE has pairs; expected an algorithm of the kind pair");
  }
  request.families = {&family};
  request.cases = static_cast<int>(cases_of_file().size());
}

const Kind& pair_kind() {
  static const KindOf<NarrowPhaseEntry> kind(
      {.registry = kind_words<NarrowPhaseEntry>,
       .title = "Pairs of convex bodies",
       .contract = "narrow phase",
       .legend = "",
       .tasks = pair_task_names,
       .draw_number = 0,
       .counted = "certified"},
      {.options = pair_options,
       .read = read_pair_questions,
       .verify = verify_mesh_proofs,
       .offers = [](const NarrowPhaseEntry& entry, Precision scalar,
                    std::uint8_t) { return offers(entry, scalar); },
       .by_task = false,
       .families = pair_families,
       .checker = pair_checker});
  return kind;
}

}  // namespace touchstone::kinds
