"""Every figure of a results folder: what `touchstone plot` runs."""

import os
import sys

import agreement
import broad
import common
import narrow
import phases
import speed_up
import stress
import time_against_count
import winners

FIGURES = {
    "time_against_count": time_against_count.draw,
    "broad": broad.draw,
    "narrow": narrow.draw,
    "speed_up": speed_up.draw,
    "phases": phases.draw,
    "winners": winners.draw,
    "agreement": agreement.draw,
}



def sweep_in(arguments):
    """The arguments that matter to the maps of a stress sweep, where the results are one."""
    options = common.parser_with_program(__doc__).parse_args(arguments)
    if not os.path.exists(os.path.join(options.results, "stress.csv")):
        return None
    return [options.results] + (["--out", options.out] if options.out else [])


if __name__ == "__main__":
    SWEEP = sweep_in(sys.argv[1:])
    if SWEEP:
        sys.exit(common.run_on(stress.read, stress.FIGURES, __doc__, SWEEP))
    sys.exit(common.run(FIGURES, __doc__))
