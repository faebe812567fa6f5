// Prints what algorithms answered: a line each for a few questions, and a summary for many.
#pragma once

#include <span>
#include <string_view>

#include "harness/kinds/questions.h"

namespace touchstone::commands {

// Prints to standard error the first of the questions that an algorithm lost, and the number of the others.
void print_lost(std::string_view algorithm, std::span<const kinds::AskFailure> failures);

// For each question a line for each algorithm: its answer, its number, the bound that is proven, and how far it is off
// the exact one. Those that do not take the question are one line.
void print_lines(const kinds::Questions& questions);

// The number of each answer and each status of every algorithm.
void print_counts(const kinds::Questions& questions);

// How to ask those that were left out because they calculate in the other of float and double alone.
void print_scalar_hint(const kinds::Questions& questions, Precision asked);

}  // namespace touchstone::commands
