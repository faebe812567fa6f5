// Grades of contact manifolds, by family of cases and algorithm.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "harness/base/table.h"
#include "harness/grade/manifold/manifold_grade.h"

namespace touchstone::grade {

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
