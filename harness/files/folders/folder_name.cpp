// Reads and checks names of works.
#include "harness/files/folders/folder_name.h"

#include "harness/base/file_name.h"

namespace touchstone::files {

std::string folder_name(TomlTable& table, const std::filesystem::path& file,
                        const std::string& ending) {
  std::string name = table.text("name", file.stem().string()) + ending;
  const std::string fault = base::name_fault(name);
  if (!fault.empty()) table.fail("name", fault);
  return name;
}

}  // namespace touchstone::files
