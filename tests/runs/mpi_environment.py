"""The environment in which tests and measurements start several processes, whether
or not ctest has started them: as tests/environment.cmake tells ctest."""

import os
import pathlib
import re

SETTINGS = pathlib.Path(__file__).parents[1] / "environment.cmake"
ENVIRONMENT = dict(os.environ, **dict(
    re.findall(r"^set\(ENV{(\w+)} (\S+)\)", SETTINGS.read_text(), re.MULTILINE)))
