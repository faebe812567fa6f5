// Grades of contact manifolds against the bodies themselves.
//
// Distances come from the oracle. The area in which two faces touch is clipped in long double, in a
// way that no algorithm uses.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/contact_manifold.h"
#include "harness/base/table.h"
#include "harness/files/cases.h"

namespace touchstone::grade {

// The exact answers for one case.
struct ManifoldTruth {
  double size = 1;  // size of the pair, metres
  // The least penetration, metres, and its bounds. `depth` is the middle of the oracle's interval,
  // which is wide for some curved bodies. The values are negative if the bodies are apart.
  double depth = 0, least_depth = 0, greatest_depth = 0;

  bool overlap() const { return depth > 0; }
};

ManifoldTruth manifold_truth(const files::Case& c);

// Grades of one manifold. Lengths are parts of the pair's size.
struct ManifoldGrade {
  bool missed = false;     // the manifold has no point, though the bodies overlap
  double off_body = 0;     // greatest distance of a point on_a from a, or on_b from b
  double off_line = 0;     // greatest distance of on_a - on_b from depth * normal
  double depth_error = 0;  // error of the deepest point, beyond the oracle's interval
  double apart = 0;        // greatest gap between the bodies at a point
  // The area spanned by the points, seen along the normal, as a part of two others: the greatest
  // area of four corners of the contact area that include the deepest, and the whole contact area.
  // At most 1: points at which the bodies are apart could span more. Known only if both bodies are
  // boxes, solid hulls or half-spaces, and their faces touch in an area and lie within 20 degrees
  // of the plane across the normal.
  std::optional<double> of_best_four, of_all;
};

ManifoldGrade grade(const files::Case& c, const ManifoldTruth& truth, const Manifold& manifold);

// Returns the error of a point that rounding of world coordinates explains, as a part of the size.
double coordinate_rounding(const files::Case& c, const ManifoldTruth& truth);

class ManifoldTally {
 public:
  // Adds a grade under the table's name for the algorithm. Grades of ours are compared with their
  // documented limits.
  void add(const std::string& family, const std::string& algorithm, const AlgorithmInfo& info,
           Precision scalar, const files::Case& c, const ManifoldTruth& truth,
           const Manifold& manifold);

  // Returns a table with a row for each family and algorithm: cases run and missed, and the worst
  // of each grade.
  base::Table table() const;

  // Lists the limits that ours exceed, one line each; empty if there are none.
  const std::vector<std::string>& ours_wrong() const { return wrong_; }

 private:
  struct Worst {
    std::size_t asked = 0, missed = 0, with_area = 0;
    double off_body = 0, depth_error = 0, apart = 0;
    double of_best_four = 1, of_all = 1, sum_of_best_four = 0;
    int least_points = Manifold::most_points, most_points = 0;
  };
  struct Key {
    std::string family, algorithm;
    friend bool operator==(const Key&, const Key&) = default;
  };

  std::vector<std::vector<std::string>> cells() const;

  std::vector<std::pair<Key, Worst>> rows_;  // in the order in which they were added
  std::vector<std::string> wrong_;
};

}  // namespace touchstone::grade
