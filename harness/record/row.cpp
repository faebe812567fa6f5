// Helpers of rows.
#include "harness/record/row.h"

namespace touchstone::record {

std::string one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  return text;
}

}  // namespace touchstone::record
