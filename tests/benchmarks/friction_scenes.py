"""A hundred seeded scenes with friction: certificates, 1, 2 and 3 ranks, runs that are
killed and resumed byte for byte, other units, rotation.

    cd build && OMP_NUM_THREADS=1
    /usr/bin/python3 ../tests/benchmarks/friction_scenes.py crevasse .. [first [end]]"""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "runs"))
from friction_scenes import check_scenes  # noqa: E402: where it is, is known now

FIRST, END = [*map(int, sys.argv[3:]), *(0, 100)[len(sys.argv) - 3:]]
check_scenes(range(FIRST, END))
