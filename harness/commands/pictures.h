// The page and the figures of a results folder, made after the work that filled it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace touchstone::commands {

// Runs `touchstone report` for the folder, and prints where the page is. If it cannot be made, says
// why: what was measured is worth as much without it.
void make_page(const std::filesystem::path& folder);

// Figures, which the scripts of plots/ draw with matplotlib.

enum class Drawing { drawn, no_matplotlib, failed };

// Runs a script of plots/ with these arguments. If it fails, `log` keeps its output.
Drawing draw_figures(const std::string& script, const std::vector<std::string>& arguments,
                     const std::filesystem::path& log);

}  // namespace touchstone::commands
