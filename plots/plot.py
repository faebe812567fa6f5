"""Every figure of a results folder: what `touchstone show --figures` runs."""

import sys

import agreement
import broad
import cells
import common
import concave
import narrow
import phases
import speed_up
import stress
import time_against_count
import trade
import winners

FIGURES = {
    "time_against_count": time_against_count.draw,
    "broad": broad.draw,
    "narrow": narrow.draw,
    "concave": concave.draw,
    "speed_up": speed_up.draw,
    "phases": phases.draw,
    "winners": winners.draw,
    "agreement": agreement.draw,
}

if __name__ == "__main__":
    sys.exit(common.run(FIGURES, __doc__, {"points.csv": trade.run, "stress.csv": stress.run, cells.FILE: cells.run}))
