"""The fields for ParaView against closed forms. Under a constant load the
stress is constant, and the viscous strain grows to H s T in a period: with
tensor components, (1 + nu) s_12 / E T / tau for the shear."""

import meshio
import numpy

from crevasse_run import check, check_below, run

SCENE = """\
subsection Geometry
  set Shape        = edge crack
  set Subdivisions = 8, 4
end
subsection Material
  set Young modulus   = 13000
  set Poisson ratio   = 0.2
  set Relaxation time = 60
end
subsection Loads
  set Period   = 600
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


def fields_of(name, settings=()):
    results = run(SCENE, name, settings)
    # The end of the run.
    return meshio.read(results.directory / "solution_0000.0.vtu")


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
check_below(numpy.abs(fields["contact_pressure"]).max(), 1e-9, "open: pressure")

mesh = fields_of("closed", ["Loads/Traction=0; -10"])
x, y = mesh.points[:, 0], mesh.points[:, 1]
on_lip = (y < 1e-6) & (x > 0.499)
check(on_lip.any(), "no lip")
difference(mesh.point_data["contact_pressure"], 10. * on_lip, "pressure")
