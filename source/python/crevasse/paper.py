# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The figures of the paper, as far as the files of a run allow, and what would
give the others."""

import base64
import collections
import io

import numpy
from matplotlib import pyplot

from crevasse import field_figures, front_figure, probe_figures, tip_figure
from crevasse.fields import Fields
from crevasse.plotting import round_number, write_png
from crevasse.results import ResultsError, number

Picture = collections.namedtuple("Picture", "title, data, style")
TITLES = {
    "figure1_mesh": "Figure 1: the mesh",
    "figure2_stress_history": "Figure 2: stress over a period",
    "figure3_opening": "Figure 3: opening and pressure over a period",
    "figure4_stress_levels": "Figure 4: level curves of the stress",
    "figure5_principal_stresses": "Figure 5: principal stresses",
    "figure6_deviator_invariant":
        "Figure 6: second invariant of the deviator",
    "tip": "Stress ahead of the crack tip",
    "front": "Stress intensity along the crack front in the last period"}


def pictures(run):
    """Pictures, and sentences about those that are missing."""
    if run.summary.get("periods") == 0:
        return [], ["No period was computed, so that there is nothing to draw: "
                    "[Periodic state] Maximum periods = "
                    f"{run.parameter('Periodic state/Maximum periods')}."]
    missing = []
    drawn = [*field_pictures(run, missing), *probe_pictures(run, missing)]
    if "crack_front.csv" in run.tables:
        drawn.append(encode("front", front_figure.intensity(run)))
    return sorted(drawn, key=lambda picture: picture.title), missing


def encode(name, figure):
    stream = io.BytesIO()
    write_png(figure, stream)
    style = ("wide" if figure.get_figwidth() > 8 else
             "mesh" if name == "figure1_mesh" else "")
    pyplot.close(figure)
    return Picture(TITLES[name],
                   base64.b64encode(stream.getvalue()).decode("ascii"), style)


def probe_pictures(run, missing):
    if not run.probes:
        missing.append("Figures 2 and 3 show a probe over a period, and this run "
                       f"has none that can be read: {probe_advice(run)} gives them.")
        return []
    probe = probe_of_paper(run)
    try:
        stress = probe_figures.stress_history(run, probe)
        opening = probe_figures.opening_history(run, probe)
    except ResultsError as error:
        missing.append(f"Figures 2 and 3 need a whole period: {error}")
        return []
    drawn = [encode("figure2_stress_history", stress)]
    if opening:
        return drawn + [encode("figure3_opening", opening)]
    missing.append("Figure 3 shows the opening, and no probe of this run is on a "
                   f"crack lip: {probe_advice(run)} gives it.")
    return drawn


def on_lip(run, probe):
    return "opening" in run.tables[f"probe_{probe}.csv"]


def probe_of_paper(run):
    """C as in the paper if it is on a lip, else the first that is."""
    names = sorted(run.probes, key=lambda name: (not on_lip(run, name),
                                                 name != "C"))
    return names[0]


def probe_advice(run):
    """A probe at the mouth of the crack."""
    shape = run.parameter("Geometry/Shape")
    points = {"edge crack": run.parameter("Geometry/Width"), "centre crack": "0"}
    point = points.get(shape)
    if point is None:
        return "[Output] Probes with a point of the lip"
    rest = ", 0, 0" if run.dimension == 3 else ", 0"
    return f"[Output] Probes = C: {point}{rest}"


def field_pictures(run, missing):
    figures = "Figures 1, 4, 5 and 6 (mesh and fields at one instant)"
    if run.dimension == 3:
        missing.append(f"{figures} are for plane bodies. " + (
            "Open solution.pvd in ParaView." if (run.directory / "solution.pvd").is_file() else
            "[Output] Fields = vtu writes fields for ParaView."))
        return []
    try:
        return list(draw_instant(run, figures, missing))
    except ResultsError as error:
        run.damages.append(str(error).replace(f"{run.directory}/", ""))
        missing.append(f"{figures} are missing: the files are damaged.")
        return []


def draw_instant(run, figures, missing):
    if not run.instants():
        missing.append(f"{figures} are missing: "
                       + (f"this run wrote no fields; {field_advice(run)} gives "
                          "them." if run.finished else
                          "fields are written when a run ends."))
        return
    quarter = run.period / 4
    t, path = run.choose_instant(wanted_instant(run))
    fields = Fields(path)
    if field_figures.bears_nothing(run, fields):
        missing.append(field_figures.no_stress(t))
    elif abs(t % run.period - quarter) > 0.01 * run.period:
        missing.append(f"Figures 4 to 6 are drawn for t = {t:g}, the stored "
                       f"instant nearest to T/4; [Output] Field times = {quarter:g} "
                       "gives the paper's.")
    for drawing in field_figures.draw_fields(run, fields, t,
                                             magnification(fields)):
        yield encode(*drawing)
    ahead = tip_figure.stress_ahead(run, fields, t)
    if ahead is not None:
        yield encode("tip", ahead)


def wanted_instant(run):
    """T/4 as in the paper, or what the scene names next to it; the end of the run,
    which is stored too, only if it names none."""
    named = [value for value in map(number, run.parameter("Output/Field times")
                                    .split(",")) if value is not None]
    return min(named, key=lambda t: abs(t - run.period / 4),
               default=run.period / 4)


def field_advice(run):
    fields = "" if run.parameter("Output/Fields") == "vtu" else "Fields = vtu with "
    return f"[Output] {fields}Field times = {run.period / 4:g}"


def magnification(fields):
    """A round factor by which the largest displacement, its mean apart, is a
    tenth of the body."""
    u = fields["displacement"]
    moved = numpy.abs(u - u.mean(axis=0)).max()
    size = numpy.ptp(fields.points, axis=0).max()
    return round_number(0.1 * size / moved) if moved > 1e-12 * size else 1
