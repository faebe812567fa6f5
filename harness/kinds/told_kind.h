// The kind of the questions in a file, and of the proofs in one, by their keys or columns.
#pragma once

#include <filesystem>
#include <string>

#include "harness/kinds/kind.h"
#include "harness/kinds/questions.h"

namespace touchstone::kinds {

// `word` is the kind's name, which decides, or empty. Pairs are those of convex bodies, of any bodies, or moving ones;
// rays are cast at a mesh, or at a scene where --in names one. Throws InputError where the file does not tell, and
// for a word that names no kind.
const Kind& told_kind(const QuestionInput& input, const std::string& word);

// The same for a file of proofs.
const Kind& told_kind_of_proofs(const std::filesystem::path& proofs, const std::string& word);

}  // namespace touchstone::kinds
