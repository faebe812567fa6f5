// Options that select algorithms and cases.
#include "harness/commands/case_selection.h"

#include <string>

namespace touchstone::commands {

void add_kinds(Arguments& command, check::CaseSelection& selection) {
  const auto add = [&](check::CaseKind kind, const char* what) {
    command.text("--" + std::string(to_string(kind)),
                 selection.others[static_cast<std::size_t>(kind)],
                 std::string(what) + ": names, all, ours, peers, none");
  };
  add(check::CaseKind::concave, "Concave phases");
  add(check::CaseKind::rays, "Ray casts");
  add(check::CaseKind::points, "Point queries");
  add(check::CaseKind::cast, "Casts of moving bodies");
  add(check::CaseKind::ccd, "Continuous collision of features");
  add(check::CaseKind::scene_rays, "Ray casts of scenes");
}

void add_selection(Arguments& command, check::CaseSelection& selection) {
  add_kinds(command, selection);
  command.text("--regimes", selection.regimes,
               "Regimes and families of cases: names joined by commas (default: all)");
  command.text("--group,--groups", selection.groups, "Groups of these, joined by commas");
}

}  // namespace touchstone::commands
