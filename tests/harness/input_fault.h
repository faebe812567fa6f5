// What a reader says of bad input.
#pragma once

#include <string>

#include "harness/base/error.h"

namespace touchstone {

// The message of the InputError that ends the action; empty where none does.
template <class Action>
std::string input_fault(const Action& action) {
  try {
    action();
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace touchstone
