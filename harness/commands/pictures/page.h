// The page of a results folder, made after the work that filled it.
#pragma once

#include <filesystem>

namespace touchstone::commands {

// Runs `touchstone report` for the folder, and prints where the page is. If it cannot be made, says
// why: what was measured is worth as much without it.
void make_page(const std::filesystem::path& folder);

}  // namespace touchstone::commands
