# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Packs the fields of the stored instants for the view of a report. Each component is
rounded to 65536 values between its extremes over all instants; the differences from
point to point are compressed. templates/field_data.js unpacks them."""

import base64
import collections
import re
import zlib

from matplotlib import colormaps
from matplotlib.colors import to_hex
import numpy

from crevasse.field_figures import evenly, shown_instant
from crevasse.fields import node_areas, read_pieces
from crevasse.level_curves import even_levels, range_without_peaks
from crevasse.plotting import magnification
from crevasse.results import ResultsError
from crevasse.skin import Skin

MOST_CHARACTERS = 16_000_000  # of the report
NOISE = 1e-6  # of the largest value of a kind: rounding

Entry = collections.namedtuple("Entry", "rank, label, kind")
# Arrays in the order of the menu, their labels, and what is as large as they are.
ARRAYS = (("von_mises_stress", "von Mises stress", "stress"),
          (r"principal_stress_(\d)", "principal stress s{}", "stress"),
          (r"stress_(\d\d)", "stress s{}", "stress"),
          (r"viscous_strain_(\d\d)", "viscous strain r{}", "strain"),
          (r"viscous_strain_branch_(\d+)_(\d\d)", "viscous strain {} r{}", "strain"),
          (r"displacement_(\d)", "displacement u{}", "displacement"),
          ("contact_pressure", "contact pressure", "stress"),
          ("opening", "opening of the lip", "displacement"),
          (r"(?!principal_direction|second_deviator)(.*)", "{}", "{}"))
SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


def entry(name):
    """Description of a component for the page; None if the component is not shown."""
    for rank, (pattern, label, kind) in enumerate(ARRAYS):
        if match := re.fullmatch(pattern, name):
            words = [word.replace("_", " ").translate(SUBSCRIPTS) for word
                     in match.groups()]
            return Entry(rank, label.format(*words), kind.format(*words))
    return None


def components(data, dimension):
    """Scalars by name that the view can show."""
    found = {}
    for name, values in data.items():
        if name == "displacement":
            found |= {f"displacement_{k + 1}": values[:, k] for k in range(dimension)}
        elif values.ndim == 1 and entry(name):
            found[name] = values
    return found


def pack(run):
    """Data of the field view for the page; None for a run without fields."""
    stored = run.instants()
    if not stored:
        return None
    times, files = zip(*evenly(stored))
    skin, fields = read(run, files)
    displacements = numpy.stack([fields[f"displacement_{k + 1}"]
                                 for k in range(run.dimension)], -1)
    used, marks = skin.finish(displacements)
    fields = {name: values[:, used] for name, values in fields.items()}
    displacements = displacements[:, used]
    packed = {"dimension": run.dimension, "period": run.period,
              "times": times, "stored": len(stored),
              **pack_skin(skin, marks),
              "factor": magnification(skin.points, displacements, 0.06),
              "first": int(abs(numpy.array(times) - shown_instant(run)[0]).argmin()),
              "components": list(pack_components(skin, fields, run.material_names))}
    return thinned(packed)


def pack_skin(skin, marks):
    differences = numpy.diff(skin.quads.astype(numpy.int32), axis=0,
                             prepend=numpy.int32(0))  # 0 alone has eight bytes
    return {"points": text_of(skin.points.astype(numpy.float32).view(numpy.uint32)),
            "quads": text_of(zigzag(differences)), "marks": text_of(marks)}


def read(run, files):
    """Reads the skin, and its values of each component at each instant."""
    fields, skin = {}, None
    for path in files:
        points, cells, data = read_pieces(path, run.dimension)
        if skin is None:
            parts = int(run.number("Discretisation/Degree")) ** run.dimension
            skin = Skin(points, cells, parts if len(cells) % parts == 0 else 1)
            n_points = len(points)
        if len(points) != n_points or "displacement" not in data:
            raise ResultsError(f"{path}: has other points than {files[0].name}, or no "
                               "displacement.")
        for name, values in components(data, run.dimension).items():
            fields.setdefault(name, []).append(
                values[skin.kept].astype(numpy.float32))
    return skin, {name: numpy.stack(values) for name, values in fields.items()
                  if len(values) == len(files)}


def pack_components(skin, fields, materials):
    entries = {name: entry(name) for name in fields}
    largest = collections.defaultdict(float)
    for name, values in fields.items():
        kind = entries[name].kind
        largest[kind] = max(largest[kind], float(abs(values).max()))
    areas = node_areas(skin.points, skin.quads)
    for name in sorted(fields, key=lambda name: (entries[name].rank, name)):
        values, kind = fields[name], entries[name].kind
        if name == "material":
            yield pack_materials(values, materials)
            continue
        low, high = float(values.min()), float(values.max())
        if kind != "displacement" and high - low <= NOISE * largest[kind]:
            continue  # zero, as s_33 in plane stress
        quantum = (high - low) / 65535 or 1.
        weights = numpy.broadcast_to(areas, values.shape)
        packed = {"name": name, "label": entries[name].label,
                  "low": low, "quantum": quantum,
                  "values": [encode(row, low, quantum) for row in values]}
        if name == "contact_pressure":
            packed["threshold"] = max(NOISE * largest[kind], quantum)
            presses = values > packed["threshold"]
            if not presses.any():
                continue
            packed["lip"] = numpy.flatnonzero(presses.any(axis=0)).tolist()
            values, weights = values[presses], numpy.ones(presses.sum())
        yield packed | scale(values, weights)


def pack_materials(ids, names):
    """Packs the materials as numbers from 0 on, each with its own band of colour."""
    found, numbers = numpy.unique(ids, return_inverse=True)
    quantum = max(len(found) - 1, 1) / 65535
    rows = numbers.reshape(ids.shape)
    colours = [to_hex(colormaps["Pastel1"](int(number) % 9)) for number in found]
    return {"name": "material", "label": "material", "low": 0., "quantum": quantum,
            "values": [encode(row, 0., quantum) for row in rows],
            "names": [names.get(int(number), f"{number:g}") for number in found],
            "levels": (numpy.arange(len(found) + 1) - 0.5).tolist(),
            "colours": [colours[0], *colours, colours[-1]]}


def scale(values, areas):
    """Even, round levels over nearly all of the body and all instants, and colours of
    the bands below, between and above them."""
    kept = slice(None, None, 1 + values.size // 400_000)
    low, high = range_without_peaks(values.ravel()[kept], areas.ravel()[kept], 0.01)
    if not high - low > NOISE * numpy.ptp(values):
        low, high = values.min(), values.max()
    if not high > low:
        high = low + (abs(low) or 1)
    levels = even_levels(low, high, 14, outside=True)
    return {"levels": levels.tolist(), "colours": band_colours(levels)}


def band_colours(levels):
    """Colours of bands. If values have two signs, or nearly, blue for negative and red
    for positive ones, the paler the smaller; else from dark to light."""
    step = levels[1] - levels[0]
    middles = numpy.append(levels, levels[-1] + step) - step / 2
    if levels[0] > 2 * step or levels[-1] < -2 * step:
        places = numpy.linspace(0.05, 0.95, len(middles))
        return [to_hex(colormaps["viridis"](place)) for place in places]
    depths = 0.08 + 0.82 * abs(middles) / abs(middles).max()
    return [to_hex(colormaps["Blues" if middle < 0 else "YlOrRd"](depth))
            for middle, depth in zip(middles, depths)]


def encode(values, low, quantum):
    q = numpy.rint((values.astype(float) - low) / quantum).clip(0, 65535)
    differences = numpy.diff(q.astype(numpy.uint16), prepend=numpy.uint16(0))
    return text_of(zigzag(differences.view(numpy.int16)))


def zigzag(differences):
    """Maps small numbers of either sign to small numbers without sign."""
    bits = 8 * differences.itemsize
    return ((differences << 1) ^ (differences >> (bits - 1))).astype(f"u{bits // 8}")


def text_of(values):
    """Compresses numbers, all first bytes first, because these are much alike."""
    little = numpy.ascontiguousarray(values).astype(values.dtype.newbyteorder("<"))
    planes = little.reshape(-1, 1).view(numpy.uint8).T
    return base64.b64encode(zlib.compress(planes.tobytes())).decode("ascii")


def thinned(packed):
    """Leaves out every second instant until the report is small enough."""
    def characters():
        return sum(len(text) for component in packed["components"]
                   for text in component["values"])
    while characters() > MOST_CHARACTERS and len(packed["times"]) > 2:
        packed["times"] = packed["times"][packed["first"] % 2::2]
        for component in packed["components"]:
            component["values"] = component["values"][packed["first"] % 2::2]
        packed["first"] //= 2
    return packed
