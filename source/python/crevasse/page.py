# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Makes one HTML file of a template, the style, the library of the charts and
their data."""

import pathlib

import jinja2

from crevasse import wording

TEMPLATES = pathlib.Path(__file__).resolve().parent / "templates"
CHART_LIBRARY = pathlib.Path("/usr/share/javascript/chart.js/chart.min.js")


def render(template, **content):
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True,
        undefined=jinja2.ChainableUndefined)  # older summaries lack keys
    environment.filters |= {
        "significant": wording.significant, "whole": wording.whole,
        "measured": wording.measured, "seconds": wording.seconds,
        "megabytes": wording.megabytes}
    environment.tests["contains"] = lambda points, point: point in points
    environment.globals["plural"] = wording.plural
    return environment.get_template(template).render(
        chart_library=read_library(), style=(TEMPLATES / "style.css").read_text("utf-8"),
        chart_script=(TEMPLATES / "charts.js").read_text("utf-8"), **content)


def read_library():
    try:
        return CHART_LIBRARY.read_text(encoding="utf-8")
    except OSError as error:
        raise OSError(f"{CHART_LIBRARY}: {error.strerror}. The charts need "
                      "Debian's package libjs-chart.js.") from None
