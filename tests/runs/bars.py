"""Uniform bars under sin(wt), without contact, and their closed forms."""

import math

from crevasse_run import plain

BAR = plain("""
subsection Geometry
  set Shape        = rectangle
  set Subdivisions = 2, 2
end
subsection Material
  set Young modulus         = 13000
  set Poisson ratio         = 0.2
  set Relaxation time       = 60
  set Viscous modulus       = 780000
  set Viscous Poisson ratio = 0.45
end
subsection Loads
  set Period   = 600
  set Traction = 0; 10*sin(2*pi*t/600)
end
subsection Periodic state
  set Maximum periods = 1
  set Tolerance       = 0
end
subsection Output
  set Probes = top: 0.5, 1
  set Fields = none
end
""")

OMEGA, TAU, E, LOAD = 2 * math.pi / 600, 60., 13000., 10.
NU, NU_FLOW = 0.2, 0.45

# A bar whose stress relaxes: in plane strain it cannot shrink sideways.
RELAXING = ["Material/Plane state=plane strain", "Material/Viscosity=isotropic"]


def creeping_bar(t):
    """Displacement of the end of a bar in plane stress, per E / load."""
    return math.sin(OMEGA * t) + (1 - math.cos(OMEGA * t)) / (OMEGA * TAU)


def relaxing_bar(t):
    """s_33 / load in plane strain: the bar cannot shrink sideways, and flows
    with another Poisson ratio than the elastic one. From e_33 = 0:
    s_33' + a s_33 = nu F' + a nu_flow F with a = E / E_flow."""
    a = 1 / TAU
    p = (a**2 * NU_FLOW + OMEGA**2 * NU) / (a**2 + OMEGA**2)
    q = a * OMEGA * (NU - NU_FLOW) / (a**2 + OMEGA**2)
    return (p * math.sin(OMEGA * t)
            + q * (math.cos(OMEGA * t) - math.exp(-a * t)))
