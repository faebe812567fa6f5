// FCL: its two narrow-phase solvers, each with FCL's closed forms for some kind pairs.
// Paper:   Pan, Chitta, Manocha, "FCL: A general purpose library for collision and proximity
//          queries", ICRA 2012; the library is FCL 0.7. fcl-libccd: libccd's MPR for collision and
//          FCL's continuation of libccd's GJK for distance. fcl-indep: FCL's own GJK and EPA.
// Departs: the adapter calls the solvers that fcl::collide and fcl::distance look up, without the
//          look-up: the answers are equal, the iteration caps are in reach (requests have no field
//          for them) and no result object is allocated. The defaults are those of the requests.
//          tolerance: fcl-libccd uses it as MPR's, or as the least gain of a step of its distance;
//          fcl-indep as a length for EPA and for "inside", and as a part of the distance for GJK.
//          max_iterations: in fcl-libccd it caps the distance loops and MPR's search for the depth;
//          MPR's first loops have no cap. In fcl-indep it caps both loops, and EPA's stores grow
//          with it. The closed forms use neither. FCL never reports that a cap has ended a query.
//          A signed distance is the distance and then the depth: shapeSignedDistance of fcl-libccd
//          has no cap on its EPA and did not end within minutes on one of the tests' pairs; that of
//          fcl-indep gives no depth.
//          fcl-indep's EPA returns the depth negated and the normal in a's frame; the adapter
//          converts both. Witness points of a penetration are not reported: FCL gives one contact
//          point, with another meaning for each kind pair. A hull without faces is scanned; one
//          with faces is climbed. In float, fcl-libccd still computes in double: only shapes and
//          poses are floats.
// Fails:   MPR's depth is along its portal, an upper bound. fcl-indep: gaps below 1e-6 m are
//          overlaps; EPA's depth is off by half and more where supports are coplanar. Two opposed
//          half-spaces get the opposite answer, and a cone on a half-space counts as a ball when
//          its tip points down. Distance: far off in some pairs of flat faces, as it stops at the
//          first step that gains little; "overlapping" when it runs out of iterations. fcl-libccd
//          turns rotations into quaternions, which changes those that are not orthonormal.
// Cost:    fcl-libccd allocates two objects a query, EPA of fcl-indep its stores.
#include "algorithms/peers/fcl_solvers.h"

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> peers_fcl_narrow_phase() { return fcl_solvers::entries<double>(); }

}  // namespace touchstone::entries
