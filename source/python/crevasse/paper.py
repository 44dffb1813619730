# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The figures of the paper, as far as the files of a run allow, and what would
give the others."""

import base64
import collections
import io

from matplotlib import pyplot

from crevasse import field_figures, friction_figure, headline, probe_figures, tip_figure
from crevasse.field_figures import is_scene_of_paper, shown_instant
from crevasse.fields import Fields
from crevasse.plotting import magnification, write_png
from crevasse.results import ResultsError, mouth_of_crack
from crevasse.run_reader import Run

Picture = collections.namedtuple("Picture", "title, data, style")
# In scenes of the paper, and in others.
TITLES = {
    "figure1_mesh": ("Figure 1: the mesh", "Mesh"),
    "figure2_stress_history": ("Figure 2: stress over a period",
                               "Stress at {place} over a period"),
    "figure3_opening": ("Figure 3: opening and pressure over a period",
                        "Opening and pressure at {place} over a period"),
    "figure4_stress_levels": ("Figure 4: level curves of the stress",
                              "Stress at t = {t:g}"),
    "figure5_principal_stresses": ("Figure 5: principal stresses",
                                   "Principal stresses at t = {t:g}"),
    "figure6_deviator_invariant": ("Figure 6: second invariant of the deviator",
                                   "Second invariant of the deviator at t = {t:g}"),
    "tip": 2 * ("Stress ahead of the crack tip",),
    "friction": 2 * ("Where the lips stick and slide in the last period",),
    "front": 2 * ("Stress intensity along the crack front in the last period",),
    "creep_front": 2 * ("Creep integral C(t) along the crack front",)}
WORDS = {
    "fields": ("Figures 1, 4, 5 and 6 (mesh and fields at one instant)",
               "Pictures of mesh and stress"),
    "stresses": ("Figures 4 to 6", "Pictures of the stress"),
    "histories": ("Figures 2 and 3", "Pictures of a probe over a period"),
    "opening": ("Figure 3", "A picture of the opening")}


def words(run, what):
    return WORDS[what][0 if is_scene_of_paper(run) else 1]


def pictures(run):
    """Pictures of a run, and sentences about missing ones."""
    if run.summary.get("periods") == 0:
        return [], ["There is no computed period to draw: [Periodic state] Maximum "
                    f"periods = {run.parameter('Periodic state/Maximum periods')}."]
    missing = []
    drawn = {name: encode(run, name, figure, t=t) for name, figure, t
             in field_pictures(run, missing)}
    drawn |= probe_pictures(run, missing)
    if "friction.csv" in run.tables and run.dimension == 2:
        drawn["friction"] = encode(run, "friction", friction_figure.over_time(run))
    if "crack_front.csv" in run.tables:
        name = "front" if headline.has_K_along_front(run) else "creep_front"
        drawn[name] = encode(run, name, tip_figure.along_front(run))
    return [drawn[name] for name in TITLES if name in drawn], missing


def unless_damaged(run, use):
    """Result of a function of stored fields; None, and a note, if unreadable."""
    try:
        return use(run)
    except ResultsError as error:
        damage = str(error).replace(f"{run.directory}/", "")
        if damage not in run.damages:
            run.damages.append(damage)
        return None


def encode(run, name, figure, **where):
    stream = io.BytesIO()
    write_png(figure, stream)
    style = ("wide" if figure.get_figwidth() > 8 else
             "mesh" if name == "figure1_mesh" else "")
    pyplot.close(figure)
    title = TITLES[name][0 if is_scene_of_paper(run) else 1].format(**where)
    return Picture(title, base64.b64encode(stream.getvalue()).decode("ascii"), style)


def probe_pictures(run, missing):
    histories = words(run, "histories")
    if not run.probes:
        missing.append(f"{histories} are missing: this run has no readable probe; "
                       f"{probe_advice(run)} gives them.")
        return {}
    probe = probe_of_paper(run)
    try:
        stress = probe_figures.stress_history(run, probe)
        opening = probe_figures.opening_history(run, probe)
    except ResultsError as error:
        missing.append(f"{histories} need a whole period: {error}")
        return {}
    figures = {"figure2_stress_history": stress}
    if opening:
        figures["figure3_opening"] = opening
    else:
        missing.append(f"{words(run, 'opening')} is missing: no probe of this run is "
                       f"on a crack lip; {probe_advice(run)} gives it.")
    place = name_of_place(run, probe)
    return {name: encode(run, name, figure, place=place)
            for name, figure in figures.items()}


def name_of_place(run, probe):
    mouth = mouth_of_crack(run.parameters)
    at_mouth = mouth and run.probes[probe][:2] == mouth[:2]
    return "the crack mouth" if at_mouth else f"probe {probe}"


def on_lip(run, probe):
    return "opening" in run.tables[f"probe_{probe}.csv"]


def probe_of_paper(run):
    """Probe of figures 2 and 3: C, as in the paper, or the first one on a lip."""
    names = sorted(run.probes, key=lambda name: (not on_lip(run, name),
                                                 name != "C"))
    return names[0]


def probe_advice(run):
    """Advice to set a probe at the mouth of the crack."""
    mouth = mouth_of_crack(run.parameters)
    return "[Output] Probes " + ("= automatic" if mouth else "with a point of the lip")


def field_pictures(run, missing):
    """Pictures (name, figure, t) of the fields."""
    what = words(run, "fields")
    instants = unless_damaged(run, Run.instants)
    if run.dimension == 3:
        missing.append(f"{what} are for plane bodies." + (
            " [Output] Fields = vtu lets this report show the fields of this body."
            if instants == [] else ""))
        return []
    if instants == []:
        missing.append(f"{what} are missing: "
                       + ("this run wrote no fields; [Output] Fields = vtu gives "
                          "them." if run.finished else
                          "fields are written when a run ends."))
        return []
    drawn = unless_damaged(run, lambda run: list(draw_instant(run, missing)))
    if drawn is None:
        missing.append(f"{what} are missing: the files are damaged.")
    elif run.parameter("Geometry/Shape") == "mesh file":
        missing.append("The picture of the mesh has no boundary ids: the fields do not "
                       "hold them. Open the mesh file in Gmsh.")
    return drawn or []


def draw_instant(run, missing):
    quarter = run.period / 4
    t, path = shown_instant(run)
    fields = Fields(path)
    if field_figures.bears_nothing(run, fields):
        missing.append(field_figures.no_stress(t, words(run, "stresses")))
    elif is_scene_of_paper(run) and abs(t % run.period - quarter) > 0.01 * run.period:
        missing.append(f"Figures 4 to 6 are drawn for t = {t:g}, the stored "
                       f"instant nearest to T/4; [Output] Field times = {quarter:g} "
                       "gives the paper's.")
    factor = magnification(fields.points, fields["displacement"], 0.1)
    for name, figure in field_figures.draw_fields(run, fields, t, factor):
        yield name, figure, t
    ahead = tip_figure.stress_ahead(run, fields, t)
    if ahead is not None:
        yield "tip", ahead, t
