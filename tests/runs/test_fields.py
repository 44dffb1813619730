"""The fields for ParaView against closed forms and probes. Under a constant load the
stress is constant, and the viscous strain grows to H s T in a period: with
tensor components, (1 + nu) s_12 / E T / tau for the shear."""

import json
import math
import pathlib
import re

import meshio
import numpy

from cracked import PLATE
from crevasse_run import SOURCE, check, check_below, full, overrides, run, start

SCENE = PLATE + """
subsection Geometry
  set Subdivisions = 8, 4
end
subsection Loads
  set Traction = 0; 10
end
subsection Time integration
  set Steps per period = 10
end
subsection Periodic state
  set Maximum periods = 1
  set Tolerance       = 0
end
"""

E, NU, GROWTH = 13000, 0.2, 600 / 60


def read(results):
    """The mesh at the end of the run, tensors by components as well."""
    mesh = meshio.read(results.directory / "solution_0000.0.vtu")
    for name in [name for name, values in mesh.point_data.items()
                 if values.shape[1:] == (6,)]:
        # ParaView's order.
        for component, column in zip(("11", "22", "33", "12", "23", "13"),
                                     mesh.point_data[name].T):
            mesh.point_data[f"{name}_{component}"] = column
    return mesh


def fields_of(name, settings=()):
    return read(run(SCENE, name, settings))


def difference(values, expected, what):
    size = numpy.abs(expected).max()
    check(size > 0, f"{what}: vanishes")
    check_below(numpy.abs(values.ravel() - expected.ravel()).max() / size, 1e-6,
                what)  # the files have seven digits


fields = fields_of("opened").point_data
s11, s22, s33, s12 = (fields[f"stress_{c}"].ravel()
                      for c in ("11", "22", "33", "12"))
check_below(numpy.abs(s33).max(), 1e-12, "plane stress")
difference(fields["viscous_strain_11"], (s11 - NU * s22) / E * GROWTH, "r_11")
difference(fields["viscous_strain_22"], (s22 - NU * s11) / E * GROWTH, "r_22")
difference(fields["viscous_strain_33"], -NU * (s11 + s22) / E * GROWTH, "r_33")
difference(fields["viscous_strain_12"], (1 + NU) * s12 / E * GROWTH, "r_12")
difference(fields["second_deviator_invariant"],
           (s11**2 + s22**2 - s11 * s22) / 3 + s12**2, "J_2")
difference(fields["principal_stress_1"],
           (s11 + s22) / 2 + numpy.hypot((s11 - s22) / 2, s12), "s_1")
difference(fields["von_mises_stress"],
           numpy.sqrt(s11**2 + s22**2 - s11 * s22 + 3 * s12**2), "von Mises")
check_below(numpy.abs(fields["contact_pressure"]).max(), 1e-9, "open: pressure")
check("temperature" not in fields, "the body is not heated")

mesh = fields_of("closed", ["Loads/Traction=0; -10"])
x, y = mesh.points[:, 0], mesh.points[:, 1]
on_lip = (y < 1e-6) & (x > 0.499)
check(on_lip.any(), "no lip")
check(len(mesh.points) == 9 * 5, "cells share their points")
difference(mesh.point_data["contact_pressure"], 10. * on_lip, "pressure")
difference(mesh.point_data["von_mises_stress"], numpy.full(45, 10.), "uniform")
check_below(abs(mesh.point_data["opening"]).max(), 1e-15, "closed: opening")

# At the end of a run with a gap, heated, as at its probes.
probes = {"mouth": (1, 0), "lip": (0.75, 0), "inside": (0.375, 0.5)}
results = run(SCENE, "probed", [
    "Boundary/Gap=-1e-3*x", "Loads/Temperature=x + 2*y + cos(2*pi*t/600)",
    "Material/Thermal expansion=1e-5", "Output/Probes=" + "; ".join(
        f"{name}: {x}, {y}" for name, (x, y) in probes.items())])
mesh = read(results)
values = mesh.point_data
x, y = mesh.points[:, 0], mesh.points[:, 1]
for name, place in probes.items():
    probe = results.table(f"probe_{name}.csv")
    at = numpy.hypot(x - place[0], y - place[1]).argmin()
    for column, value in [(f"s_{c}", values[f"stress_{c}"][at])
                          for c in ("11", "22", "33", "12")] + (
                              [("opening", values["opening"][at])]
                              if "opening" in probe else []):
        size = 1e-2 if column == "opening" else 10
        check_below(abs(value - probe[column][-1]) / size, 1e-6, f"{name}: {column}")
tip = numpy.hypot(x - 0.5, y).argmin()
difference(values["opening"][tip], numpy.float64(0.5e-3), "opening at the tip")
check_below(abs(values["opening"][y > 0.1]).max(), 1e-15, "opening inside")
difference(values["temperature"], x + 2 * y + 1, "temperature")


# Two bars side by side under the same strain: the stress jumps between them, and
# has no mean, neither in the field nor at a probe, which takes the one below.
BARS = """
subsection Geometry
  set Shape        = rectangle
  set Subdivisions = 4, 4
end
subsection Boundary
  set Symmetry = 0, 2
  set Loaded   = 1
end
subsection Material
  set Young modulus   = if(y < 0.5, 1, 10)
  set Poisson ratio   = 0
  set Relaxation time = 60
end
subsection Loads
  set Period   = 600
  set Traction = if(y < 0.5, 1, 10); 0
end
subsection Time integration
  set Steps per period = 20
end
subsection Periodic state
  set Maximum periods = 1
  set Tolerance       = 0
end
"""
# With hanging nodes between the bars around a crack tip, which nothing loads.
TIP = ["Geometry/Shape=edge crack", "Refinement/Strategy=tip", "Refinement/Cycles=1",
       "Material/Young modulus=if(y < 0.25, 1, 10)",
       "Loads/Traction=if(y < 0.25, 1, 10); 0"]
for degree, height, settings in ((1, 0.5, []), (2, 0.5, []), (1, 0.25, TIP),
                                 (2, 0.25, TIP)):
    results = run(BARS, "bars", [f"Discretisation/Degree={degree}", *settings,
                                 f"Output/Probes=between: 0.5, {height}; end: 1, "
                                 f"{height}; above: 0.5, 0.75"])
    mesh = read(results)
    n = 4 * degree + 1
    check(settings or len(mesh.points) == n * (n + 1), "points are shared in a bar")
    y, stress = mesh.points[:, 1], mesh.point_data["stress_11"].ravel()
    for value, place in ((1, y < height - 1e-3), (10, y > height + 1e-3)):
        difference(stress[place], numpy.full(place.sum(), value), "s_11 of a bar")
    between = stress[abs(y - height) < 1e-3]
    check((between < 5).any() and (between > 5).any(), "one s_11 at the interface")
    difference(between, numpy.where(between < 5, 1, 10), "s_11 at the interface")
    for probe, expected in (("between", 1), ("end", 1), ("above", 10)):
        values = results.table(f"probe_{probe}.csv")["s_11"]
        check_below(max(abs(value / expected - 1) for value in values), 1e-9,
                    f"s_11 at {probe}")
    log = (results.directory / "log.txt").read_text()
    check("probe between: lies between materials" in log
          and "probe above" not in log, log)
# Bars that do not meet may share a number, but no stress.
results = run(BARS, "many", ["Material/Young modulus=10^floor(4*y)",
                             "Loads/Traction=10^floor(4*y); 0",
                             "Output/Probes=between: 0.5, 0.75"])
mesh = read(results)
for y, value in zip(mesh.points[:, 1], mesh.point_data["stress_11"].ravel()):
    check_below(min(abs(value / 10**math.floor(4 * (y + side)) - 1)
                    for side in (-1e-3, 1e-3)), 1e-9, f"s_11 at y = {y}")
error = run(BARS, "estimate", [
    "Refinement/Strategy=adaptive", "Refinement/Cycles=1",
    "Material/Viscosity=none"]).summary["refinement"]["meshes"][0]["estimated_error"]
check_below(error, 1e-9, "estimated error, which no jump of s_11 is")


def automatic_instants():
    """An open crack creeps: its opening is largest at the end, K at T/4 and smallest at
    3T/4, and all are stored. Without a crack, that of the largest stress."""
    results = run(SCENE, "instants_of_K", [
        "Loads/Traction=0; 10 + 3*sin(2*pi*t/600)", "Crack tip/Stress intensity=true",
        "Time integration/Steps per period=40", "Output/Field times=automatic"])
    table = results.table("crack_tip.csv")
    stored = instants_of(results)
    for extreme in (max, min):
        t = table["t"][table["K_I"].index(extreme(table["K_I"]))]
        check(0 < t < 600 and t in stored, f"no field at t = {t}: {stored}")
    # A lip that never closes has no instant of its largest force. The largest
    # opening and K are reached at T/4, and the smallest K at 3T/4.
    results = run(SCENE, "instants_of_open_lip", [
        "Loads/Traction=0; 10 + 3*sin(2*pi*t/600)", "Crack tip/Stress intensity=true",
        "Material/Viscosity=none", "Time integration/Steps per period=40",
        "Output/Field times=automatic"])
    check(instants_of(results) == [150, 450, 600], f"{instants_of(results)}")
    results = run(BARS, "instants_of_stress",
                  ["Loads/Traction=if(y < 0.5, 1, 10)*sin(2*pi*t/600)^3; 0",
                   "Material/Viscosity=none", "Output/Field times=automatic"])
    check(instants_of(results) in ([150., 600.], [450., 600.]),
          f"fields at {instants_of(results)} instead of the largest load's")


def instants_of(results):
    record = (results.directory / "solution.pvd").read_text()
    return [float(t) for t in re.findall('timestep="([^"]*)"', record)]


@full
def memory_of_instants_is_predicted():
    """Half of it is what the checkpoint collects of them that a run leaves which is
    not yet periodic. (A server's own memory would count.)"""
    directory = pathlib.Path("results/instants")
    status, log, error = start(
        SOURCE / "prm/cracked_box.prm", "--output", directory, *overrides([
            "Geometry/Subdivisions=32, 20, 20", "Linear solver/Type=gmg",
            "Periodic state/Maximum periods=1", "Output/Field times=25 instants"]))
    check(status == 3, error)
    measured = json.loads((directory / "summary.json").read_text())["peak_memory_bytes"]
    predicted = 1e6 * float(re.search(r"memory: about (\d+) MB", log)[1])
    check_below(abs(predicted / measured - 1), 0.2,
                f"{predicted:.3g} bytes predicted, {measured:.3g} measured")


automatic_instants()
memory_of_instants_is_predicted()
