// CGAL is under the GNU General Public License: TOUCHSTONE_WITH_CGAL=OFF leaves this out.
#include <CGAL/Gmpz.h>
#include <CGAL/Homogeneous.h>
#include <CGAL/Polytope_distance_d.h>
#include <CGAL/Polytope_distance_d_traits_3.h>

#include "tests/algorithms/oracle/reference.h"

namespace touchstone::oracle::reference {

SignedSquare squared_distance(const IntegerPair& pair) {
  using Kernel = CGAL::Homogeneous<CGAL::Gmpz>;
  using Traits = CGAL::Polytope_distance_d_traits_3<Kernel, CGAL::Gmpz>;
  const auto points = [](const std::vector<Point>& from) {
    std::vector<Kernel::Point_3> all;
    for (const Point& p : from) {
      all.emplace_back(CGAL::Gmpz(p[0].get_mpz_t()), CGAL::Gmpz(p[1].get_mpz_t()),
                       CGAL::Gmpz(p[2].get_mpz_t()), CGAL::Gmpz(1));
    }
    return all;
  };
  const auto a = points(pair.a), b = points(pair.b);
  const CGAL::Polytope_distance_d<Traits> distance(a.begin(), a.end(), b.begin(), b.end());
  mpq_class square(mpz_class(distance.squared_distance_numerator().mpz()),
                   mpz_class(distance.squared_distance_denominator().mpz()));
  square.canonicalize();
  return square * pair.unit * pair.unit;
}

}  // namespace touchstone::oracle::reference
