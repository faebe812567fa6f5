// Figures, which the scripts of plots/ draw with matplotlib.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace touchstone::commands {

enum class Drawing { drawn, no_matplotlib, failed };

// Runs a script of plots/ with these arguments. If it fails, `log` keeps its output.
Drawing draw_figures(const std::string& script, const std::vector<std::string>& arguments,
                     const std::filesystem::path& log);

}  // namespace touchstone::commands
