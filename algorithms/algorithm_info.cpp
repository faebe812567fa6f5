// The written names of origins.
#include "algorithms/algorithm_info.h"

namespace touchstone {

std::string_view to_string(Origin origin) {
  switch (origin) {
    case Origin::ours: return "ours";
    case Origin::peer: return "peer";
    case Origin::oracle: return "oracle";
    case Origin::module: return "module";
  }
  return "?";
}

}  // namespace touchstone
