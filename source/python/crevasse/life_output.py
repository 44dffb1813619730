# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""life.csv and life.json of a life, and its page."""

import csv
import functools
import io
import json
import math

import numpy
from scipy.interpolate import PchipInterpolator

from crevasse.command import write_file
from crevasse.findings import INTENSITY
from crevasse.histories import COLOURS
from crevasse.life_growth import PARTS, ROWS
from crevasse.page import render
from crevasse.results import ResultsError, read_columns, shortest
from crevasse.wording import in_units


def finite(value):
    """The value for JSON, which knows no infinity."""
    return float(value) if math.isfinite(value) else None


def columns(life, found, chosen):
    growth = found.growth
    rows = numpy.union1d(numpy.arange(0, len(found.edges), PARTS // ROWS),
                         [len(found.edges) - 1])
    a, N = found.edges[rows], found.periods[rows]
    nodes = [life.nodes[0, k] for k in sorted(chosen)]
    drivers = {name: line(a) for name, line in growth.curves[0].items()}

    def of_nodes(values):
        return PchipInterpolator(growth.a, values)(a)
    is_mixed = of_nodes([float(node.is_mixed) for node in nodes]) > 0.

    def lower(name):
        """K_max less a range, which is a K_I unless these are equivalents of two modes;
        exactly 0 where it is rounding."""
        most, rest = drivers["K_max"], drivers[name]
        return numpy.where(is_mixed, numpy.nan, numpy.where(
            numpy.isclose(most, rest, 1e-9, 0.), 0., most - rest))
    return {"N": N, "t": N * life.period, "a": a,
            "x": of_nodes([node.place[0] for node in nodes]),
            "y": of_nodes([node.place[1] for node in nodes]),
            "K_max": drivers["K_max"], "K_min": lower("Delta_K"),
            "K_op": lower("Delta_K_eff"), **drivers, "da_dN_fatigue": found.rates[0, rows],
            "da_dN_creep": found.rates[1, rows],
            "angle": of_nodes([node.angle for node in nodes]),
            "N_error": found.errors[rows],
            **({"path_error": found.path_error[rows]} if life.is_path else {})}


def write(life, found, chosen):
    table = columns(life, found, chosen)
    text = io.StringIO()
    lines = csv.writer(text, lineterminator="\n")
    lines.writerow(table)
    lines.writerows(zip(*([shortest(x) if math.isfinite(x) else "inf" * math.isinf(x)
                           for x in values] for values in table.values())))
    write_file(life.directory / "life.csv", text.getvalue())
    description = {
        "title": f"Life of {life.options.scene.name}", "law": life.law, "units": life.units,
        "N": finite(found.N), "N_error": finite(found.errors[-1]),
        "N_error_of_lengths": finite(found.error_of_lengths),
        "N_error_of_meshes": finite(found.error_of_mesh),
        "asked_error": life.options.error, "infinite": not math.isfinite(found.N),
        "t": finite(found.N * life.period), "from": life.lengths.start,
        "to": float(found.end), "stopped_by": found.why,
        "runs": life.runs, "new_runs": life.new_runs,
        "growth_before_creep_is_steady": finite(found.transition.max()),
        "lengths": [{"a": float(node.a), **{name: finite(value) for name, value
                                            in node.drivers.items()},
                     "K_error": node.error, "transition_time": finite(node.transition)}
                    for node in (life.nodes[0, k] for k in sorted(chosen))],
        "warnings": [*life.warnings.values()]}
    if life.is_path:
        description |= {"path_error": finite(found.path_error[-1]),
                        "body": life.body.outlines()}
    write_file(life.directory / "life.json",
               json.dumps(description, indent=2, ensure_ascii=False) + "\n")


def read(directory):
    """life.json, and life.csv as {column: values}, nan where a cell is empty."""
    try:
        description = json.loads((directory / "life.json").read_text(encoding="utf-8"))
        text = (directory / "life.csv").read_text(encoding="utf-8")
        lines = [",".join(cell or "nan" for cell in line.split(","))
                 for line in text.splitlines()]
        return description, read_columns("\n".join(lines))
    except (OSError, ValueError, csv.Error) as error:
        raise ResultsError(f"{directory}: is no complete life: {error}.") from None


def page(directory):
    """The text of the page of a life, its first line, no notes, no damaged files."""
    life, table = read(directory)
    charts = [chart for chart in charts_of(table, life) if chart["series"]]
    for k, chart in enumerate(charts):
        chart["id"] = f"chart{k}"
    text = render("life.html", title=life["title"], directory=directory.resolve(),
                  picture=picture(table, life.get("body")), life=life, table=table,
                  in_units=units_of(life), charts=charts,
                  data={"charts": charts, "shades": [], "lip": False})
    return text, [], [], []


def picture(table, outlines):
    """Polylines of the body and of the path for the page, y downwards as SVG has it, and
    the box around them; None without a path."""
    if not outlines:
        return None
    def text(points):
        return " ".join(f"{x:.6g},{-y:.6g}" for x, y in points)
    low, high = (end([end(outline, axis=0) for outline in outlines], axis=0)
                 for end in (numpy.min, numpy.max))
    margin = 0.02 * max(high - low)
    known = numpy.isfinite(table["N"])
    growth = {name: (sign * table[name][known]).tolist() for name, sign in (
        ("N", 1), ("a", 1), ("x", 1), ("y", -1))}
    return {"body": [*map(text, outlines)], "path": text(zip(table["x"], table["y"])),
            "growth": growth,
            "box": [low[0] - margin, -high[1] - margin, *(high - low + 2 * margin)]}


def units_of(life):
    """A function that gives labels the units of a life."""
    return functools.partial(in_units, units=life.get("units", ""))


def charts_of(table, life):
    units = units_of(life)
    length, K, span = map(units, ("crack length a (length)", f"K ({INTENSITY})",
                                  f"ΔK ({INTENSITY})"))
    total = table["da_dN_fatigue"] + table["da_dN_creep"]
    N, a, error = table["N"], table["a"], table["N_error"]
    yield chart("crack_length", "Crack length over periods", "periods N", length, [
        line("a(N)", N, a, 0), line("least N", N - error, a, 1, bare=True),
        line("largest N", N + error, a, 1, bare=True)])
    parts = [line(name, table["Delta_K"], table[f"da_dN_{name}"], 1 + k, bare=True)
             for k, name in enumerate(("fatigue", "creep")) if table[f"da_dN_{name}"].any()]
    yield chart("growth", "Growth over ΔK", span, units("da/dN (length)"),
                [line("both", table["Delta_K"], total, 0), *parts] if len(parts) > 1
                else parts, log=["x", "y"])
    computed = [node["a"] for node in life["lengths"]]
    yield chart("stress_intensity", "Stress intensity over the length", length, K, [
        line(name, a, table[name], k, bare=True)
        for k, name in enumerate(("K_max", "K_min", "K_op"))] + [
        line("computed", computed, [node["K_max"] or math.nan for node in life["lengths"]],
             0, loose=True)])
    if numpy.nanmax(table["C_star"], initial=0.) > 0.:
        yield chart("C_star", "C* over the length", length,
                    units("C* (stress × length / time)"),
                    [line("C*", a, table["C_star"], 0)], log=["y"])


def chart(name, title, x, y, series, log=()):
    shown = []
    for one in series:
        one["points"] = [point for point in one["points"] if all(
            math.isfinite(value) and (value > 0. or name not in log)
            for name, value in zip("xy", point))]
        shown += [one] if one["points"] else []
    return {"kind": "points", "name": name, "title": title, "x": x, "y": y, "what": title,
            "log": list(log), "series": shown}


def line(label, x, y, k, **style):
    return {"label": label, "colour": COLOURS[k % len(COLOURS)], **style,
            "points": [[float(one), float(other)] for one, other in zip(x, y)]}
