// The written names of pairs of features and answers of continuous collision.
#include "algorithms/ccd.h"

namespace touchstone {

std::string_view to_string(FeaturePair pair) {
  return pair == FeaturePair::vertex_face ? "vertex-face" : "edge-edge";
}

std::string_view to_string(CcdAnswer answer) {
  switch (answer) {
    case CcdAnswer::hit: return "hit";
    case CcdAnswer::miss: return "miss";
    case CcdAnswer::unknown: return "unknown";
  }
  return "?";
}

}  // namespace touchstone
