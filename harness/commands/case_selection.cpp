// Options that select algorithms and cases.
#include "harness/commands/case_selection.h"

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace touchstone::commands {

void add_kinds(Arguments& command, check::CaseSelection& selection) {
  command.text("--with", selection.with,
               "Algorithms of all kinds: names, all, ours, libraries, oracle, none");
  command.text("--kind", selection.kinds,
               "Only these kinds: pair, box, mesh, ray, point, cast, feature, scene-ray");
  const auto add = [&](std::string_view option, std::string& list, std::string_view kind) {
    command.text("--" + std::string(option), list,
                 fmt::format("The same as --with for the kind {} alone", kind));
  };
  for (const kinds::Kind* kind : kinds::kinds()) {
    add(kind->old_name(), selection.others[kind], kind->name());
  }
}

void add_selection(Arguments& command, check::CaseSelection& selection) {
  add_kinds(command, selection);
  command.text("--regimes", selection.regimes,
               "Regimes and families of cases: names joined by commas (default: all)");
  command.text("--group,--groups", selection.groups, "Groups of these, joined by commas");
}

}  // namespace touchstone::commands
