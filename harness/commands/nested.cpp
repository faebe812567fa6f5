// touchstone scene and touchstone shards: commands that hold others.
#include <array>
#include <string>
#include <string_view>

#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"

namespace touchstone::commands {
namespace {

struct NestedRow {
  std::string_view command, name, about;
  void (*add)(Arguments arguments);
};

constexpr std::array nested_rows = std::to_array<NestedRow>({
#define TOUCHSTONE_NESTED(command, name, takes, about) \
  {#command, #name, about, add_##command##_##name},
#include "harness/commands/commands.inl"
});

void add_nested(Arguments arguments, std::string_view command) {
  for (const NestedRow& row : nested_rows) {
    if (row.command != command) continue;
    row.add(arguments.nested(std::string(row.name), std::string(row.about)));
  }
}

}  // namespace

void add_scene(Arguments command) { add_nested(command, "scene"); }

void add_shards(Arguments command) { add_nested(command, "shards"); }

}  // namespace touchstone::commands
