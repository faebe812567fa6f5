// Helpers of rows.
#include "harness/record/row.h"

#include "harness/base/input_file.h"

namespace touchstone::record {

std::string one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  return base::printable(text);
}

}  // namespace touchstone::record
