// The machines that did the parts of a plan.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "harness/record/result_folder.h"

namespace touchstone::shards {

// Names machines by their hosts. A host whose facts changed from one part to another, such as its
// kernel, counts as another machine: "n7" and "n7-2".
class Machines {
 public:
  // Returns the name of the machine with these facts of a part's machine.csv.
  std::string name_of(const record::Facts& part);

  std::size_t size() const { return facts_.size(); }
  // Returns the facts that all machines share; the others say that they differ.
  record::Facts shared() const;
  // Writes FOLDER/machines/NAME/machine.csv for each.
  void write(const std::filesystem::path& folder) const;

 private:
  std::map<std::string, record::Facts> facts_;  // by the machine's name
};

}  // namespace touchstone::shards
