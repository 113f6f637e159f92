"""Recorded runs of the vessel as numpy arrays, and what is made of them: reports and animations.

Beside the generated messages (otter_nav.msg, otter_nav.srv). Starts no node and needs no master.

    from otter_nav.bag import read_bag
    run = read_bag("mission.bag")[0]
    run.truth.t, run.truth.x, run.error.cross      # s, m, m
"""
