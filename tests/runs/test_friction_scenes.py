"""Random scenes with friction, a twentieth of those of benchmarks/friction_scenes.py."""

from friction_scenes import check_scenes

check_scenes(range(5))
