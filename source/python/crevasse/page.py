# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Makes one HTML file of a template, the style, the library of the charts and
their data."""

import pathlib

import jinja2

from crevasse import wording

TEMPLATES = pathlib.Path(__file__).resolve().parent / "templates"
LIBRARIES = pathlib.Path("/usr/share/javascript")
CHART_LIBRARY = LIBRARIES / "chart.js" / "chart.min.js", "libjs-chart.js"
VIEW_LIBRARIES = ((LIBRARIES / "three" / "three.min.js", "libjs-three"),
                  (LIBRARIES / "three/examples/js/controls/OrbitControls.js",
                   "libjs-three"))


def render(template, **content):
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True,
        undefined=jinja2.ChainableUndefined)  # older summaries lack keys
    environment.filters |= {
        "significant": wording.significant, "whole": wording.whole,
        "measured": wording.measured, "seconds": wording.seconds,
        "megabytes": wording.megabytes, "subscripts": wording.subscripts}
    environment.tests["contains"] = lambda points, point: point in points
    environment.globals["plural"] = wording.plural
    if content.get("fields"):
        content |= {"view_libraries": [read_library(*library)
                                       for library in VIEW_LIBRARIES],
                    "view_scripts": [read_own(f"{name}.js") for name in (
                        "field_data", "field_scene", "field_view",
                        *["mesh_marks"] * ("groups" in content["fields"]))]}
    return environment.get_template(template).render(
        chart_library=read_library(*CHART_LIBRARY), style=read_own("style.css"),
        chart_script=read_own("charts.js"), **content)


def read_own(name):
    return (TEMPLATES / name).read_text("utf-8")


def read_library(path, package):
    try:
        return path.read_text(encoding="utf-8")
    except OSError as error:
        raise OSError(f"{path}: {error.strerror}. Reports need Debian's package "
                      f"{package}.") from None
